#include "reckon/harness/yaml_load.h"

#include <yaml-cpp/yaml.h>

#include <charconv>
#include <fstream>
#include <iterator>
#include <set>
#include <system_error>

namespace reckon::harness {
namespace {

/// Makes our tree from yaml-cpp's.
class Converter {
 public:
  Converter(const Location& whole, int layer) : whole_(whole), layer_(layer) {}

  YamlNode Convert(const YAML::Node& node, int depth) {
    constexpr int kDeepest = 64, kMost = 100'000;
    YamlNode out;
    out.at = Where(node.Mark());
    out.layer = layer_;
    if (depth > kDeepest) Fail(out.at, "more than 64 levels deep");
    if (++count_ > kMost) Fail(out.at, "more than 100000 values");
    switch (node.Type()) {
      case YAML::NodeType::Scalar:
        out.type = YamlNode::Type::kScalar;
        out.text = node.Scalar();
        out.quoted = node.Tag() == "!";
        RefuseTag(node, out.at);
        if (KindOf(out) == ScalarKind::kNull) out.type = YamlNode::Type::kNull;
        break;
      case YAML::NodeType::Sequence:
        out.type = YamlNode::Type::kList;
        RefuseTag(node, out.at);
        for (const auto& item : node) out.items.push_back(Convert(item, depth + 1));
        break;
      case YAML::NodeType::Map:
        ConvertMap(node, depth, out);
        break;
      case YAML::NodeType::Null:
      case YAML::NodeType::Undefined:
        break;
    }
    return out;
  }

 private:
  Location Where(const YAML::Mark& mark) const {
    if (mark.is_null() || whole_.source->starts_with("--")) return whole_;
    return {whole_.source, mark.line + 1, mark.column + 1};
  }

  static void RefuseTag(const YAML::Node& node, const Location& at) {
    const std::string& tag = node.Tag();
    if (!tag.empty() && tag != "?" && tag != "!")
      Fail(at, "tags such as '" + Shown(tag) + "' have no meaning here");
  }

  void ConvertMap(const YAML::Node& node, int depth, YamlNode& out) {
    out.type = YamlNode::Type::kMap;
    RefuseTag(node, out.at);
    std::set<std::string> seen;
    for (const auto& entry : node) {
      const Location at = Where(entry.first.Mark());
      if (!entry.first.IsScalar()) Fail(at, "expected a word as key, found something else");
      const std::string key = entry.first.Scalar();
      if (!seen.insert(key).second) {
        Fail(at, "key '" + Shown(key) + "' is written twice; the first is at line " +
                     std::to_string(FirstLine(out, key)));
      }
      YamlNode value = Convert(entry.second, depth + 1);
      if (value.type == YamlNode::Type::kNull) value.at = at;  // yaml-cpp puts it on the next token
      out.keys.push_back({key, at});
      out.items.push_back(std::move(value));
    }
  }

  static int FirstLine(const YamlNode& map, const std::string& key) {
    for (const auto& known : map.keys) {
      if (known.name == key) return known.at.line;
    }
    return 0;
  }

  Location whole_;
  int layer_;
  int count_ = 0;
};

/// Length of the well-formed UTF-8 character at the start of `text`; 0 if there is none.
std::size_t CharacterLength(std::string_view text) {
  const auto byte = [&text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return 0;
  }
  const bool overlong = (first == 0xE0 && byte(1) < 0xA0) || (first == 0xF0 && byte(1) < 0x90);
  const bool surrogate = first == 0xED && byte(1) >= 0xA0;
  const bool beyond = first == 0xF4 && byte(1) >= 0x90;
  return overlong || surrogate || beyond ? 0 : length;
}

/// yaml-cpp takes any bytes (and one control character for the end of the file): refuse them first.
void RefuseBadCharacters(std::string_view text, const Location& whole) {
  Location at{whole.source, 1, 1};
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = CharacterLength(text.substr(i));
    if (length == 0) Fail(at, "not UTF-8 text");
    const char c = text[i];
    if ((c >= 0 && c < ' ' && c != '\t' && c != '\n' && c != '\r') || c == 0x7F) {
      Fail(at, "a control character");
    }
    i += length;
    ++at.column;
    if (c == '\n') at = {whole.source, at.line + 1, 1};
  }
}

}  // namespace

YamlNode ParseYaml(const std::string& text, const std::string& source, int layer) {
  const Location whole{std::make_shared<const std::string>(source), 0, 0};
  RefuseBadCharacters(text, whole);
  std::vector<YAML::Node> documents;
  try {
    documents = YAML::LoadAll(text);
    if (documents.size() > 1) Fail(whole, "expected one YAML document, found several");
    if (documents.empty()) Fail(whole, "the file is empty");
    return Converter(whole, layer).Convert(documents.front(), 0);
  } catch (const YAML::Exception& error) {
    Location at = whole;
    if (!error.mark.is_null() && !source.starts_with("--")) {
      at = {whole.source, error.mark.line + 1, error.mark.column + 1};
    }
    Fail(at, "not YAML: " + error.msg);
  }
}

YamlNode ParseYamlFile(const std::string& text, const std::string& source) {
  YamlNode root = ParseYaml(text, source);
  if (root.type == YamlNode::Type::kNull) {
    Fail({std::make_shared<const std::string>(source), 0, 0}, "the file is empty");
  }
  if (!root.is_map()) Fail(root.at, "expected a map of keys, found " + Found(root));
  return root;
}

YamlNode LoadYamlFile(const std::filesystem::path& path) {
  constexpr std::size_t kLargest = 1'000'000;
  const Location whole{std::make_shared<const std::string>(path.string()), 0, 0};
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) Fail(whole, "there is no such file");
  if (std::filesystem::is_directory(status)) Fail(whole, "is a folder, expected a file");
  std::ifstream file(path, std::ios::binary);
  std::string text(kLargest + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad() || !file.eof()) {
    Fail(whole, file.gcount() > 0 ? "is larger than 1 MB, which no scenario is" : "can't be read");
  }
  text.resize(static_cast<std::size_t>(file.gcount()));
  return ParseYamlFile(text, path.string());
}

void Merge(const YamlNode& over, YamlNode& base) {
  if (!over.is_map() || !base.is_map()) {
    base = over;
    return;
  }
  for (std::size_t i = 0; i < over.keys.size(); ++i) {
    YamlNode* mine = base.Find(over.keys[i].name);
    if (mine == nullptr) {
      base.keys.push_back(over.keys[i]);
      base.items.push_back(over.items[i]);
      continue;
    }
    for (YamlNode::Key& key : base.keys) {
      if (key.name == over.keys[i].name) key.at = over.keys[i].at;
    }
    Merge(over.items[i], *mine);
  }
}

namespace {

/// The value that `step` leads to from `node`; makes maps and keys that are not there yet.
YamlNode& Descend(YamlNode& node, const std::string& step, const YamlNode& blank) {
  if (step.empty()) Fail(blank.at, "the key has an empty part");
  if (node.is_list()) {
    std::size_t index = node.items.size();
    const char* end = step.data() + step.size();
    const bool is_number = std::from_chars(step.data(), end, index).ptr == end;
    if (!is_number || index >= node.items.size()) {
      Fail(blank.at,
           "'" + Shown(step) + "' is no index of a list of " + std::to_string(node.items.size()));
    }
    return node.items[index];
  }
  if (!node.is_map()) {
    node = blank;
    node.type = YamlNode::Type::kMap;
  }
  YamlNode* child = node.Find(step);
  return child != nullptr ? *child : node.Add(step, blank);
}

}  // namespace

void ApplyOverride(const std::string& text, int layer, YamlNode& root) {
  const std::string label = "--set " + text;
  YamlNode blank;
  blank.at = {std::make_shared<const std::string>(label), 0, 0};
  blank.layer = layer;
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) Fail(blank.at, "expected KEY=VALUE, such as seed=2");
  const std::string written = text.substr(equals + 1);
  const YamlNode value = written.empty() ? blank : ParseYaml(written, label, layer);

  YamlNode* node = &root;
  for (std::size_t begin = 0; begin <= equals;) {
    const std::size_t end = std::min(text.find('.', begin), equals);
    node = &Descend(*node, text.substr(begin, end - begin), blank);
    begin = end + 1;
  }
  Merge(value, *node);
}

}  // namespace reckon::harness

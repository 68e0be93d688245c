#include "reckon/harness/yaml_load.h"

#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <charconv>
#include <fstream>
#include <sstream>
#include <system_error>

#include "reckon/harness/yaml_tree.h"

namespace reckon::harness {
namespace {

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
  YamlTreeBuilder builder(whole, layer);
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    if (!parser.HandleNextDocument(builder)) Fail(whole, "the file is empty");
    // Not YAML::LoadAll: behind a stray comma it finds documents without end.
    parser.HandleNextDocument(builder);
    return builder.Take();
  } catch (const YAML::Exception& error) {
    Fail(builder.Where(error.mark), "not YAML: " + error.msg);
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

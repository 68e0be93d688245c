#include "reckon/harness/yaml_emit.h"

#include <algorithm>
#include <array>

namespace reckon::harness {
namespace {

bool IsPlainWord(const std::string& text) {
  constexpr std::string_view kSafe =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./ -<>*+%()";
  constexpr std::string_view kFirst = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_./";
  // Words that YAML 1.1 reads as flags or nothing.
  for (const char* word : {"yes", "Yes", "YES", "no", "No", "NO", "on", "On", "ON", "off", "Off",
                           "OFF", "y", "Y", "n", "N"}) {
    if (text == word) return false;
  }
  YamlNode plain;
  plain.type = YamlNode::Type::kScalar;
  plain.text = text;
  return KindOf(plain) == ScalarKind::kText && text.find_first_not_of(kSafe) == text.npos &&
         kFirst.find(text.front()) != kFirst.npos && text.back() != ' ';
}

std::string Quoted(const std::string& text) {
  constexpr std::string_view kHex = "0123456789abcdef";
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += std::string{'\\', c};
    } else if (c == '\n') {
      out += "\\n";
    } else if (byte < 0x20 || byte == 0x7F) {
      out += std::string("\\x") + kHex[byte >> 4U] + kHex[byte & 15U];
    } else {
      out += c;
    }
  }
  return out + "\"";
}

std::string ScalarText(const YamlNode& node) {
  if (node.type == YamlNode::Type::kNull) return "null";
  return node.quoted && !IsPlainWord(node.text) ? Quoted(node.text) : node.text;
}

bool IsFlat(const YamlNode& node) {
  if (node.is_map()) return node.keys.empty();
  if (!node.is_list()) return true;
  // A list of numbers, or of such lists.
  return std::all_of(node.items.begin(), node.items.end(),
                     [](const YamlNode& item) { return !item.is_map() && IsFlat(item); });
}

std::string FlatText(const YamlNode& node) {
  if (node.is_map()) return "{}";
  if (!node.is_list()) return ScalarText(node);
  std::string out = "[";
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    const std::string item = FlatText(node.items[i]);
    // Inside brackets a comma or bracket in a plain word would end it; no plain word has one.
    out += (i == 0 ? "" : ", ") + item;
  }
  return out + "]";
}

void EmitBlock(const YamlNode& node, const std::string& indent, bool first_is_placed,
               std::string& out) {
  const std::size_t n = node.items.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (i > 0 || !first_is_placed) out += indent;
    const YamlNode& item = node.items[i];
    out += node.is_map() ? node.keys[i].name + ":" : std::string("-");
    if (IsFlat(item)) {
      out += " " + FlatText(item) + "\n";
    } else if (node.is_map()) {
      out += "\n";
      EmitBlock(item, indent + "  ", false, out);
    } else {
      out += " ";
      EmitBlock(item, indent + "  ", true, out);
    }
  }
}

}  // namespace

YamlNode TextNode(std::string text) {
  YamlNode node = PlainNode(std::move(text));
  node.quoted = true;
  return node;
}

YamlNode PlainNode(std::string text) {
  YamlNode node;
  node.type = YamlNode::Type::kScalar;
  node.text = std::move(text);
  return node;
}

std::string EmitYaml(const YamlNode& root) {
  if (IsFlat(root)) return FlatText(root) + "\n";
  std::string out;
  EmitBlock(root, "", false, out);
  return out;
}

}  // namespace reckon::harness

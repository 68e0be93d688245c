#include "reckon/harness/yaml_node.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace reckon::harness {
namespace {

bool IsNumber(std::string_view text) {
  if (!text.empty() && (text.front() == '+' || text.front() == '-')) text.remove_prefix(1);
  if (text.empty()) return false;
  if (text == ".inf" || text == ".Inf" || text == ".INF" || text == ".nan" || text == ".NaN" ||
      text == ".NAN") {
    return true;
  }
  if (text.front() != '.' && (text.front() < '0' || text.front() > '9')) return false;
  double value = 0.0;
  const char* end = text.data() + text.size();
  return std::from_chars(text.data(), end, value).ptr == end;
}

}  // namespace

const YamlNode* YamlNode::Find(std::string_view key) const {
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (keys[i].name == key) return &items[i];
  }
  return nullptr;
}

YamlNode* YamlNode::Find(std::string_view key) {
  return const_cast<YamlNode*>(std::as_const(*this).Find(key));
}

const YamlNode* YamlNode::At(std::string_view path) const {
  const YamlNode* node = this;
  while (!path.empty() && node != nullptr) {
    path.remove_prefix(1);
    const std::size_t length = std::min(path.find('/'), path.size());
    const std::string_view step = path.substr(0, length);
    path.remove_prefix(length);
    if (node->is_map()) {
      node = node->Find(step);
      continue;
    }
    std::size_t index = node->items.size();
    std::from_chars(step.data(), step.data() + step.size(), index);
    node = index < node->items.size() ? &node->items[index] : nullptr;
  }
  return node;
}

YamlNode& YamlNode::Add(std::string key, YamlNode value) {
  type = Type::kMap;
  keys.push_back({std::move(key), value.at});
  items.push_back(std::move(value));
  return items.back();
}

void YamlNode::Erase(std::string_view key) {
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (keys[i].name != key) continue;
    keys.erase(keys.begin() + static_cast<std::ptrdiff_t>(i));
    items.erase(items.begin() + static_cast<std::ptrdiff_t>(i));
    return;
  }
}

int YamlNode::TopLayer() const {
  int top = layer;
  for (const YamlNode& item : items) top = std::max(top, item.TopLayer());
  return top;
}

ScalarKind KindOf(const YamlNode& scalar) {
  const std::string& text = scalar.text;
  if (scalar.quoted) return ScalarKind::kText;
  if (text.empty() || text == "~" || text == "null" || text == "Null" || text == "NULL") {
    return ScalarKind::kNull;
  }
  for (const char* word : {"true", "True", "TRUE", "false", "False", "FALSE"}) {
    if (text == word) return ScalarKind::kBool;
  }
  return IsNumber(text) ? ScalarKind::kNumber : ScalarKind::kText;
}

std::string Shown(std::string_view text) {
  constexpr std::size_t kLongest = 60;
  std::string shown;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool starts_character = (byte & 0xC0U) != 0x80U;
    if (shown.size() >= kLongest && starts_character) return shown + "…";
    shown += byte < 0x20 || byte == 0x7F ? '?' : c;
  }
  return shown;
}

std::string Found(const YamlNode& node) {
  switch (node.type) {
    case YamlNode::Type::kNull:
      return "nothing";
    case YamlNode::Type::kList:
      return "a list";
    case YamlNode::Type::kMap:
      return "a map";
    case YamlNode::Type::kScalar:
      break;
  }
  return KindOf(node) == ScalarKind::kNull ? "nothing" : "'" + Shown(node.text) + "'";
}

}  // namespace reckon::harness

#include "reckon/harness/yaml_tree.h"

#include <yaml-cpp/mark.h>

#include <algorithm>
#include <utility>

namespace reckon::harness {
namespace {

constexpr std::size_t kDeepest = 64, kMostValues = 100'000;

std::size_t SizeOf(const YamlNode& node) {
  std::size_t size = 1;
  for (const YamlNode& item : node.items) size += SizeOf(item);
  return size;
}

std::size_t DepthOf(const YamlNode& node) {
  std::size_t depth = 0;
  for (const YamlNode& item : node.items) depth = std::max(depth, DepthOf(item));
  return depth + 1;
}

void RefuseTag(const std::string& tag, const Location& at) {
  if (tag.empty() || tag == "?" || tag == "!") return;
  Fail(at, "tags such as '" + Shown(tag) + "' have no meaning here");
}

}  // namespace

Location YamlTreeBuilder::Where(const YAML::Mark& mark) const {
  if (mark.is_null() || whole_.source->starts_with("--")) return whole_;
  return {whole_.source, mark.line + 1, mark.column + 1};
}

void YamlTreeBuilder::Count(const Location& at, std::size_t values) {
  count_ += values;
  if (count_ > kMostValues) Fail(at, "more than 100000 values");
  if (open_.size() >= kDeepest) Fail(at, "more than 64 levels deep");
}

void YamlTreeBuilder::OnDocumentStart(const YAML::Mark& mark) {
  if (started_) Fail(Where(mark), "expected the end of the file, found another YAML document");
  started_ = true;
}

void YamlTreeBuilder::OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) {
  YamlNode node;
  node.at = Where(mark);
  node.layer = layer_;
  Count(node.at, 1);
  Place(std::move(node), anchor);
}

void YamlTreeBuilder::OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) {
  const Location at = Where(mark);
  const auto known = anchors_.find(anchor);
  if (known == anchors_.end()) Fail(at, "an anchor can't hold itself");
  Count(at, SizeOf(known->second));
  if (open_.size() + DepthOf(known->second) > kDeepest) Fail(at, "more than 64 levels deep");
  Place(known->second, 0);
}

void YamlTreeBuilder::OnScalar(const YAML::Mark& mark, const std::string& tag,
                               YAML::anchor_t anchor, const std::string& value) {
  YamlNode node;
  node.type = YamlNode::Type::kScalar;
  node.text = value;
  node.quoted = tag == "!";
  node.at = Where(mark);
  node.layer = layer_;
  RefuseTag(tag, node.at);
  Count(node.at, 1);
  if (KindOf(node) == ScalarKind::kNull) node.type = YamlNode::Type::kNull;
  Place(std::move(node), anchor);
}

void YamlTreeBuilder::OnSequenceStart(const YAML::Mark& mark, const std::string& tag,
                                      YAML::anchor_t anchor, YAML::EmitterStyle::value /*style*/) {
  Start(YamlNode::Type::kList, mark, tag, anchor);
}

void YamlTreeBuilder::OnMapStart(const YAML::Mark& mark, const std::string& tag,
                                 YAML::anchor_t anchor, YAML::EmitterStyle::value /*style*/) {
  Start(YamlNode::Type::kMap, mark, tag, anchor);
}

void YamlTreeBuilder::Start(YamlNode::Type type, const YAML::Mark& mark, const std::string& tag,
                            YAML::anchor_t anchor) {
  Open open;
  open.node.type = type;
  open.node.at = Where(mark);
  open.node.layer = layer_;
  open.anchor = anchor;
  RefuseTag(tag, open.node.at);
  Count(open.node.at, 1);
  open_.push_back(std::move(open));
}

void YamlTreeBuilder::Close() {
  Open done = std::move(open_.back());
  open_.pop_back();
  Place(std::move(done.node), done.anchor);
}

void YamlTreeBuilder::PlaceKey(const YamlNode& node, Open& map) const {
  if (!node.is_scalar()) Fail(node.at, "expected a word as key, found " + Found(node));
  for (const YamlNode::Key& known : map.node.keys) {
    if (known.name != node.text) continue;
    Fail(node.at, "key '" + Shown(node.text) + "' is written twice" +
                      (known.at.line > 0 ? "; the first is at line " + std::to_string(known.at.line)
                                         : std::string()));
  }
  map.key = {node.text, node.at};
  map.has_key = true;
}

void YamlTreeBuilder::Place(YamlNode node, YAML::anchor_t anchor) {
  if (anchor != 0) anchors_[anchor] = node;
  if (open_.empty()) {
    root_ = std::move(node);
    return;
  }
  Open& parent = open_.back();
  if (!parent.node.is_map()) {
    parent.node.items.push_back(std::move(node));
  } else if (!parent.has_key) {
    PlaceKey(node, parent);
  } else {
    if (node.type == YamlNode::Type::kNull) node.at = parent.key.at;  // it stands nowhere itself
    parent.node.keys.push_back(std::move(parent.key));
    parent.node.items.push_back(std::move(node));
    parent.has_key = false;
  }
}

}  // namespace reckon::harness

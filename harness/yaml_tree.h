#pragma once

#include <yaml-cpp/eventhandler.h>

#include <map>
#include <string>
#include <vector>

#include "reckon/harness/yaml_node.h"

namespace reckon::harness {

/// Builds a tree from the parser's events, and refuses on the way (InputError) what a scenario may
/// not hold: a key twice, a second document, tags, more than 64 levels or 100,000 values (which
/// anchors can reach with few bytes), an anchor inside itself.
class YamlTreeBuilder : public YAML::EventHandler {
 public:
  YamlTreeBuilder(Location whole, int layer) : whole_(std::move(whole)), layer_(layer) {}

  /// The document; nothing in it if there was none.
  YamlNode Take() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark& mark) override;
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override;
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override;
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override;
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value style) override;
  void OnSequenceEnd() override { Close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value style) override;
  void OnMapEnd() override { Close(); }

  /// Where a mark of the parser is, in our counting; an option of the command line has no places.
  Location Where(const YAML::Mark& mark) const;

 private:
  /// A list or map whose end has not come yet.
  struct Open {
    YamlNode node;
    YAML::anchor_t anchor = 0;
    bool has_key = false;  ///< a map: `key` waits for its value
    YamlNode::Key key;
  };

  void Start(YamlNode::Type type, const YAML::Mark& mark, const std::string& tag,
             YAML::anchor_t anchor);
  void Close();
  /// Puts a finished value where it belongs.
  void Place(YamlNode node, YAML::anchor_t anchor);
  void PlaceKey(const YamlNode& node, Open& map) const;
  void Count(const Location& at, std::size_t values);

  Location whole_;
  int layer_;
  bool started_ = false;
  std::size_t count_ = 0;
  YamlNode root_;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, YamlNode> anchors_;
};

}  // namespace reckon::harness

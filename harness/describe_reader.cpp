#include "reckon/harness/describe_reader.h"

namespace reckon::harness {

const YamlNode* MapReader::Take(const char* key, Need need) {
  known_.emplace_back(key);
  const YamlNode* node = node_.Find(key);
  if (node == nullptr && need != Need::kOptional) {
    problems_.Add(node_.at, "'" + path_ + "' needs the key '" + key + "'");
  }
  return node;
}

bool MapReader::CheckName(const YamlNode::Key& key, const std::string& path) const {
  if (IsName(key.name)) return true;
  problems_.Add(key.at, "'" + Shown(key.name) + "' in '" + path +
                            "': expected a name of at most 64 letters, digits, '_' and '-'");
  return false;
}

void MapReader::Finish(const std::map<std::string, std::string>& kinds_of_keys) const {
  if (takes_all_) return;
  const YamlNode* kind = kind_key_.empty() ? nullptr : node_.Find(kind_key_);
  for (std::size_t i = 0; i < node_.keys.size(); ++i) {
    const auto& [key, at] = node_.keys[i];
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    const auto other = kinds_of_keys.find(key);
    if (other == kinds_of_keys.end()) {
      const std::string place = path_.empty() ? "/" : path_;
      problems_.Add(
          at, "unknown key '" + Shown(key) + "' in '" + place + "'" + DidYouMean(key, known_));
      continue;
    }
    // A kind chosen above the layer of this key leaves the old kind's keys behind.
    if (!kind_is_known_ || (kind != nullptr && kind->layer > node_.items[i].TopLayer())) continue;
    problems_.Add(at, "key '" + key + "' in '" + path_ + "' belongs to " + kind_key_ + " " +
                          other->second + ", not to '" + kind_name_ + "'");
  }
}

}  // namespace reckon::harness

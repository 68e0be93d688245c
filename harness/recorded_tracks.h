#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "reckon/ground_truth/track.h"

namespace reckon::harness {

/// The tracks that a recording holds, by estimator: what was recorded of truth and of each
/// estimate, paired as during the run. Truth of a log may have holes (`with_holes`). Throws
/// RecordingError.
std::map<std::string, ground_truth::Track> ReadTracks(const std::filesystem::path& recording,
                                                      bool with_holes = false);

}  // namespace reckon::harness

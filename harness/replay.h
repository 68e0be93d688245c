#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "reckon/ground_truth/run_recorder.h"
#include "reckon/ground_truth/track.h"
#include "reckon/harness/scenario.h"

namespace reckon::harness {

/// The tracks that a recording holds, by estimator: what was recorded of truth and of each
/// estimate, paired as during the run. Throws RecordingError.
std::map<std::string, ground_truth::Track> ReadTracks(const std::filesystem::path& recording);

/// Runs the estimators of `scenario` over the measurements of a recording, in their order of
/// arrival and from the recorded priors, and records what they say. Of truth it reads nothing.
/// Throws RecordingError, and std::invalid_argument if the recording has no measurements.
void Replay(const std::filesystem::path& recording, const Scenario& scenario,
            ground_truth::RunRecorder& recorder);

}  // namespace reckon::harness

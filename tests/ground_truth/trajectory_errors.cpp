// trajectory_errors make TRUTH.tum ESTIMATE.tum: exports a run whose estimate drifts.
// trajectory_errors TRUTH.tum ESTIMATE.tum: prints our statistics of every configuration as JSON.

#include <cmath>
#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "ground_truth/tracks.h"
#include "reckon/ground_truth/alignment.h"
#include "reckon/ground_truth/ate.h"
#include "reckon/ground_truth/rpe.h"
#include "reckon/ground_truth/statistics.h"
#include "reckon/ground_truth/tum.h"

namespace reckon::ground_truth {
namespace {

using nlohmann::ordered_json;

/// A minute around the circle at 20 Hz: the estimate starts elsewhere, and its heading, scale and
/// noise are off.
void Make(const std::string& truth_path, const std::string& estimate_path) {
  std::mt19937_64 generator(11);
  std::normal_distribution<double> normal;
  TumWriter truth_file(truth_path), estimate_file(estimate_path);
  const models::Pose start{testing::Rot(0.3, {0.1, -0.2, 1.0}), {1.0, -2.0, 0.5}};
  for (int k = 0; k < 1200; ++k) {
    const Truth truth = testing::CircleTruth(k * 50'000'000LL);
    models::Pose error{testing::Rz(2e-5 * k), Eigen::Vector3d::Zero()};
    error.R *= testing::Rot(2e-3 * normal(generator), {1.0, 1.0, 1.0});
    models::Pose estimate = start * error * truth.X_WB;
    estimate.p =
        1.01 * estimate.p + 0.01 * Eigen::Vector3d(normal(generator), normal(generator), 0);
    truth_file.Add(truth.t_ns, truth.X_WB);
    estimate_file.Add(truth.t_ns, estimate);
  }
  truth_file.Close();
  estimate_file.Close();
}

Track Pair(const std::string& truth_path, const std::string& estimate_path) {
  const auto truth = ReadTum(truth_path), estimate = ReadTum(estimate_path);
  Track track;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    Truth t;
    estimator::Estimate e;
    t.t_ns = e.t_ns = truth[i].t_ns;
    t.X_WB = truth[i].X_WB;
    e.X_WB = estimate.at(i).X_WB;
    track.Add(t, e);
  }
  return track;
}

ordered_json ToJson(const std::vector<double>& errors) {
  const Statistics s = Summarise(errors);
  return {{"rmse", s.rmse}, {"mean", s.mean}, {"median", s.median}, {"std", s.std},
          {"min", s.min},   {"max", s.max},   {"sse", s.sse}};
}

/// The keys are evo's own flags.
ordered_json Errors(const Track& track) {
  ordered_json json;
  const std::vector<std::pair<std::string, Alignment>> alignments{
      {"", Alignment::kNone},
      {"--align_origin", Alignment::kFirstPose},
      {"--align", Alignment::kSe3},
      {"--align --correct_scale", Alignment::kSim3}};
  for (const auto& [flags, alignment] : alignments) {
    const auto errors = AbsoluteError(track.samples(), Align(alignment, track.samples()));
    json["ape"][flags] = {{"trans_part", ToJson(errors.position_m)},
                          {"angle_deg", ToJson(errors.orientation_deg)}};
  }
  for (const PairChoice choice : {PairChoice::kConsecutive, PairChoice::kAll}) {
    const std::string suffix = choice == PairChoice::kAll ? " --all_pairs" : "";
    const auto add = [&](const std::string& delta, const IndexPairs& pairs) {
      const RelativeErrors errors = RelativeError(track.samples(), pairs);
      json["rpe"]["--pairs_from_reference " + delta + suffix] = {
          {"trans_part", ToJson(errors.translation_m)}, {"angle_deg", ToJson(errors.rotation_deg)}};
    };
    add("--delta 7 --delta_unit f", PairsByFrames(track.samples().size(), 7, choice));
    add("--delta 1 --delta_unit m", PairsByPath(track.samples(), 1.0, choice));
    add("--delta 10 --delta_unit m", PairsByPath(track.samples(), 10.0, choice));
  }
  return json;
}

}  // namespace
}  // namespace reckon::ground_truth

int main(int argc, char** argv) {
  try {
    if (argc == 4 && std::string(argv[1]) == "make") {
      reckon::ground_truth::Make(argv[2], argv[3]);
    } else if (argc == 3) {
      const auto track = reckon::ground_truth::Pair(argv[1], argv[2]);
      std::printf("%s\n", reckon::ground_truth::Errors(track).dump(1).c_str());
    } else {
      return 2;
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}

#pragma once

#include <Eigen/Core>
#include <atomic>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "reckon/ground_truth/track.h"
#include "reckon/harness/experiment.h"
#include "reckon/harness/robot_file.h"
#include "reckon/harness/scenario.h"

namespace reckon::harness {

/// The tracks of one run by estimator, nothing written.
inline std::map<std::string, ground_truth::Track> TracksOf(const Scenario& scenario) {
  const Robot robot = LoadRobot(scenario);
  Experiment experiment(scenario, robot, nullptr);
  experiment.Run({});
  return experiment.TakeTracks();
}

/// Runs seeds 1 … `count` of `scenario` on two threads and hands each run's tracks to `use`, in
/// whatever order they end; calls of `use` do not overlap.
inline void ForSeeds(
    const Scenario& scenario, int count,
    const std::function<void(int, const std::map<std::string, ground_truth::Track>&)>& use) {
  std::atomic<int> next{1};
  std::mutex mutex;
  const auto work = [&] {
    for (int seed = next++; seed <= count; seed = next++) {
      Scenario mine = scenario;
      mine.seed = static_cast<std::uint64_t>(seed);
      const auto tracks = TracksOf(mine);
      const std::scoped_lock lock(mutex);
      use(seed, tracks);
    }
  };
  const std::jthread other(work);
  work();
}

/// NEES of one block at `times` evenly spaced instants up to the end of the track.
inline Eigen::RowVectorXd NeesAtTimes(const ground_truth::Track& track, int block, int times) {
  Eigen::RowVectorXd row(times);
  const auto& samples = track.samples();
  for (int k = 0; k < times; ++k) {
    const std::size_t i = samples.size() * static_cast<std::size_t>(k + 1) / times - 1;
    row[k] = samples[i].nees.value[static_cast<std::size_t>(block)];
  }
  return row;
}

}  // namespace reckon::harness

#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>

namespace reckon::harness {

/// Time spent in one kind of call.
struct CallCost {
  std::uint64_t calls = 0;
  double total_s = 0.0;

  double mean_us() const { return calls == 0 ? 0.0 : 1e6 * total_s / static_cast<double>(calls); }
};

/// What one estimator costs.
struct EstimatorCost {
  CallCost propagations;  ///< calls with an IMU sample
  CallCost corrections;   ///< calls with any other sample

  double mean_us() const {
    const CallCost all{propagations.calls + corrections.calls,
                       propagations.total_s + corrections.total_s};
    return all.mean_us();
  }
};

/// Where the wall time of a run went. Times live in run.json alone: they are never the same twice.
struct Costs {
  double wall_s = 0.0;
  double simulated_s = 0.0;
  double setup_s = 0.0;
  double physics_s = 0.0;  ///< world and driver
  double sensors_s = 0.0;
  double estimators_s = 0.0;
  double recording_s = 0.0;
  double scoring_s = 0.0;
  std::map<std::string, EstimatorCost> estimators;

  double real_time_factor() const { return wall_s > 0.0 ? simulated_s / wall_s : 0.0; }
};

/// Adds the time since the last lap to one place after another.
class LapTimer {
 public:
  void Lap(double& place) {
    const auto now = Clock::now();
    place += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
};

}  // namespace reckon::harness

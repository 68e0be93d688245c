#include "reckon/harness/experiment.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reckon/harness/beliefs.h"

namespace reckon::harness {
namespace {

/// Truth is kept this much longer than the slowest message travels: a belief carries the stamp of
/// the sample that moved it.
constexpr double kTruthMarginS = 2.0;

/// Steps between two looks at the clock and the stop flag.
constexpr std::int64_t kStepsPerCheck = 256;

std::size_t HistorySize(const Scenario& scenario) {
  double slowest_s = 0.0;
  for (const auto& [name, sensor] : scenario.sensors) {
    const sim::Timing& timing = std::visit(
        [](const auto& errors) -> const sim::Timing& { return errors.timing; }, sensor.errors);
    double extra_s = 0.0;
    for (const sim::FaultConfig& fault : scenario.faults) {
      if (fault.sensor == name && fault.kind == sim::FaultKind::kExtraDelay) {
        extra_s += fault.magnitude;
      }
    }
    slowest_s = std::max(slowest_s, timing.latency_s + std::abs(timing.stamp_error_s) + extra_s);
  }
  const double seconds = kTruthMarginS + slowest_s;
  return static_cast<std::size_t>(std::ceil(seconds / scenario.world.physics_step_s)) + 1;
}

void Poison(ground_truth::Truth& truth) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  truth.X_WB.R.setConstant(nan);
  truth.X_WB.p.setConstant(nan);
  truth.v_WB.setConstant(nan);
  truth.w_WB_B.setConstant(nan);
  truth.gyro_bias_rad_s.setConstant(nan);
  truth.accel_bias_m_s2.setConstant(nan);
}

}  // namespace

Experiment::Experiment(const Scenario& scenario, const Robot& robot,
                       ground_truth::RunRecorder* recorder, const std::atomic<bool>* stop)
    : scenario_(scenario),
      recorder_(recorder),
      stop_(stop),
      world_(robot.simulated, scenario.world, scenario.seed),
      sensors_(robot.sensors, scenario.faults, scenario.seed, world_.environment()),
      truth_(HistorySize(scenario)),
      bench_(scenario, robot.nominal, recorder, stop) {
  bench_.set_truth(&truth_);
  timer_.Lap(costs_.setup_s);
}

ground_truth::Truth Experiment::TruthNow() const {
  ground_truth::Truth truth = world_.TruthNow();
  truth.gyro_bias_rad_s = sensors_.gyro_bias();
  truth.accel_bias_m_s2 = sensors_.accel_bias();
  return truth;
}

void Experiment::Step(bool first, bool poison) {
  world_.Advance();
  costs_.simulated_s = models::Seconds(world_.motion().t_ns);
  timer_.Lap(costs_.physics_s);
  sent_.clear();
  sensors_.Observe(world_.motion(), sent_);
  timer_.Lap(costs_.sensors_s);
  ground_truth::Truth truth = TruthNow();
  if (first) {
    bench_.Start(DrawPrior(truth, scenario_.initial, scenario_.seed));
    timer_.Lap(costs_.setup_s);
  }
  if (poison) Poison(truth);
  truth_.Add(truth);
  if (recorder_ != nullptr) recorder_->Add(truth);
  timer_.Lap(costs_.recording_s);
  for (const auto& measurement : sent_) queue_.Send(measurement);
  if (!queue_.HasArrived(truth.t_ns)) return;
  while (queue_.HasArrived(truth.t_ns)) bench_.Deliver(queue_.Take());
  timer_.Lap(costs_.estimators_s);
}

bool Experiment::Run(const Hooks& hooks) {
  const auto steps = static_cast<std::int64_t>(
      std::llround(scenario_.duration_s / scenario_.world.physics_step_s));
  for (std::int64_t k = 0; k <= steps; ++k) {
    Step(k == 0, hooks.poison_truth);
    if (k % kStepsPerCheck != 0) continue;
    if (stop_ != nullptr && *stop_) return false;
    const double spent =
        costs_.physics_s + costs_.sensors_s + costs_.recording_s + costs_.estimators_s;
    if (hooks.progress && spent > 0.0) {
      hooks.progress(static_cast<double>(k) / static_cast<double>(steps + 1),
                     costs_.simulated_s / spent);
    }
  }
  bench_.Finish();
  timer_.Lap(costs_.estimators_s);
  bench_.AddCosts(costs_);
  return true;
}

}  // namespace reckon::harness

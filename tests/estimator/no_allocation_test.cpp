#include <gtest/gtest.h>

#include "estimator/quadruped.h"
#include "estimator/simulated_drive.h"
#include "models/allocations.h"

namespace reckon::estimator {
namespace {

using testing_estimator::kMs;
using testing_estimator::Make;
using testing_estimator::Measurement;
using testing_estimator::TimeNs;
using testing_models::allocations;

TEST(NoAllocation, TheCounterCounts) {
  allocations = 0;
  int* volatile kept = new int(1);  // volatile: a pair that nobody sees may be left out
  const long by_new = allocations;
  delete kept;
  allocations = 0;
  Eigen::MatrixXd dynamic(30, 30);
  double* volatile data = dynamic.data();
  const long by_eigen = allocations;
  EXPECT_NE(data, nullptr);
  EXPECT_EQ(by_new, 1);
  EXPECT_EQ(by_eigen, 1);
}

/// Everything that can come in: good, waiting, late, broken, after a gap, saturated.
std::vector<Measurement> Everything(const estimator::Setup& setup) {
  std::vector<Measurement> all;
  testing_estimator::SimulatedDrive drive(setup, 7);
  for (int i = 1; i <= 1000; ++i) {
    Measurement imu = drive.Advance();
    if (i > 500 && i < 540) continue;  // a dropout
    auto& sample = std::get<models::ImuSample>(imu.sample);
    sample.accel_saturated = i % 50 == 0;
    if (i % 77 == 0) sample.gyro_rad_s.x() = std::nan("");
    const TimeNs t = imu.valid_ns;
    if (i % 4 == 0) all.push_back(testing_estimator::WheelsAt(t + (i % 3 - 1) * 4 * kMs, 1, 2));
    if (i % 10 == 0) all.push_back(drive.Velocity(0.02));
    if (i % 40 == 0) all.push_back(testing_estimator::VelocityAt(t, {100, 0, 0}));
    if (i % 60 == 0) all.push_back(testing_estimator::WheelsAt(t - 50 * kMs, 1, 1));
    all.push_back(imu);
  }
  return all;
}

TEST(NoAllocation, InAnyStepOfAnyEstimator) {
  for (const auto kind : {InitialisationKind::kPrior, InitialisationKind::kStatic}) {
    for (const auto action : {GateAction::kReject, GateAction::kInflate}) {
      auto setup = testing_estimator::TestSetup();
      setup.gate.action = action;
      setup.initialisation = {kind, 0.1};
      const std::vector<Measurement> all = Everything(setup);
      for (const RegistryEntry& entry : Registry()) {
        auto estimator = Make(std::string(entry.name), setup);
        double sum = 0.0;
        allocations = 0;
        for (const Measurement& measurement : all) {
          const Report report = estimator->Process(measurement);
          const auto belief = estimator->Belief();
          const auto before = estimator->BeliefAt(measurement.valid_ns - 30 * kMs);
          const auto after = estimator->BeliefAt(measurement.valid_ns + 7 * kMs);
          for (const auto& told : {belief, before, after}) sum += told ? told->v_WB.x() : 0.0;
          sum += static_cast<double>(report.corrections().size());
        }
        const long counted = allocations;
        EXPECT_EQ(counted, 0) << entry.name;
        EXPECT_TRUE(std::isfinite(sum));
      }
    }
  }
}

TEST(NoAllocation, WithFeetThatComeAndGo) {
  estimator::Setup setup = testing_estimator::QuadrupedSetup();
  setup.floor.use = true;
  setup.noise.floor_height_m = 0.01;
  std::vector<Measurement> all;
  for (int i = 1; i <= 200; ++i) {
    const TimeNs t = i * 5 * kMs;
    all.push_back(testing_estimator::RestingImu(t));
    all.push_back(testing_estimator::ContactsAt(t, i % 20 < 10, i % 20 >= 10, i % 30 < 15, true));
    all.push_back(testing_estimator::JointsAt(t, testing_estimator::Stance()));
  }
  for (const char* name : {"inekf", "iterated_inekf", "mekf"}) {
    auto estimator = Make(name, setup);
    std::size_t corrections = 0;
    allocations = 0;
    for (const Measurement& m : all) {
      const Report report = estimator->Process(m);
      corrections += report.corrections().size();
    }
    const long counted = allocations;
    EXPECT_EQ(counted, 0) << name;
    EXPECT_GT(corrections, 200u) << name;
  }
}

}  // namespace
}  // namespace reckon::estimator

#include "reckon/estimator/registry.h"

#include <array>

#include "reckon/estimator/imu_filter.h"
#include "reckon/estimator/wheel_odometry.h"

namespace reckon::estimator {
namespace {

template <class T>
std::unique_ptr<Estimator> Make(const Setup& setup) {
  return std::make_unique<T>(setup);
}

std::unique_ptr<Estimator> MakeInvariant(const Setup& setup) {
  Setup once = setup;
  once.iterations = 1;
  if (setup.error == ErrorForm::kLeftInvariant) return Make<ImuFilter<LeftInvariantEkf>>(once);
  return Make<ImuFilter<RightInvariantEkf>>(once);
}

constexpr std::array<RegistryEntry, 4> kEntries{{
    {"inekf", "Invariant EKF with IMU biases, right- or left-invariant", MakeInvariant},
    {"iterated_inekf", "Right-invariant EKF that repeats each correction from its own result",
     Make<ImuFilter<RightInvariantEkf>>},
    {"mekf", "Multiplicative EKF, the classical baseline: same inputs, noise and gates",
     Make<ImuFilter<MultiplicativeEkf>>},
    {"odometry", "Planar wheel odometry without covariance", Make<WheelOdometry>},
}};

}  // namespace

std::span<const RegistryEntry> Registry() { return kEntries; }

const RegistryEntry* FindEstimator(std::string_view name) {
  for (const RegistryEntry& entry : kEntries) {
    if (entry.name == name) return &entry;
  }
  return nullptr;
}

}  // namespace reckon::estimator

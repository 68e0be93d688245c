#include "reckon/estimator/held_sample.h"

namespace reckon::estimator {
namespace {

using models::TimeNs;

/// A motion nobody saw, one sigma of a constant rate beside the held sample.
constexpr double kUnseenRate = 0.5;  ///< rad/s
/// A clipped sample says little: its noise is taken this many times larger.
constexpr double kSaturatedFactor = 100.0;

}  // namespace

void HeldSample::Start(TimeNs t_ns) {
  covered_from_ns_ = t_ns;
  seconds_ = unseen_s_ = 0.0;
}

void HeldSample::Take(TimeNs t_ns, TimeNs valid_ns, const models::ImuSample& sample,
                      const Eigen::Matrix3d& R_IS) {
  // Stamps that jitter by less than half a sample are taken at their word: the sample covers what
  // lies between them.
  const TimeNs from_ns = valid_ns - sample.interval_ns;
  const bool gap = from_ns - t_ns > sample.interval_ns / 2;
  Coast(t_ns, gap ? from_ns : t_ns);
  gyro_ = R_IS * sample.gyro_rad_s;
  accel_ = R_IS * sample.accel_m_s2;
  seconds_ = models::Seconds(sample.interval_ns);
  gyro_saturated_ = sample.gyro_saturated;
  accel_saturated_ = sample.accel_saturated;
}

void HeldSample::Coast(TimeNs from_ns, TimeNs to_ns) {
  covered_from_ns_ = to_ns;
  unseen_s_ = models::Seconds(to_ns - from_ns);
}

ProcessNoise HeldSample::NoiseAt(TimeNs t_ns, const ProcessNoise& seen) const {
  ProcessNoise noise = seen;
  if (t_ns < covered_from_ns_) {
    noise.gyro += kUnseenRate * kUnseenRate * unseen_s_;
    noise.accel += kUnseenAcceleration * kUnseenAcceleration * unseen_s_;
    return noise;
  }
  if (gyro_saturated_) noise.gyro *= kSaturatedFactor * kSaturatedFactor;
  if (accel_saturated_) noise.accel *= kSaturatedFactor * kSaturatedFactor;
  return noise;
}

}  // namespace reckon::estimator

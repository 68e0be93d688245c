#include "reckon/harness/beliefs.h"

#include <array>
#include <numbers>

#include "reckon/estimator/so3.h"
#include "reckon/sim/random_stream.h"

namespace reckon::harness {
namespace {

using estimator::ErrorVector;

/// The mounting that an estimator is made to believe, off by a deliberate error.
models::Pose Misplaced(const models::Pose& X_BS, const std::array<double, 6>& error) {
  const Eigen::Vector3d offset(error[0], error[1], error[2]);
  const Eigen::Vector3d turn =
      Eigen::Vector3d(error[3], error[4], error[5]) * (std::numbers::pi / 180.0);
  return {estimator::Exp(turn) * X_BS.R, X_BS.p + offset};
}

/// Standard deviations of P₀ in the order of the error vector. World axes: yaw is about z.
ErrorVector Sigmas(const estimator::PriorSigma& sigma) {
  ErrorVector s;
  s.segment<3>(estimator::kTheta) << sigma.roll_pitch_rad, sigma.roll_pitch_rad, sigma.yaw_rad;
  s.segment<3>(estimator::kVelocity).setConstant(sigma.velocity_m_s);
  s.segment<3>(estimator::kPosition).setConstant(sigma.position_m);
  s.segment<3>(estimator::kGyroBias).setConstant(sigma.gyro_bias_rad_s);
  s.segment<3>(estimator::kAccelBias).setConstant(sigma.accel_bias_m_s2);
  return s;
}

}  // namespace

estimator::Setup MakeSetup(const EstimatorConfig& config, const InitialConfig& initial,
                           const models::Suite& nominal, double gravity_m_s2) {
  estimator::Setup setup;
  setup.suite = nominal;
  for (const auto& [sensor, error] : config.mounting_error) {
    if (const auto id = nominal.Find(sensor)) {
      models::Pose& X_BS = setup.suite.sensors[*id].X_BS;
      X_BS = Misplaced(X_BS, error);
      // Wheels are used in the drive's frame, not in that of their encoders.
      auto& wheels = setup.suite.wheels;
      if (wheels && wheels->encoders == sensor) wheels->X_BS = Misplaced(wheels->X_BS, error);
    }
  }
  setup.error = config.error;
  setup.noise = config.noise;
  setup.gate = config.gate;
  setup.initialisation = config.initialisation;
  setup.iterations = config.iterations;
  setup.history_s = config.history_s;
  setup.standstill = config.standstill;
  setup.floor = config.floor;
  setup.feet = config.feet;
  setup.leg_correction = config.leg_correction;
  setup.contacts = config.contacts;
  setup.slip = config.slip;
  setup.gyro_filter = config.gyro_filter;
  setup.prior_sigma = initial.sigma;
  setup.gravity_m_s2 = gravity_m_s2;
  setup.estimate_gyro_bias = config.estimate_gyro_bias;
  setup.estimate_accel_bias = config.estimate_accel_bias;
  return setup;
}

estimator::Prior DrawPrior(const ground_truth::Truth& truth, const InitialConfig& initial,
                           std::uint64_t seed) {
  const ErrorVector sigma = Sigmas(initial.sigma);
  ErrorVector error = ErrorVector::Zero();
  if (initial.sample_error) {
    const sim::RandomStream stream(seed, "initial_error");
    for (int i = 0; i < estimator::kErrorSize; ++i) {
      error[i] = sigma[i] * stream.Normal(static_cast<std::uint32_t>(i), 0);
    }
  }
  const Eigen::Vector3d theta = error.segment<3>(estimator::kTheta);
  const Eigen::Matrix3d turn = estimator::Exp(theta);
  const Eigen::Matrix3d J = estimator::LeftJacobian(theta);
  estimator::Prior prior;
  prior.t_ns = truth.t_ns;
  prior.X_WB.R = turn * truth.X_WB.R;
  prior.v_WB = turn * truth.v_WB + J * error.segment<3>(estimator::kVelocity);
  prior.X_WB.p = turn * truth.X_WB.p + J * error.segment<3>(estimator::kPosition);
  prior.w_WB_B = truth.w_WB_B;
  prior.gyro_bias_rad_s = truth.gyro_bias_rad_s + error.segment<3>(estimator::kGyroBias);
  prior.accel_bias_m_s2 = truth.accel_bias_m_s2 + error.segment<3>(estimator::kAccelBias);
  prior.covariance = sigma.cwiseAbs2().asDiagonal();
  return prior;
}

}  // namespace reckon::harness

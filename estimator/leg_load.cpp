#include "reckon/estimator/leg_load.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>

namespace reckon::estimator {

using models::LegVector;

LegVector LegLoad::Lacking(const LegReading& r, double dt_s, const ContactDetection& told,
                           const models::LegDynamics& dynamics) {
  const LegVector none = LegVector::Zero(r.q.size());
  const bool first = dq_.size() == 0 || dt_s <= 0.0;
  if (told.force == ForceModel::kStatic || first) {
    const models::BodyMotion rest{.specific_force_m_s2 = r.body.specific_force_m_s2};
    const LegVector torque = dynamics.InverseDynamics(r.q, none, none, rest);
    dq_ = r.dq;
    if (told.force == ForceModel::kMomentum) {
      M_ = dynamics.MassMatrix(r.q);
      momentum_ = M_ * r.dq;
      driving_ = r.torque_n_m - torque;
    }
    return torque - r.torque_n_m;
  }
  if (told.force == ForceModel::kInertia) {
    const LegVector ddq = (r.dq - dq_) / dt_s;
    dq_ = r.dq;
    return dynamics.InverseDynamics(r.q, r.dq, ddq, r.body) - r.torque_n_m;
  }
  const models::LegDynamics::Matrix M = dynamics.MassMatrix(r.q);
  const LegVector h = dynamics.InverseDynamics(r.q, r.dq, none, r.body);
  const LegVector driving = r.torque_n_m - h + (M - M_) * r.dq / dt_s;
  const LegVector p = M * r.dq;
  M_ = M;
  // A pole's output lags a ramp by slope · dt · decay / (1 − decay): the gain that makes K (p − p̂)
  // the slope itself.
  const double decay = std::exp(-2.0 * std::numbers::pi * told.observer_hz * dt_s);
  momentum_ = p + decay * (momentum_ - p);
  driving_ = driving + decay * (driving_ - driving);
  return (1.0 - decay) / (decay * dt_s) * (p - momentum_) - driving_;
}

Eigen::Vector3d LegLoad::Force(const LegReading& reading, double dt_s, const ContactDetection& told,
                               const models::FootPosition& foot,
                               const models::LegDynamics& dynamics) {
  // Jᵀ f = lacking, by least squares for legs of more than three joints; a stretched leg keeps the
  // force along it finite.
  constexpr double kSingular = 1e-6;  // m²
  const Eigen::Vector3d right = foot.J * Lacking(reading, dt_s, told, dynamics);
  const Eigen::Matrix3d JJ = foot.J * foot.J.transpose() + kSingular * Eigen::Matrix3d::Identity();
  return JJ.ldlt().solve(right);
}

}  // namespace reckon::estimator

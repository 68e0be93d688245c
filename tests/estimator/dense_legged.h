#pragma once

#include <vector>

#include "estimator/reference.h"
#include "reckon/estimator/contact_model.h"
#include "reckon/estimator/covariance.h"

/// The dense textbook with feet, in long double: θ, v, p, the feet that stand, and the biases.
namespace reckon::testing_estimator {

struct LeggedState {
  State body;
  std::vector<Vec3> feet;
};

/// How a foot's middle is said to move over a step, in the axes of I: u = ω × lever.
struct Roll {
  Vec3 u, lever;
};

/// The state after an IMU sample held over dt. Feet roll as told at the rate of `w_told`; where the
/// true rate is another, they roll with that.
inline LeggedState Step(const LeggedState& x, const Vec3& gyro, const Vec3& accel, Real dt,
                        Real gravity, const std::vector<Roll>& rolls, const Vec3& w_told) {
  LeggedState next = x;
  next.body = Step(x.body, gyro, accel, dt, gravity);
  const Vec3 w = gyro - x.body.bg;
  for (std::size_t i = 0; i < rolls.size(); ++i) {
    const Vec3 u = rolls[i].u + (w - w_told).cross(rolls[i].lever);
    next.feet[i] += x.body.R * Series(1, w * dt) * u * dt;
  }
  return next;
}

/// A foot's error is a position's.
inline State AtFoot(const LeggedState& x, std::size_t foot) {
  State moved = x.body;
  moved.p = x.feet[foot];
  return moved;
}

inline VecX Error(ErrorForm form, const LeggedState& hat, const LeggedState& x) {
  const Vec15 body = Error(form, hat.body, x.body);
  const Eigen::Index feet = static_cast<Eigen::Index>(x.feet.size());
  VecX e(15 + 3 * feet);
  e.head<9>() = body.head<9>();
  for (Eigen::Index i = 0; i < feet; ++i) {
    e.segment<3>(9 + 3 * i) = Error(form, AtFoot(hat, i), AtFoot(x, i)).segment<3>(6);
  }
  e.tail<6>() = body.tail<6>();
  return e;
}

inline LeggedState TruthBehind(ErrorForm form, const LeggedState& hat, const VecX& e) {
  Vec15 body;
  body << e.head<9>(), e.tail<6>();
  LeggedState x = hat;
  x.body = TruthBehind(form, hat.body, body);
  for (std::size_t i = 0; i < hat.feet.size(); ++i) {
    body.segment<3>(6) = e.segment<3>(9 + 3 * static_cast<Eigen::Index>(i));
    x.feet[i] = TruthBehind(form, AtFoot(hat, i), body).p;
  }
  return x;
}

/// Belief of the reference: mean and covariance in the coordinates of a form.
struct LeggedBelief {
  ErrorForm form;
  LeggedState x;
  MatX P;

  Eigen::Index size() const { return P.rows(); }

  /// One IMU sample held over dt; a foot slips as white noise of that density. The sample's noise
  /// acts as a bias that lives one step: Φ's bias columns, less the bias itself.
  void Propagate(const Vec3& gyro, const Vec3& accel, Real dt, Real gravity,
                 const estimator::ProcessNoise& noise, Real slip = 0,
                 const std::vector<Roll>& rolls = {}) {
    const Vec3 w_told = gyro - x.body.bg;
    const LeggedState next = Step(x, gyro, accel, dt, gravity, rolls, w_told);
    const MatX Phi = DifferencesAtZero(
        [&](const VecX& e) -> VecX {
          const LeggedState truth = TruthBehind(form, x, e);
          return Error(form, next, Step(truth, gyro, accel, dt, gravity, rolls, w_told));
        },
        size());
    VecX q = VecX::Zero(size());
    q.segment<3>(size() - 6).setConstant(noise.gyro / dt);
    q.tail<3>().setConstant(noise.accel / dt);
    MatX J = Phi;
    J.bottomRows<6>().setZero();
    P = (Phi * P * Phi.transpose() + J * q.asDiagonal() * J.transpose()).eval();
    P.diagonal().segment(9, size() - 15).array() += slip * slip * dt;
    P.diagonal().segment<3>(size() - 6).array() += noise.gyro_walk * dt;
    P.diagonal().tail<3>().array() += noise.accel_walk * dt;
    x = next;
  }

  /// All feet in one correction of as many rows.
  void CorrectStacked(const std::vector<estimator::FootReading>& readings) {
    const Eigen::Index rows = 3 * static_cast<Eigen::Index>(readings.size());
    MatX N = MatX::Zero(rows, rows);
    VecX z(rows);
    for (Eigen::Index i = 0; 3 * i < rows; ++i) {
      const auto& reading = readings[static_cast<std::size_t>(i)];
      N.block<3, 3>(3 * i, 3 * i) = x.body.R * reading.N.cast<Real>() * x.body.R.transpose();
      z.segment<3>(3 * i) =
          x.body.R * reading.h.cast<Real>() - (x.feet[static_cast<std::size_t>(i)] - x.body.p);
    }
    // What the feet would read if the truth lay at an error e: z = −H e.
    const MatX H = -DifferencesAtZero(
        [&](const VecX& e) -> VecX {
          const LeggedState truth = TruthBehind(form, x, e);
          VecX read(rows);
          for (Eigen::Index i = 0; 3 * i < rows; ++i) {
            const auto foot = static_cast<std::size_t>(i);
            read.segment<3>(3 * i) =
                x.body.R * truth.body.R.transpose() * (truth.feet[foot] - truth.body.p) -
                (x.feet[foot] - x.body.p);
          }
          return read;
        },
        size());
    const MatX S = H * P * H.transpose() + N;
    const MatX K = P * H.transpose() * S.inverse();
    const MatX A = MatX::Identity(size(), size()) - K * H;
    P = (A * P * A.transpose() + K * N * K.transpose()).eval();
    x = TruthBehind(form, x, -K * z);
  }
};

/// What a filter believes, its active slots in order.
inline LeggedBelief BeliefOf(ErrorForm form, const estimator::NavigationState& x,
                             const estimator::Covariance& P) {
  LeggedBelief belief{form, {Widened(x), {}}, {}};
  const auto slots = P.active();
  belief.P.resize(3 * static_cast<Eigen::Index>(slots.size()),
                  3 * static_cast<Eigen::Index>(slots.size()));
  for (std::size_t i = 0; i < slots.size(); ++i) {
    if (estimator::IsFoot(slots[i])) belief.x.feet.push_back(x.At(slots[i]).cast<Real>());
    for (std::size_t j = 0; j < slots.size(); ++j) {
      belief.P.block<3, 3>(3 * static_cast<Eigen::Index>(i), 3 * static_cast<Eigen::Index>(j)) =
          ToEigen(P.Get(slots[i], slots[j])).cast<Real>();
    }
  }
  return belief;
}

}  // namespace reckon::testing_estimator

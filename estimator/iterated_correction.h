#pragma once

#include "reckon/estimator/kalman.h"
#include "reckon/estimator/linearisation.h"
#include "reckon/estimator/right_invariant_ekf.h"

namespace reckon::estimator {

/// A measurement linearised at exp(ξ) X̂, for the error at X̂: H J(ξ) with the left Jacobian J of the
/// group, exp(ξ + δ) ≈ exp(J δ) exp(ξ), and z + H ξ, as J ξ = ξ. With Γ1 of θ, J is Γ1 on the
/// diagonal and, in the row of a vector ρ, Q = ∂(Γ1 ρ)/∂θ + [Γ1 ρ]× Γ1 at θ. Does not allocate.
template <int kRows>
Linearisation<kRows> MovedToPrior(const Linearisation<kRows>& m, const SlotVector& xi) {
  const RotationSeries theta(ToEigen(xi[kThetaSlot]));
  const Eigen::Matrix3d G1 = theta.Gamma(1);
  Linearisation<kRows> moved;
  moved.z = m.z;
  moved.N = m.N;
  moved.lasting = m.lasting;
  Eigen::Matrix<double, kRows, 3> H_theta = Eigen::Matrix<double, kRows, 3>::Zero();
  for (const Term<kRows>& term : m.terms()) {
    const Eigen::Matrix<double, kRows, 3> H = Dense(term);
    const Eigen::Vector3d rho = ToEigen(xi[term.slot]);
    moved.z += H * rho;
    if (term.slot == kThetaSlot) {
      H_theta += H * G1;
    } else if (term.slot >= kGyroBiasSlot) {
      moved.Block(term.slot, H);
    } else {
      H_theta += H * (theta.GammaDerivative(1, rho) + Skew(G1 * rho) * G1);
      moved.Block(term.slot, H * G1);
    }
  }
  moved.Block(kThetaSlot, H_theta);
  return moved;
}

/// The correction of the iterated EKF: Gauss-Newton from the prior to the most probable state,
///     minimise |ξ|² in P⁻¹ + |z(exp(ξ) X̂)|² in N⁻¹,
/// by ξ ← K (z + H ξ) with model and gain taken anew at each exp(ξ) X̂ [Bell & Cathey 1993, on the
/// group]. `model(x)` is a Linearisation; at most `iterations` of them, fewer once ξ stands still.
/// Where a measurement is linear in ξ, one suffices and this is the ordinary correction. Does not
/// allocate.
template <int kRows, class Model>
void CorrectIterated(RightInvariantEkf& core, const Model& model, int iterations) {
  constexpr double kStandsStill = 1e-10;
  const NavigationState prior = core.x();
  SlotVector xi;
  xi.fill(Lane::All(0.0));
  for (int i = 1;; ++i) {
    const Linearisation<kRows> m = MovedToPrior<kRows>(model(core.x()), xi);
    KalmanCorrection<kRows> kalman(core.P(), m);
    kalman.AddLasting();
    const SlotVector next = kalman.Gain();
    double step = 0.0;
    for (const Slot slot : core.P().active()) {
      step = std::max(step, ToEigen(next[slot] - xi[slot]).cwiseAbs().maxCoeff());
    }
    xi = next;
    core.x() = prior;
    core.Retract(xi);
    if (i == iterations || step < kStandsStill) return kalman.UpdateCovariance(core.P());
  }
}

}  // namespace reckon::estimator

#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <limits>

#include "reckon/estimator/estimate.h"
#include "reckon/estimator/linearisation.h"

namespace reckon::estimator {

/// The part of a correction that no error form changes: what is expected of the innovation, and the
/// exact covariance update.
class KalmanCorrection {
 public:
  /// C = P Hᵀ, S = H C + N and NIS = zᵀ S⁻¹ z of a measurement z = −H ξ + n.
  KalmanCorrection(const ErrorCovariance& P, const Linearisation& m) : m_(m) {
    C_.setZero();
    for (const Block& b : m.blocks()) C_ += P.middleCols<3>(b.slot) * b.H.transpose();
    S_ = Times(C_) + m.N;
    solver_.compute(S_);
    nis_ = solver_.info() == Eigen::Success ? m.z.dot(solver_.solve(m.z))
                                            : std::numeric_limits<double>::quiet_NaN();
  }

  /// Not a number if S is not positive definite.
  double nis() const { return nis_; }
  const Eigen::Matrix3d& S() const { return S_; }

  /// Multiplies the measurement's noise so that NIS falls to `target`; exact for one row, and
  /// conservative for more (S grows as a whole).
  void Inflate(double target) {
    const double factor = nis_ / target;
    extra_ = (factor - 1.0) * S_;
    solver_.compute(factor * S_);
  }

  /// K z with K = C S⁻¹.
  ErrorVector Gain() const { return C_ * solver_.solve(m_.z); }

  /// P⁺ in the structured Joseph form: with M = P − K Cᵀ, P⁺ = M − (M Hᵀ − K N) Kᵀ. Equal to
  /// (I − K H) P (I − K H)ᵀ + K N Kᵀ, whose round-off it keeps, at a third of the cost.
  void UpdateCovariance(ErrorCovariance& P) const {
    const Strip K = solver_.solve(C_.transpose()).transpose();
    P.noalias() -= K.lazyProduct(C_.transpose());
    Strip MHt = Strip::Zero();
    for (const Block& b : m_.blocks()) MHt += P.middleCols<3>(b.slot) * b.H.transpose();
    MHt -= K * (m_.N + extra_);
    P.noalias() -= MHt.lazyProduct(K.transpose());
    P = 0.5 * (P + P.transpose()).eval();
  }

 private:
  using Strip = Eigen::Matrix<double, kErrorSize, 3>;

  /// H C for the strip C = P Hᵀ.
  Eigen::Matrix3d Times(const Strip& C) const {
    Eigen::Matrix3d HC = Eigen::Matrix3d::Zero();
    for (const Block& b : m_.blocks()) HC += b.H * C.middleRows<3>(b.slot);
    return 0.5 * (HC + HC.transpose());
  }

  const Linearisation& m_;
  Strip C_;
  Eigen::Matrix3d S_, extra_ = Eigen::Matrix3d::Zero();
  Eigen::LLT<Eigen::Matrix3d> solver_;
  double nis_ = 0.0;
};

}  // namespace reckon::estimator

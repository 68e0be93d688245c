#pragma once

#include <Eigen/Core>
#include <array>

#include "reckon/estimator/covariance.h"
#include "reckon/estimator/linearisation.h"

namespace reckon::estimator {

/// The part of a correction that no error form changes: what is expected of the innovation, and the
/// exact covariance update. Nothing allocates.
template <int kRows>
class KalmanCorrection {
 public:
  using Matrix = typename Linearisation<kRows>::Matrix;

  /// C = P Hᵀ, S = H C + N and NIS = zᵀ S⁻¹ z of a measurement z = −H ξ + n. Both must outlive it.
  KalmanCorrection(const Covariance& P, const Linearisation<kRows>& m);

  /// Not a number if S is not positive definite.
  double nis() const { return nis_; }
  Matrix S() const { return ToEigen(S_); }

  /// Multiplies the measurement's noise so that NIS falls to `target`; exact for one row, and
  /// conservative for more (S grows as a whole).
  void Inflate(double target);

  /// Adds the measurement's lasting noise, once its NIS has been judged. One row.
  void AddLasting() {
    if constexpr (kRows == 1) {
      if (m_.lasting > 0.0) AddNoise(m_.lasting);
    }
  }

  /// K z with K = C S⁻¹.
  SlotVector Gain() const;

  /// increment ← increment + K z, in the active slots.
  void AddGainTo(SlotVector& increment) const;

  /// P⁺ in the structured Joseph form: with M = P − C Kᵀ, P⁺ = M − (M Hᵀ − K N) Kᵀ. Equal to
  /// (I − K H) P (I − K H)ᵀ + K N Kᵀ, whose round-off it keeps, at a third of the cost. `P` must be
  /// what the correction was made from.
  void UpdateCovariance(Covariance& P) const;

 private:
  void AddNoise(double variance);
  template <class Slots>
  void Update(Covariance& P, Slots slots) const;

  const Linearisation<kRows>& m_;
  const ActiveSlots& slots_;
  Strips<kRows> C_;
  Square<kRows> N_, S_, S_inverse_;
  Row<kRows> z_;
  double nis_;
};

extern template class KalmanCorrection<1>;
extern template class KalmanCorrection<3>;

}  // namespace reckon::estimator

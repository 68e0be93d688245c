#pragma once

#include <array>
#include <cassert>
#include <span>

#include "reckon/estimator/active_slots.h"
#include "reckon/estimator/estimate.h"
#include "reckon/estimator/lane_matrix.h"
#include "reckon/estimator/navigation_state.h"
#include "reckon/estimator/slot.h"

namespace reckon::estimator {

/// The bias columns of a transition Φ and of the noise of a held sample, by row: the accelerometer
/// moves velocity and position alone.
struct BiasColumns {
  std::array<LaneMatrix, kSlots> gyro{};  ///< of θ, v, p and every active foot
  LaneMatrix accel_velocity, accel_position;
};

/// The covariance of an error with fixed slots, of which a list is active: adding or removing a
/// foot moves nothing else. Each pair of slots is kept once, as a 3×3 block. Nothing allocates.
class Covariance {
 public:
  /// θ, v, p and the biases from a dense matrix of 15 coordinates; no feet.
  void Start(const ErrorCovariance& P);

  /// The active slots, in order, and as what loops go over.
  std::span<const Slot> active() const { return slots_.list(); }
  bool IsActive(Slot slot) const { return slots_.Has(slot); }
  const ActiveSlots& slots() const { return slots_; }

  /// The block of a pair in its kept order, i ≤ j.
  LaneMatrix& operator()(Slot i, Slot j) { return Check(i, j), blocks_[i][j]; }
  const LaneMatrix& operator()(Slot i, Slot j) const { return Check(i, j), blocks_[i][j]; }

  /// The block of any pair.
  LaneMatrix Get(Slot i, Slot j) const {
    const LaneMatrix& kept = i <= j ? (*this)(i, j) : (*this)(j, i);
    Lane a = kept.column[0], b = kept.column[1], c = kept.column[2];
    if (i > j) Lane::Transpose(a, b, c);
    return {a, b, c};
  }

  /// e_i ← e_i + M e_j; `M` is what a block can be multiplied with.
  template <class Factor>
  void AddRow(Slot i, const Factor& M, Slot j);

  /// e_i ← M e_i.
  void MapRow(Slot i, const LaneMatrix& M);

  /// The biases' part of a step over `dt`: e ← e + J e_b beside the white noise of a held sample,
  /// which acts as a bias for one step. With B the biases' block, U the bias cross-covariance,
  /// U′ = U + J B and W = (U + U′)/2 + J Q/(2Δt),
  ///     P ← P + W Jᵀ + J Wᵀ,  U ← U′,  B ← B + Q_walk Δt.
  void AddBiases(const BiasColumns& J, const ProcessNoise& noise, double dt);

  /// Makes `foot` a copy of the position's error plus an independent `noise`.
  void AddFoot(Slot foot, const LaneMatrix& noise);

  /// Forgets a foot: what is left is its marginal.
  void RemoveFoot(Slot foot);

  /// θ, v, p and biases as a dense matrix.
  ErrorCovariance Dense() const;

 private:
  static void Check([[maybe_unused]] Slot i, Slot j) {
    assert(i <= j && j < kSlots);
    if (j >= kSlots) __builtin_unreachable();  // so that no loop is compiled for what cannot be
  }

  LaneMatrix blocks_[kSlots][kSlots];  // NOLINT(modernize-avoid-c-arrays): of fixed size in both
  ActiveSlots slots_;
};

template <class Factor>
[[gnu::always_inline]] inline void Covariance::AddRow(Slot i, const Factor& M, Slot j) {
  const LaneMatrix before = M * Get(j, i);
  slots_.loops().ForEach([&](Slot k) RECKON_INLINED {
    if (k < i) (*this)(k, i) += TimesTransposed(Get(k, j), M);
    if (k > i) (*this)(i, k) += M * Get(j, k);
  });
  (*this)(i, i) += M * Get(j, i) + Transposed(before);
}

}  // namespace reckon::estimator

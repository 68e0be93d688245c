#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <span>

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

  /// The active slots, in order.
  std::span<const Slot> active() const { return {active_.data(), size_}; }
  bool IsActive(Slot slot) const;

  /// The block of a pair in its kept order, i ≤ j.
  LaneMatrix& operator()(Slot i, Slot j) { return assert(i <= j), blocks_[i][j]; }
  const LaneMatrix& operator()(Slot i, Slot j) const { return assert(i <= j), blocks_[i][j]; }

  /// The block of any pair.
  LaneMatrix Get(Slot i, Slot j) const {
    return i <= j ? (*this)(i, j) : Transposed((*this)(j, i));
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
  /// Adds X to the block (i, k), i ≠ k.
  void Add(Slot i, Slot k, const LaneMatrix& X) {
    if (i < k) {
      (*this)(i, k) += X;
    } else {
      (*this)(k, i) += Transposed(X);
    }
  }

  LaneMatrix blocks_[kSlots][kSlots];  // NOLINT(modernize-avoid-c-arrays): of fixed size in both
  std::array<Slot, kSlots> active_;
  std::size_t size_ = 0;
};

template <class Factor>
void Covariance::AddRow(Slot i, const Factor& M, Slot j) {
  const LaneMatrix before = M * Get(j, i);
  for (const Slot k : active()) {
    if (k != i) Add(i, k, M * Get(j, k));
  }
  (*this)(i, i) += M * Get(j, i) + Transposed(before);
}

}  // namespace reckon::estimator

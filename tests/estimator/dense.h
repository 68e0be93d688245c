#pragma once

#include "estimator/reference.h"
#include "reckon/estimator/kalman.h"

namespace reckon::testing_estimator {

using estimator::Covariance;
using estimator::ErrorCovariance;
using estimator::ErrorVector;
using estimator::Linearisation;
using estimator::Slot;
using estimator::SlotVector;

/// The covariance of 15 coordinates by slots.
inline Covariance BySlots(const ErrorCovariance& P) {
  Covariance slots;
  slots.Start(P);
  return slots;
}

/// Where a slot without feet lies among the 15 coordinates.
inline int PlaceOf(Slot slot) {
  const bool bias = slot >= estimator::kGyroBiasSlot;
  return bias ? estimator::kGyroBias + 3 * (slot - estimator::kGyroBiasSlot) : 3 * slot;
}

/// H of a measurement without feet.
template <int kRows>
Eigen::Matrix<Real, kRows, 15> DenseH(const Linearisation<kRows>& m) {
  Eigen::Matrix<Real, kRows, 15> H = Eigen::Matrix<Real, kRows, 15>::Zero();
  for (const auto& term : m.terms()) {
    H.template middleCols<3>(PlaceOf(term.slot)) += Dense(term).template cast<Real>();
  }
  return H;
}

/// An increment without feet.
inline ErrorVector DenseIncrement(const SlotVector& increment) {
  ErrorVector dense;
  for (const Slot slot : {estimator::kThetaSlot, estimator::kVelocitySlot, estimator::kPositionSlot,
                          estimator::kGyroBiasSlot, estimator::kAccelBiasSlot}) {
    dense.segment<3>(PlaceOf(slot)) = ToEigen(increment[slot]);
  }
  return dense;
}

}  // namespace reckon::testing_estimator

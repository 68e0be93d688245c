#pragma once

#include <cstdint>

#include "reckon/models/contact_sample.h"

namespace reckon::estimator {

using models::kMaxFeet;

/// Places of three error coordinates each, in the order of the error: θ, v, p, d₁ … d_L, b_g, b_a.
enum Slot : std::uint8_t {
  kThetaSlot,
  kVelocitySlot,
  kPositionSlot,
  kFirstFootSlot,
  kGyroBiasSlot = kFirstFootSlot + kMaxFeet,
  kAccelBiasSlot,
  kSlots
};

constexpr Slot FootSlot(int foot) { return static_cast<Slot>(kFirstFootSlot + foot); }
constexpr bool IsFoot(Slot slot) { return slot >= kFirstFootSlot && slot < kGyroBiasSlot; }

}  // namespace reckon::estimator

#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <span>

#include "reckon/estimator/slot.h"

namespace reckon::estimator {

/// Which slots an error has: θ, v, p and the biases always, feet as they come and go. Loops over
/// them are written once here, with the permanent slots as constants, so that a loop's body is
/// compiled to fixed addresses and only feet are looked up. Nothing allocates.
class ActiveSlots {
 public:
  /// In the error's order.
  std::span<const Slot> list() const { return {slots_.data(), size_}; }
  std::span<const Slot> feet() const { return list().subspan(3, size_ - kPermanent); }
  bool Has(Slot slot) const { return std::find(begin(), end(), slot) != end(); }

  void Add(Slot foot) {
    assert(IsFoot(foot) && !Has(foot));
    const auto place = std::upper_bound(begin(), end(), foot);
    std::copy_backward(place, end(), end() + 1);
    *place = foot;
    ++size_;
  }
  void Remove(Slot foot) {
    assert(IsFoot(foot) && Has(foot));
    std::copy(std::find(begin(), end(), foot) + 1, end(), std::find(begin(), end(), foot));
    --size_;
  }

  /// body(slot) for every slot.
  template <class Body>
  void ForEach(const Body& body) const {
    ForEachUpTo(kAccelBiasSlot, body);
  }

  /// body(slot) for every slot but the biases.
  template <class Body>
  void ForEachMoved(const Body& body) const {
    ForEachUpTo(FootSlot(kMaxFeet - 1), body);
  }

  /// body(slot) for every slot up to and with `last`.
  template <class Body>
  void ForEachUpTo(Slot last, const Body& body) const {
    body(kThetaSlot);
    if (last >= kVelocitySlot) body(kVelocitySlot);
    if (last >= kPositionSlot) body(kPositionSlot);
    if (last >= kFirstFootSlot) {
      for (const Slot foot : feet()) {
        if (foot > last) break;
        body(foot);
      }
    }
    if (last >= kGyroBiasSlot) body(kGyroBiasSlot);
    if (last >= kAccelBiasSlot) body(kAccelBiasSlot);
  }

  /// body(i, j) for every pair i ≤ j, column by column: what a body reads of j stays in registers.
  template <class Body>
  void ForEachPair(const Body& body) const {
    ForEach([&](Slot j) { ForEachUpTo(j, [&](Slot i) { body(i, j); }); });
  }

 private:
  static constexpr std::size_t kPermanent = 5;

  const Slot* begin() const { return slots_.data(); }
  const Slot* end() const { return begin() + size_; }
  Slot* begin() { return slots_.data(); }
  Slot* end() { return begin() + size_; }

  std::array<Slot, kSlots> slots_{kThetaSlot, kVelocitySlot, kPositionSlot, kGyroBiasSlot,
                                  kAccelBiasSlot};
  std::size_t size_ = kPermanent;
};

}  // namespace reckon::estimator

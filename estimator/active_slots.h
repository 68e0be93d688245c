#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <span>

#include "reckon/estimator/always_inline.h"
#include "reckon/estimator/slot.h"

namespace reckon::estimator {

/// A set of slots.
class SlotSet {
 public:
  bool Has(Slot slot) const { return (bits_ >> slot & 1U) != 0U; }
  void Add(Slot slot) { bits_ |= 1U << slot; }
  void Remove(Slot slot) { bits_ &= ~(1U << slot); }
  bool empty() const { return bits_ == 0U; }

 private:
  unsigned bits_ = 0;
};

/// Loops over the slots of an error, unrolled, with every slot a constant: θ, v, p and the biases
/// always, and of the feet those in a set. `kFeet` is false where there are none, and no loop asks.
template <bool kFeet>
class SlotLoops {
 public:
  explicit SlotLoops(SlotSet feet) : feet_(feet) {}

  /// body(slot) for every slot.
  template <class Body>
  [[gnu::always_inline]] void ForEach(const Body& body) const {
    ForEachUpTo(kAccelBiasSlot, body);
  }

  /// body(slot) for every slot but the biases.
  template <class Body>
  [[gnu::always_inline]] void ForEachMoved(const Body& body) const {
    ForEachUpTo(FootSlot(kMaxFeet - 1), body);
  }

  /// body(slot) for every slot up to and with `last`.
  template <class Body>
  [[gnu::always_inline]] void ForEachUpTo(Slot last, const Body& body) const {
    static_assert(kMaxFeet == 4);
    body(kThetaSlot);
    if (last >= kVelocitySlot) body(kVelocitySlot);
    if (last >= kPositionSlot) body(kPositionSlot);
    if (last >= FootSlot(0) && Has(FootSlot(0))) [[likely]]
      body(FootSlot(0));
    if (last >= FootSlot(1) && Has(FootSlot(1))) [[likely]]
      body(FootSlot(1));
    if (last >= FootSlot(2) && Has(FootSlot(2))) [[likely]]
      body(FootSlot(2));
    if (last >= FootSlot(3) && Has(FootSlot(3))) [[likely]]
      body(FootSlot(3));
    if (last >= kGyroBiasSlot) body(kGyroBiasSlot);
    if (last >= kAccelBiasSlot) body(kAccelBiasSlot);
  }

 private:
  bool Has(Slot foot) const { return kFeet && feet_.Has(foot); }

  SlotSet feet_;
};

/// Which slots an error has. Nothing allocates.
class ActiveSlots {
 public:
  /// In the error's order.
  std::span<const Slot> list() const { return {slots_.data(), size_}; }
  std::span<const Slot> feet() const { return list().subspan(3, size_ - kPermanent); }
  bool Has(Slot slot) const { return !IsFoot(slot) || feet_.Has(slot); }

  void Add(Slot foot) {
    assert(IsFoot(foot) && !Has(foot));
    feet_.Add(foot);
    const auto place = std::upper_bound(begin(), end(), foot);
    std::copy_backward(place, end(), end() + 1);
    *place = foot;
    ++size_;
  }
  void Remove(Slot foot) {
    assert(IsFoot(foot) && Has(foot));
    feet_.Remove(foot);
    std::copy(std::find(begin(), end(), foot) + 1, end(), std::find(begin(), end(), foot));
    --size_;
  }

  /// The loops over them.
  SlotLoops<true> loops() const { return SlotLoops<true>(feet_); }

  /// work(loops), compiled once for no feet and once for some.
  template <class Work>
  [[gnu::always_inline]] void Visit(const Work& work) const {
    if (feet_.empty()) {
      work(SlotLoops<false>(feet_));
    } else {
      work(SlotLoops<true>(feet_));
    }
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
  SlotSet feet_;
};

}  // namespace reckon::estimator

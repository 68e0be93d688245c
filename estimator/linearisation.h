#pragma once

#include <Eigen/Core>
#include <array>
#include <cassert>
#include <cstdint>
#include <span>
#include <type_traits>

#include "reckon/estimator/covariance.h"
#include "reckon/estimator/navigation_state.h"
#include "reckon/estimator/spread.h"

namespace reckon::estimator {

/// The most slots that one measurement can name.
inline constexpr std::size_t kMaxTerms = 6;

/// Three coordinates of a state against the rows of a measurement: a matrix, or a column for one
/// row.
template <int kRows>
using Strip = std::conditional_t<kRows == 3, LaneMatrix, Lane>;

/// One for every slot: P Hᵀ, or a gain.
template <int kRows>
using Strips = std::array<Strip<kRows>, kSlots>;

/// A matrix over the rows of a measurement, and a vector.
template <int kRows>
using Square = std::conditional_t<kRows == 3, LaneMatrix, double>;
template <int kRows>
using Row = std::conditional_t<kRows == 3, Lane, double>;
inline Lane ToRow(const Eigen::Vector3d& z) { return ToLane(z); }
inline double ToRow(const Eigen::Matrix<double, 1, 1>& z) { return z(0); }
inline LaneMatrix ToSquare(const Eigen::Matrix3d& N) { return ToLanes(N); }
inline double ToSquare(const Eigen::Matrix<double, 1, 1>& N) { return N(0); }

/// An increment of the error by slot; only active slots count.
using SlotVector = std::array<Lane, kSlots>;

/// What H is in one slot.
enum class TermKind : std::uint8_t { kPlus, kMinus, kBlock };

/// What a measurement says of one slot: H is +1, −1 or a matrix (of one row: that row).
template <int kRows>
struct Term {
  Slot slot;
  TermKind kind;
  Strip<kRows> H;  ///< of a block
};

/// H x of one term: of an error, or of a strip P Hᵀ.
template <class T>
T Times(const Term<3>& term, const T& x) {
  return term.kind == TermKind::kPlus ? x : term.kind == TermKind::kMinus ? -x : term.H * x;
}
inline double Times(const Term<1>& term, Lane x) { return Dot(term.H, x); }

/// A measurement linearised at the state: z = −H ξ + noise of covariance N, in right-invariant
/// error coordinates. A model names its blocks and nothing else; other error forms convert them.
/// One row or three.
template <int kRows>
class Linearisation {
  static_assert(kRows == 1 || kRows == 3);

 public:
  using Vector = Eigen::Matrix<double, kRows, 1>;
  using Matrix = Eigen::Matrix<double, kRows, kRows>;

  Vector z = Vector::Zero();
  Matrix N = Matrix::Zero();
  /// Beside N, of a single row: what an error that lasts over many samples adds as white noise. The
  /// gain weighs it; one sample's NIS does not.
  double lasting = 0.0;

  void Plus(Slot slot) { Append(slot, TermKind::kPlus); }
  void Minus(Slot slot) { Append(slot, TermKind::kMinus); }
  void Block(Slot slot, const Eigen::Matrix<double, kRows, 3>& H) {
    if constexpr (kRows == 3) {
      Block(slot, ToLanes(H));
    } else {
      Block(slot, ToLane(H.transpose()));
    }
  }

  void Block(Slot slot, const Strip<kRows>& H) { Append(slot, TermKind::kBlock).H = H; }

  /// z ← z − H δ: the innovation that is left after an increment δ which the mean has not seen yet.
  void MoveBy(const SlotVector& increment) {
    Row<kRows> left = ToRow(z);
    for (const Term<kRows>& term : terms()) left -= Times(term, increment[term.slot]);
    z = ToEigen(left);
  }

  std::span<const Term<kRows>> terms() const { return {terms_.data(), size_}; }
  SlotSet slots() const { return slots_; }

 private:
  Term<kRows>& Append(Slot slot, TermKind kind) {
    assert(kRows == 3 || kind == TermKind::kBlock);
    assert(size_ < terms_.size());
    Term<kRows>& term = terms_[size_++];
    slots_.Add(slot);
    term.slot = slot;
    term.kind = kind;
    return term;
  }

  std::array<Term<kRows>, kMaxTerms> terms_;
  std::size_t size_ = 0;
  SlotSet slots_;
};

/// H of a term as a dense matrix.
template <int kRows>
Eigen::Matrix<double, kRows, 3> Dense(const Term<kRows>& term) {
  if constexpr (kRows == 3) {
    if (term.kind == TermKind::kBlock) return ToEigen(term.H);
    const double sign = term.kind == TermKind::kPlus ? 1.0 : -1.0;
    return sign * Eigen::Matrix3d::Identity();
  } else {
    return ToEigen(term.H).transpose();
  }
}

/// The same measurement for an error ε with θ = R̂ θ_ε and ξ_s = T ε_s + [x̂_s]× R̂ θ_ε, s = v, p, d:
/// the left-invariant one with T = R̂, the multiplicative one with T = I.
template <int kRows>
Linearisation<kRows> ForError(const Linearisation<kRows>& m, const NavigationState& x,
                              const Eigen::Matrix3d& T) {
  Linearisation<kRows> converted;
  converted.z = m.z;
  converted.N = m.N;
  Eigen::Matrix<double, kRows, 3> H_theta = Eigen::Matrix<double, kRows, 3>::Zero();
  for (const Term<kRows>& term : m.terms()) {
    const Eigen::Matrix<double, kRows, 3> H = Dense(term);
    if (term.slot == kThetaSlot) {
      H_theta += H * x.R;
    } else if (term.slot >= kGyroBiasSlot) {
      converted.Block(term.slot, H);
    } else {
      H_theta += H * Skew(x.At(term.slot)) * x.R;
      converted.Block(term.slot, H * T);
    }
  }
  converted.Block(kThetaSlot, H_theta);
  return converted;
}

}  // namespace reckon::estimator

#pragma once

#include <Eigen/Core>
#include <array>
#include <cassert>
#include <cstdint>
#include <span>
#include <type_traits>

#include "reckon/estimator/covariance.h"
#include "reckon/estimator/navigation_state.h"

namespace reckon::estimator {

/// The most slots that one measurement can name.
inline constexpr std::size_t kMaxTerms = 6;

/// Three coordinates of a state against the rows of a measurement: a matrix, or a column for one
/// row.
template <int kRows>
using Strip = std::conditional_t<kRows == 3, LaneMatrix, Lane>;

/// What a measurement says of one slot: H is +1, −1 or a matrix, kept transposed.
template <int kRows>
struct Term {
  enum class Kind : std::uint8_t { kPlus, kMinus, kBlock };
  Slot slot;
  Kind kind;
  Strip<kRows> H_transposed;  ///< of a block
};

/// A measurement linearised at the state: z = −H ξ + noise of covariance N, in right-invariant
/// error coordinates. A model names its blocks and nothing else; other error forms convert them.
/// One row or three.
template <int kRows>
class Linearisation {
  static_assert(kRows == 1 || kRows == 3);

 public:
  using Vector = Eigen::Matrix<double, kRows, 1>;
  using Matrix = Eigen::Matrix<double, kRows, kRows>;
  using Kind = typename Term<kRows>::Kind;

  Vector z = Vector::Zero();
  Matrix N = Matrix::Zero();

  void Plus(Slot slot) { Append({slot, Kind::kPlus, {}}); }
  void Minus(Slot slot) { Append({slot, Kind::kMinus, {}}); }
  void Block(Slot slot, const Eigen::Matrix<double, kRows, 3>& H) {
    if constexpr (kRows == 3) {
      Append({slot, Kind::kBlock, ToLanes(H.transpose())});
    } else {
      Append({slot, Kind::kBlock, ToLane(H.transpose())});
    }
  }

  std::span<const Term<kRows>> terms() const { return {terms_.data(), size_}; }

 private:
  void Append(const Term<kRows>& term) {
    assert(kRows == 3 || term.kind == Kind::kBlock);
    assert(size_ < terms_.size());
    terms_[size_++] = term;
  }

  std::array<Term<kRows>, kMaxTerms> terms_;
  std::size_t size_ = 0;
};

/// H of a term as a dense matrix.
template <int kRows>
Eigen::Matrix<double, kRows, 3> Dense(const Term<kRows>& term) {
  if constexpr (kRows == 3) {
    if (term.kind == Term<3>::Kind::kBlock) return ToEigen(term.H_transposed).transpose();
    const double sign = term.kind == Term<3>::Kind::kPlus ? 1.0 : -1.0;
    return sign * Eigen::Matrix3d::Identity();
  } else {
    return ToEigen(term.H_transposed).transpose();
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

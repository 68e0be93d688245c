#include "reckon/estimator/kalman.h"

#include <limits>

namespace reckon::estimator {
namespace {

/// strips[i] += (P Hᵀ)_i for every slot i.
template <int kRows>
void AddColumns(std::array<Strip<kRows>, kSlots>& strips, const Covariance& P,
                const Linearisation<kRows>& m) {
  for (const Term<kRows>& term : m.terms()) {
    const Slot s = term.slot;
    switch (term.kind) {
      case TermKind::kBlock: {
        const Strip<kRows> H = term.H;
        P.slots().ForEach([&](Slot i) { strips[i] += TimesTransposed(P.Get(i, s), H); });
        break;
      }
      case TermKind::kPlus:
        if constexpr (kRows == 3) P.slots().ForEach([&](Slot i) { strips[i] += P.Get(i, s); });
        break;
      case TermKind::kMinus:
        if constexpr (kRows == 3) P.slots().ForEach([&](Slot i) { strips[i] -= P.Get(i, s); });
        break;
    }
  }
}

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

/// S⁻¹ of a symmetric S by its cofactors; not a number where S is not positive definite.
LaneMatrix Inverse(const LaneMatrix& S) {
  const auto [a, b, c] = S.column;
  const LaneMatrix adjugate{{Cross(b, c), Cross(c, a), Cross(a, b)}};
  const double determinant = Dot(a, adjugate.column[0]);
  const bool positive = S(0, 0) > 0.0 && adjugate(2, 2) > 0.0 && determinant > 0.0;
  return (positive ? 1.0 / determinant : kNotANumber) * adjugate;
}
double Inverse(double S) { return S > 0.0 ? 1.0 / S : kNotANumber; }

}  // namespace

template <int kRows>
[[gnu::flatten]] KalmanCorrection<kRows>::KalmanCorrection(const Covariance& P,
                                                           const Linearisation<kRows>& m)
    : m_(m), slots_(P.slots()), N_(ToSquare(m.N)), z_(ToRow(m.z)) {
  slots_.ForEach([this](Slot i) { C_[i] = Strip<kRows>::Zero(); });
  AddColumns(C_, P, m);
  S_ = N_;
  for (const Term<kRows>& term : m.terms()) S_ += Times(term, C_[term.slot]);
  S_ = Symmetric(S_);
  S_inverse_ = Inverse(S_);
  nis_ = Dot(z_, S_inverse_ * z_);
}

template <int kRows>
void KalmanCorrection<kRows>::Inflate(double target) {
  const double factor = nis_ / target;
  N_ += (factor - 1.0) * S_;
  S_inverse_ = (1.0 / factor) * S_inverse_;
}

template <int kRows>
[[gnu::flatten]] SlotVector KalmanCorrection<kRows>::Gain() const {
  SlotVector increment;
  const Row<kRows> weighted = S_inverse_ * z_;
  slots_.ForEach([&](Slot i) { increment[i] = C_[i] * weighted; });
  return increment;
}

template <int kRows>
[[gnu::flatten]] void KalmanCorrection<kRows>::UpdateCovariance(Covariance& P) const {
  std::array<Strip<kRows>, kSlots> K, T;
  slots_.ForEach([&](Slot i) { K[i] = C_[i] * S_inverse_; });
  slots_.ForEachPair([&](Slot i, Slot j) { SubtractTimesTransposed(P(i, j), C_[i], K[j]); });
  slots_.ForEach([&](Slot i) { T[i] = -(K[i] * N_); });
  AddColumns(T, P, m_);
  slots_.ForEachPair([&](Slot i, Slot j) { SubtractTimesTransposed(P(i, j), T[i], K[j]); });
  slots_.ForEach([&](Slot i) { P(i, i) = Symmetric(P(i, i)); });
}

template class KalmanCorrection<1>;
template class KalmanCorrection<3>;

}  // namespace reckon::estimator

#include "reckon/estimator/kalman.h"

#include <limits>

// GCC does not see that one loop skips the feet that another has skipped.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"

namespace reckon::estimator {
namespace {

/// use(i, (P Hᵀ)_i) for every slot i, of one term's H and its column of P.
template <int kRows, class Slots, class Use>
[[gnu::always_inline]] inline void ForEachColumn(const Term<kRows>& term, const Slots& slots,
                                                 const Column& P, const Use& use) {
  if (kRows == 1 || term.kind == TermKind::kBlock) {
    const Strip<kRows> H = term.H;
    slots.ForEach([&](Slot i) RECKON_INLINED { use(i, TimesTransposed(P[i], H)); });
  } else if constexpr (kRows == 3) {
    if (term.kind == TermKind::kPlus) {
      slots.ForEach([&](Slot i) RECKON_INLINED { use(i, P[i]); });
    } else {
      slots.ForEach([&](Slot i) RECKON_INLINED { use(i, -P[i]); });
    }
  }
}

/// P Hᵀ.
template <int kRows, class Slots>
[[gnu::noinline, gnu::flatten]] void SetProduct(Strips<kRows>& strips, const Covariance& P,
                                                const Linearisation<kRows>& m, const Slots slots) {
  Column column;
  P.GetColumn(m.terms().front().slot, column);
  ForEachColumn(m.terms().front(), slots, column,
                [&](Slot i, const Strip<kRows>& c) RECKON_INLINED { strips[i] = c; });
  for (const Term<kRows>& term : m.terms().subspan(1)) {
    P.GetColumn(term.slot, column);
    ForEachColumn(term, slots, column,
                  [&](Slot i, const Strip<kRows>& c) RECKON_INLINED { strips[i] += c; });
  }
}

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

/// S⁻¹ of a symmetric S by its cofactors; not a number where S is not positive definite.
LaneMatrix Inverse(const LaneMatrix& S) {
  const Lane a = S.column[0], b = S.column[1], c = S.column[2];
  const LaneMatrix adjugate(Cross(b, c), Cross(c, a), Cross(a, b));
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
  slots_.Visit([&](const auto& slots) { SetProduct(C_, P, m, slots); });
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
  slots_.loops().ForEach([&](Slot i) RECKON_INLINED { increment[i] = C_[i] * weighted; });
  return increment;
}

template <int kRows>
void KalmanCorrection<kRows>::UpdateCovariance(Covariance& P) const {
  slots_.Visit([&](const auto& slots) { Update(P, slots); });
}

template <int kRows>
template <class Slots>
[[gnu::noinline, gnu::flatten]] void KalmanCorrection<kRows>::Update(Covariance& P,
                                                                     const Slots slots) const {
  Strips<kRows> K, T;
  slots.ForEach([&](Slot i) RECKON_INLINED { K[i] = C_[i] * S_inverse_; });
  slots.ForEachPair([&](Slot i, Slot j)
                        RECKON_INLINED { SubtractTimesTransposed(P(i, j), C_[i], K[j]); });
  SetProduct(T, P, m_, slots);
  slots.ForEach([&](Slot i) RECKON_INLINED { T[i] -= K[i] * N_; });
  slots.ForEachPair([&](Slot i, Slot j)
                        RECKON_INLINED { SubtractTimesTransposed(P(i, j), T[i], K[j]); });
  slots.ForEach([&](Slot i) RECKON_INLINED { P(i, i) = Symmetric(P(i, i)); });
}

template class KalmanCorrection<1>;
template class KalmanCorrection<3>;

}  // namespace reckon::estimator

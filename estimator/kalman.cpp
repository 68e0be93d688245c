#include "reckon/estimator/kalman.h"

#include <limits>

// GCC does not see that one loop skips the feet that another has skipped.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"

namespace reckon::estimator {
namespace {

/// use(i, (P Hᵀ)_i) for every slot i, of one term of H and `block`(i) of its column of P.
template <int kRows, class Slots, class Block, class Use>
[[gnu::always_inline]] inline void ForEachStrip(const Term<kRows>& term, const Slots& slots,
                                                const Block& block, const Use& use) {
  if (kRows == 1 || term.kind == TermKind::kBlock) {
    const auto H = Spread(term.H);
    slots.ForEach([&](Slot i) RECKON_INLINED { use(i, TimesTransposed(block(i), H)); });
  } else if constexpr (kRows == 3) {
    if (term.kind == TermKind::kPlus) {
      slots.ForEach([&](Slot i) RECKON_INLINED { use(i, block(i)); });
    } else {
      slots.ForEach([&](Slot i) RECKON_INLINED { use(i, -block(i)); });
    }
  }
}

/// P Hᵀ, where column(j) gives the blocks of a column of P, each by its row.
template <int kRows, class Slots, class Column>
[[gnu::always_inline]] inline void SetProduct(Strips<kRows>& strips, const Linearisation<kRows>& m,
                                              const Slots& slots, const Column& column) {
  ForEachStrip(m.terms().front(), slots, column(m.terms().front().slot),
               [&](Slot i, const Strip<kRows>& c) RECKON_INLINED { strips[i] = c; });
  for (const Term<kRows>& term : m.terms().subspan(1)) {
    ForEachStrip(term, slots, column(term.slot),
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
  slots_.Visit([&](const auto& slots) RECKON_INLINED {
    SetProduct(C_, m, slots, [&](Slot j) RECKON_INLINED {
      return [&P, j](Slot i) RECKON_INLINED { return P.Get(i, j); };
    });
  });
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
void KalmanCorrection<kRows>::AddNoise(double variance) {
  if constexpr (kRows == 1) {
    N_ += variance;
    S_ += variance;
    S_inverse_ = Inverse(S_);
  }
}

template <int kRows>
[[gnu::flatten]] SlotVector KalmanCorrection<kRows>::Gain() const {
  SlotVector increment;
  const Row<kRows> weighted = S_inverse_ * z_;
  slots_.loops().ForEach([&](Slot i) RECKON_INLINED { increment[i] = C_[i] * weighted; });
  return increment;
}

template <int kRows>
[[gnu::flatten]] void KalmanCorrection<kRows>::AddGainTo(SlotVector& increment) const {
  const Row<kRows> weighted = S_inverse_ * z_;
  slots_.loops().ForEach([&](Slot i) RECKON_INLINED { increment[i] += C_[i] * weighted; });
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
  const auto S_inverse = Spread(S_inverse_);
  slots.ForEach([&](Slot i) RECKON_INLINED { K[i] = TimesTransposed(C_[i], S_inverse); });
  SetProduct(T, m_, slots, [&](Slot j) RECKON_INLINED {
    return [&, j, K_j = Spread(K[j])](Slot i)
               RECKON_INLINED { return Less(P.Get(i, j), C_[i], K_j); };
  });
  const auto N = Spread(N_);
  slots.ForEach([&](Slot i) RECKON_INLINED { T[i] = Less(T[i], K[i], N); });
  slots.ForEach([&](Slot j) RECKON_INLINED {
    const auto K_j = Spread(K[j]);
    slots.ForEachUpTo(j, [&](Slot i) RECKON_INLINED {
      const LaneMatrix block = Less(Less(P(i, j), C_[i], K_j), T[i], K_j);
      P(i, j) = i == j ? Symmetric(block) : block;
    });
  });
}

template class KalmanCorrection<1>;
template class KalmanCorrection<3>;

}  // namespace reckon::estimator

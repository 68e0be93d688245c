#include "reckon/estimator/kalman.h"

#include <Eigen/Cholesky>
#include <limits>

namespace reckon::estimator {
namespace {

double Dot(Lane a, Lane b) {
  const Lane product = a * b;
  return product[0] + product[1] + product[2];
}

/// Row i of P Hᵀ.
template <int kRows>
Strip<kRows> Column(const Covariance& P, Slot i, const Linearisation<kRows>& m) {
  using Kind = typename Term<kRows>::Kind;
  Strip<kRows> sum{};
  for (const Term<kRows>& term : m.terms()) {
    const LaneMatrix block = P.Get(i, term.slot);
    if constexpr (kRows == 3) {
      if (term.kind == Kind::kPlus) sum += block;
      if (term.kind == Kind::kMinus) sum -= block;
      if (term.kind == Kind::kBlock) sum += block * term.H_transposed;
    } else {
      sum += block * term.H_transposed;
    }
  }
  return sum;
}

// What stands beside a strip in a product: a matrix and a vector, or for one row two numbers.
LaneMatrix Factor(const Eigen::Matrix3d& M) { return ToLanes(M); }
Lane Factor(const Eigen::Vector3d& v) { return ToLane(v); }
double Factor(const Eigen::Matrix<double, 1, 1>& m) { return m(0); }
Lane operator*(Lane strip, double factor) { return factor * strip; }

}  // namespace

template <int kRows>
KalmanCorrection<kRows>::KalmanCorrection(const Covariance& P, const Linearisation<kRows>& m)
    : m_(m), active_(P.active()), N_(m.N) {
  for (const Slot i : active_) C_[i] = Column(P, i, m);
  S_ = N_;
  for (const Term<kRows>& term : m.terms()) {
    if constexpr (kRows == 3) {
      S_ += Dense(term) * ToEigen(C_[term.slot]);
    } else {
      S_(0) += Dot(term.H_transposed, C_[term.slot]);
    }
  }
  S_ = 0.5 * (S_ + S_.transpose()).eval();
  Solve();
}

template <int kRows>
void KalmanCorrection<kRows>::Solve() {
  const Eigen::LLT<Matrix> llt(S_);
  S_inverse_ = llt.solve(Matrix::Identity());
  nis_ = llt.info() == Eigen::Success ? m_.z.dot(S_inverse_ * m_.z)
                                      : std::numeric_limits<double>::quiet_NaN();
}

template <int kRows>
void KalmanCorrection<kRows>::Inflate(double target) {
  const double factor = nis_ / target;
  N_ += (factor - 1.0) * S_;
  S_inverse_ /= factor;
}

template <int kRows>
SlotVector KalmanCorrection<kRows>::Gain() const {
  SlotVector increment;
  const auto weighted = Factor(Vector(S_inverse_ * m_.z));
  for (const Slot i : active_) increment[i] = C_[i] * weighted;
  return increment;
}

template <int kRows>
void KalmanCorrection<kRows>::UpdateCovariance(Covariance& P) const {
  const auto S_inverse = Factor(S_inverse_);
  const auto N = Factor(N_);
  std::array<Strip<kRows>, kSlots> K, T;
  for (const Slot i : active_) K[i] = C_[i] * S_inverse;
  for (std::size_t a = 0; a < active_.size(); ++a) {
    const Slot i = active_[a];
    for (const Slot j : active_.subspan(a)) SubtractTimesTransposed(P(i, j), K[i], C_[j]);
  }
  for (const Slot i : active_) T[i] = Column(P, i, m_) - K[i] * N;
  for (std::size_t a = 0; a < active_.size(); ++a) {
    const Slot i = active_[a];
    for (const Slot j : active_.subspan(a)) SubtractTimesTransposed(P(i, j), T[i], K[j]);
    P(i, i) = 0.5 * (P(i, i) + Transposed(P(i, i)));
  }
}

template class KalmanCorrection<1>;
template class KalmanCorrection<3>;

}  // namespace reckon::estimator

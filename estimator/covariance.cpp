#include "reckon/estimator/covariance.h"

#include <algorithm>

namespace reckon::estimator {
namespace {

constexpr std::array<Slot, 5> kCore{kThetaSlot, kVelocitySlot, kPositionSlot, kGyroBiasSlot,
                                    kAccelBiasSlot};

}  // namespace

void Covariance::Start(const ErrorCovariance& P) {
  std::copy(kCore.begin(), kCore.end(), active_.begin());
  size_ = kCore.size();
  for (Eigen::Index i = 0; i < 5; ++i) {
    for (Eigen::Index j = i; j < 5; ++j) {
      (*this)(active_[i], active_[j]) = ToLanes(P.block<3, 3>(3 * i, 3 * j));
    }
  }
}

bool Covariance::IsActive(Slot slot) const {
  return std::find(active().begin(), active().end(), slot) != active().end();
}

void Covariance::MapRow(Slot i, const LaneMatrix& M) {
  for (const Slot k : active()) {
    if (k < i) (*this)(k, i) = TimesTransposed((*this)(k, i), M);
    if (k >= i) (*this)(i, k) = M * (*this)(i, k);
  }
  (*this)(i, i) = TimesTransposed((*this)(i, i), M);
}

void Covariance::AddBiases(const BiasColumns& J, const ProcessNoise& noise, double dt) {
  const double gyro_q = noise.gyro / (2.0 * dt), accel_q = noise.accel / (2.0 * dt);
  const LaneMatrix gg = (*this)(kGyroBiasSlot, kGyroBiasSlot);
  const LaneMatrix ga = (*this)(kGyroBiasSlot, kAccelBiasSlot);
  const LaneMatrix ag = Transposed(ga);
  const LaneMatrix aa = (*this)(kAccelBiasSlot, kAccelBiasSlot);
  const auto accel = [&J](Slot i) {
    return i == kVelocitySlot   ? &J.accel_velocity
           : i == kPositionSlot ? &J.accel_position
                                : nullptr;
  };
  const std::span<const Slot> moved = active().first(size_ - 2);

  std::array<LaneMatrix, kSlots> Wg, Wa;
  for (const Slot i : moved) {
    LaneMatrix to_gyro = J.gyro[i] * gg;
    LaneMatrix to_accel = J.gyro[i] * ga;
    LaneMatrix& Ug = (*this)(i, kGyroBiasSlot);
    LaneMatrix& Ua = (*this)(i, kAccelBiasSlot);
    Wa[i] = Ua;
    if (const LaneMatrix* Ja = accel(i)) {
      to_gyro += *Ja * ag;
      to_accel += *Ja * aa;
      Wa[i] += accel_q * *Ja;
    }
    Wg[i] = Ug + 0.5 * to_gyro + gyro_q * J.gyro[i];
    Wa[i] += 0.5 * to_accel;
    Ug += to_gyro;
    Ua += to_accel;
  }
  for (std::size_t m = 0; m < moved.size(); ++m) {
    const Slot i = moved[m];
    LaneMatrix half = TimesTransposed(Wg[i], J.gyro[i]);
    if (const LaneMatrix* Ja = accel(i)) AddTimesTransposed(half, Wa[i], *Ja);
    (*this)(i, i) += half + Transposed(half);
    for (const Slot j : moved.subspan(m + 1)) {
      LaneMatrix& P = (*this)(i, j);
      AddTimesTransposed(P, Wg[i], J.gyro[j]);
      AddTimesTransposed(P, J.gyro[i], Wg[j]);
      if (const LaneMatrix* Ja = accel(j)) AddTimesTransposed(P, Wa[i], *Ja);
      if (const LaneMatrix* Ja = accel(i)) AddTimesTransposed(P, *Ja, Wa[j]);
    }
  }
  (*this)(kGyroBiasSlot, kGyroBiasSlot) += LaneMatrix::Diagonal(noise.gyro_walk * dt);
  (*this)(kAccelBiasSlot, kAccelBiasSlot) += LaneMatrix::Diagonal(noise.accel_walk * dt);
}

void Covariance::AddFoot(Slot foot, const LaneMatrix& noise) {
  assert(!IsActive(foot));
  for (const Slot k : active()) {
    const LaneMatrix strip = Get(kPositionSlot, k);
    (foot < k ? (*this)(foot, k) : (*this)(k, foot)) = foot < k ? strip : Transposed(strip);
  }
  (*this)(foot, foot) = (*this)(kPositionSlot, kPositionSlot) + noise;
  const auto end = active_.begin() + static_cast<std::ptrdiff_t>(size_++);
  const auto place = std::upper_bound(active_.begin(), end, foot);
  std::copy_backward(place, end, end + 1);
  *place = foot;
}

void Covariance::RemoveFoot(Slot foot) {
  const auto end = active_.begin() + static_cast<std::ptrdiff_t>(size_);
  const auto place = std::find(active_.begin(), end, foot);
  assert(place != end);
  std::copy(place + 1, end, place);
  --size_;
}

ErrorCovariance Covariance::Dense() const {
  ErrorCovariance P;
  for (Eigen::Index i = 0; i < 5; ++i) {
    for (Eigen::Index j = i; j < 5; ++j) {
      const Eigen::Matrix3d block = ToEigen((*this)(kCore[i], kCore[j]));
      P.block<3, 3>(3 * i, 3 * j) = block;
      P.block<3, 3>(3 * j, 3 * i) = block.transpose();
    }
  }
  return P;
}

}  // namespace reckon::estimator

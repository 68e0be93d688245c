#include "reckon/estimator/covariance.h"

namespace reckon::estimator {
namespace {

constexpr std::array<Slot, 5> kCore{kThetaSlot, kVelocitySlot, kPositionSlot, kGyroBiasSlot,
                                    kAccelBiasSlot};

}  // namespace

void Covariance::Start(const ErrorCovariance& P) {
  slots_ = {};
  for (Eigen::Index i = 0; i < 5; ++i) {
    for (Eigen::Index j = i; j < 5; ++j) {
      (*this)(kCore[i], kCore[j]) = ToLanes(P.block<3, 3>(3 * i, 3 * j));
    }
  }
}

[[gnu::flatten]] void Covariance::MapRow(Slot i, const LaneMatrix& M) {
  slots_.loops().ForEach([&](Slot k) {
    if (k < i) (*this)(k, i) = TimesTransposed((*this)(k, i), M);
    if (k >= i) (*this)(i, k) = M * (*this)(i, k);
  });
  (*this)(i, i) = TimesTransposed((*this)(i, i), M);
}

[[gnu::flatten]] void Covariance::AddBiases(const BiasColumns& J, const ProcessNoise& noise,
                                            double dt) {
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

  std::array<LaneMatrix, kSlots> Wg, Wa;
  const auto loops = slots_.loops();
  loops.ForEachMoved([&](Slot i) {
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
  });
  loops.ForEachMoved([&](Slot j) {
    loops.ForEachUpTo(j, [&](Slot i) {
      LaneMatrix sum = TimesTransposed(Wg[i], J.gyro[j]);
      if (const LaneMatrix* Ja = accel(j)) AddTimesTransposed(sum, Wa[i], *Ja);
      if (i == j) {
        (*this)(i, i) += sum + Transposed(sum);
        return;
      }
      AddTimesTransposed(sum, J.gyro[i], Wg[j]);
      if (const LaneMatrix* Ja = accel(i)) AddTimesTransposed(sum, *Ja, Wa[j]);
      (*this)(i, j) += sum;
    });
  });
  (*this)(kGyroBiasSlot, kGyroBiasSlot) += LaneMatrix::Diagonal(noise.gyro_walk * dt);
  (*this)(kAccelBiasSlot, kAccelBiasSlot) += LaneMatrix::Diagonal(noise.accel_walk * dt);
}

[[gnu::flatten]] void Covariance::AddFoot(Slot foot, const LaneMatrix& noise) {
  slots_.loops().ForEach([&](Slot k) {
    if (k < foot) (*this)(k, foot) = Get(k, kPositionSlot);
    if (k > foot) (*this)(foot, k) = (*this)(kPositionSlot, k);
  });
  (*this)(foot, foot) = (*this)(kPositionSlot, kPositionSlot) + noise;
  slots_.Add(foot);
}

void Covariance::RemoveFoot(Slot foot) { slots_.Remove(foot); }

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

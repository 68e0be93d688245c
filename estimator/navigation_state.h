#pragma once

#include <Eigen/Core>
#include <array>

#include "reckon/estimator/estimate.h"
#include "reckon/estimator/slot.h"
#include "reckon/estimator/so3.h"

namespace reckon::estimator {

/// The mean that a filter keeps: pose and velocity of the IMU frame I (the IMU's origin, the body's
/// axes) in W, and the biases in I's axes.
struct NavigationState {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  Eigen::Vector3d gyro_bias = Eigen::Vector3d::Zero();
  Eigen::Vector3d accel_bias = Eigen::Vector3d::Zero();
  std::array<Eigen::Vector3d, kMaxFeet> d{};  ///< of the feet that are in contact

  /// The vector that the slot of a velocity, position or foot stands for.
  const Eigen::Vector3d& At(Slot slot) const {
    return slot == kVelocitySlot ? v : slot == kPositionSlot ? p : d[slot - kFirstFootSlot];
  }
  Eigen::Vector3d& At(Slot slot) {
    return slot == kVelocitySlot ? v : slot == kPositionSlot ? p : d[slot - kFirstFootSlot];
  }
};

/// An IMU sample in the axes of I, less the biases, held over `dt`: what moves a state, with the
/// series that every line of a propagation needs.
struct Increment {
  Increment(const Eigen::Vector3d& w_rad_s, const Eigen::Vector3d& a_m_s2, double dt_s)
      : w(w_rad_s),
        a(a_m_s2),
        dt(dt_s),
        series(w * dt),
        G0(series.GammaInLanes(0)),
        G1(series.GammaInLanes(1)),
        G2(series.GammaInLanes(2)) {}

  Eigen::Vector3d w, a;
  double dt;
  RotationSeries<> series;
  LaneMatrix G0, G1, G2;
};

/// How the middles of round feet move while their contact points stand: with the rate ω of a foot
/// and the lever l from the contact point to its middle, u = ω × l. A column a foot, in I's axes,
/// held over a step; zero for feet that do not roll.
struct RollingFeet {
  using Columns = Eigen::Matrix<double, 3, kMaxFeet>;
  Columns u = Columns::Zero(), lever = Columns::Zero();

  /// What a step does to a foot, in the axes of before it: Γ1 u Δt, and the derivative of that by
  /// the gyroscope's bias, Γ1 [l]× Δt − ∂(Γ1 u)/∂φ Δt².
  struct Step {
    Lane moved;
    LaneMatrix by_bias;
  };
  Step Over(const Increment& i, Slot foot) const {
    const Eigen::Index column = foot - kFirstFootSlot;
    const Lane v = ToLane(u.col(column));
    return {i.dt * (i.G1 * v), i.dt * (i.G1 * DiagonalAndCross(0.0, ToLane(lever.col(column)))) -
                                   i.dt * i.dt * i.series.GammaDerivative(1, v)};
  }
};

/// The state after `u` [Hartley20, strapdown integration with the sample held]:
/// R⁺ = R Γ0,  v⁺ = v + R Γ1 a Δt + g Δt,  p⁺ = p + v Δt + R Γ2 a Δt² + ½ g Δt².
inline NavigationState Propagated(const NavigationState& x, const Increment& u,
                                  const Eigen::Vector3d& gravity) {
  const LaneMatrix R = ToLanes(x.R);
  const Lane v = ToLane(x.v), p = ToLane(x.p), a = ToLane(u.a), g = ToLane(gravity);
  const double dt = u.dt;
  NavigationState next = x;
  Store(R * u.G0, next.R);
  next.v = ToEigen(v + dt * (R * (u.G1 * a) + g));
  next.p = ToEigen(p + dt * (v + dt * (R * (u.G2 * a) + 0.5 * g)));
  return next;
}

/// Variances of the white noise and of the bias walks, per second, as filters use them.
struct ProcessNoise {
  double gyro = 0.0;        ///< (rad/s)²/Hz
  double accel = 0.0;       ///< (m/s²)²/Hz
  double gyro_walk = 0.0;   ///< (rad/s²)²/Hz
  double accel_walk = 0.0;  ///< (m/s³)²/Hz
};

}  // namespace reckon::estimator

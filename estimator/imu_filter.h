#pragma once

#include <Eigen/Core>
#include <optional>

#include "reckon/estimator/estimator.h"
#include "reckon/estimator/gate.h"
#include "reckon/estimator/holding_buffer.h"
#include "reckon/estimator/left_invariant_ekf.h"
#include "reckon/estimator/linearisation.h"
#include "reckon/estimator/multiplicative_ekf.h"
#include "reckon/estimator/right_invariant_ekf.h"
#include "reckon/estimator/static_initialiser.h"
#include "reckon/estimator/velocity_model.h"
#include "reckon/estimator/wheel_model.h"

namespace reckon::estimator {

/// A filter that an IMU moves and other sensors correct. `Core` is its error form (mean,
/// covariance, propagation, retraction); all else (time, frames, gates, models, initialisation) is
/// shared, so that two filters of this kind differ in their error alone.
///
/// Time: an IMU sample moves the state to its stamp. A correction from ahead of the state waits
/// until the IMU is there and is used at its own time; one from behind is used as if it were of now
/// while it is not older than the tolerance (1.5 IMU periods, at least 15 ms), and refused as late
/// after that. Missing IMU samples are bridged: the next sample is held over the gap, as if an
/// unknown constant motion of 0.5 rad/s and 3 m/s² (one sigma) came on top.
template <class Core>
class ImuFilter final : public Estimator {
 public:
  /// Throws std::invalid_argument if the suite has no IMU, the gate's probability is not one, and
  /// for what CheckSetup refuses.
  explicit ImuFilter(const Setup& setup);

  /// Throws std::invalid_argument for what CheckPrior refuses.
  void Start(const Prior& prior) override;
  Report Process(const models::Measurement& measurement) override;
  std::optional<Estimate> Belief() const override;

  const Core& core() const { return core_; }

 private:
  void Begin(models::TimeNs t_ns, const NavigationState& x, const ErrorCovariance& P);
  void ProcessImu(const models::Measurement& measurement, const models::ImuSample& sample,
                  Report& report);
  void Initialise(models::TimeNs t_ns, double dt, Report& report);
  void Move(models::TimeNs to_ns, const models::ImuSample& sample, Report& report);
  void Advance(models::TimeNs to_ns, const ProcessNoise& noise, Report& report);
  bool IsWheels(const models::Measurement& measurement) const;
  void ProcessOther(const models::Measurement& measurement, Report& report);
  void Correct(const models::Measurement& measurement, Report& report);
  std::optional<models::BodyVelocitySample> VelocityOf(
      const models::Measurement& measurement) const;
  models::Pose FrameInI(const models::Measurement& measurement) const;
  void Apply(const models::Measurement& measurement, const Linearisation<3>& linearisation,
             Report& report);
  TurnRate Turn() const;

  Setup setup_;
  InnovationGate gate_;
  ProcessNoise noise_;
  Eigen::Vector3d gravity_;
  models::SensorId imu_;
  Eigen::Matrix3d R_BS_;  ///< samples are rotated by it once
  Eigen::Vector3d p_BI_;  ///< the IMU's origin in the body
  models::TimeNs period_ns_;
  models::TimeNs tolerance_ns_;
  StaticInitialiser static_;
  Core core_;
  HoldingBuffer held_;
  bool started_ = false;  ///< has a state
  models::TimeNs t_ns_ = 0;
  Eigen::Vector3d gyro_ = Eigen::Vector3d::Zero();  ///< the newest sample, in I, bias and all
  Eigen::Vector3d accel_ = Eigen::Vector3d::Zero();
  double sample_s_ = 0.0;  ///< its length
};

extern template class ImuFilter<RightInvariantEkf>;
extern template class ImuFilter<LeftInvariantEkf>;
extern template class ImuFilter<MultiplicativeEkf>;

}  // namespace reckon::estimator

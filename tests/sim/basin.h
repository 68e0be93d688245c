#pragma once

#include <array>
#include <cstdio>
#include <functional>
#include <memory>
#include <stdexcept>

#include <mujoco/mujoco.h>
#include <Eigen/Core>

#include "reckon/sim/submerged_body.h"
#include "sim/body_in_water.h"

namespace reckon::testing_sim {

/// The body in MuJoCo, over a bottom far below unless told otherwise.
class Basin {
 public:
  explicit Basin(const BodyInWater& body, double step_s = 1e-3, double bottom_m = -1e3)
      : hydrodynamics_("test", body.water, body.density_kg_m3, kG) {
    char text[1500];
    std::snprintf(text, sizeof text,
                  R"(<mujoco><option timestep="%.17g" gravity="0 0 -%.17g" integrator="Euler"/>
           <worldbody><geom type="plane" pos="0 0 %.17g" size="100 100 1"/>
           <body name="b"><freejoint/>
           <inertial pos="%.17g %.17g %.17g" mass="%.17g" diaginertia="%.17g %.17g %.17g"/>
           <geom type="box" size="0.2 0.15 0.1" mass="0"/></body></worldbody></mujoco>)",
                  step_s, kG, bottom_m, body.p_BG_m.x(), body.p_BG_m.y(), body.p_BG_m.z(),
                  body.mass_kg, body.inertia_kg_m2.x(), body.inertia_kg_m2.y(),
                  body.inertia_kg_m2.z());
    std::array<char, 1000> error{};
    const std::unique_ptr<mjSpec, void (*)(mjSpec*)> spec(
        mj_parseXMLString(text, nullptr, error.data(), error.size()), mj_deleteSpec);
    if (!spec) throw std::runtime_error(error.data());
    model_.reset(mj_compile(spec.get(), nullptr));
    if (!model_) throw std::runtime_error(mjs_getError(spec.get()));
    data_.reset(mj_makeData(model_.get()));
    submerged_ = std::make_unique<sim::SubmergedBody>(*model_, 1);
  }

  /// Thrust in B about its origin, and the water's motion, at a time.
  std::function<Vector6(double)> thrust = [](double) -> Vector6 { return Vector6::Zero(); };
  std::function<WaterMotion(double)> water = [](double) { return WaterMotion{}; };

  const mjModel& model() const { return *model_; }
  mjData& data() { return *data_; }
  const sim::Hydrodynamics& hydrodynamics() const { return hydrodynamics_; }
  models::Pose Pose() const { return submerged_->Pose(*data_); }
  Vector6 Twist() const { return submerged_->Twist(*data_); }

  void SetTwist(const Vector6& twist) {
    Eigen::Map<Vector6> v(data_->qvel);
    v << Pose().R * twist.head<3>(), twist.tail<3>();
  }

  /// As the simulator steps.
  void Step() {
    mj_step1(model_.get(), data_.get());
    ApplyWater();
    mj_step2(model_.get(), data_.get());
  }

  /// ν̇ of W-linear and B-angular velocities here and now.
  Vector6 Acceleration() {
    mj_fwdPosition(model_.get(), data_.get());
    mj_fwdVelocity(model_.get(), data_.get());
    ApplyWater();
    mj_fwdActuation(model_.get(), data_.get());
    mj_fwdAcceleration(model_.get(), data_.get());
    mj_fwdConstraint(model_.get(), data_.get());
    return Eigen::Map<const Vector6>(data_->qacc);
  }

  /// Runge and Kutta's fourth order, with the added mass in every stage.
  void StepRk4() {
    const double h = model_->opt.timestep, t = data_->time;
    const Eigen::Matrix<double, 7, 1> q =
        Eigen::Map<const Eigen::Matrix<double, 7, 1>>(data_->qpos);
    const Vector6 v = Eigen::Map<const Vector6>(data_->qvel);
    const double fraction[] = {0.0, 0.5, 0.5, 1.0}, weight[] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
    Vector6 rate = v, slope = Vector6::Zero(), v_sum = Vector6::Zero(), a_sum = Vector6::Zero();
    const auto set = [&](const Vector6& along, const Vector6& velocity, double dt) {
      Eigen::Map<Eigen::Matrix<double, 7, 1>>(data_->qpos) = q;
      mj_integratePos(model_.get(), data_->qpos, along.data(), dt);
      Eigen::Map<Vector6>(data_->qvel) = velocity;
      data_->time = t + dt;
    };
    for (int i = 0; i < 4; ++i) {
      const Vector6 stage = v + fraction[i] * h * slope;
      set(rate, stage, fraction[i] * h);
      slope = Acceleration();
      rate = stage;
      v_sum += weight[i] * stage;
      a_sum += weight[i] * slope;
    }
    set(v_sum, v + h * a_sum, h);
  }

 private:
  void ApplyWater() {
    const Vector6 wrench =
        hydrodynamics_.Wrench(Pose().R, Twist(), water(data_->time)) + thrust(data_->time);
    submerged_->Apply(hydrodynamics_.added_mass(), wrench, *model_, *data_);
  }

  sim::Hydrodynamics hydrodynamics_;
  std::unique_ptr<mjModel, void (*)(mjModel*)> model_{nullptr, mj_deleteModel};
  std::unique_ptr<mjData, void (*)(mjData*)> data_{nullptr, mj_deleteData};
  std::unique_ptr<sim::SubmergedBody> submerged_;
};

}  // namespace reckon::testing_sim

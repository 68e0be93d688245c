// The Husky's URDF is read by urdfdom (for the estimator) and by MuJoCo (for the simulator). These
// tests hold both readers together.
#include <fstream>
#include <random>
#include <sstream>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "reckon/models/urdf_robot.h"
#include "reckon/sim/skid_steer_model.h"
#include "sim/husky.h"

namespace reckon::sim {
namespace {

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

Eigen::Vector3d Vec(const double* v) { return {v[0], v[1], v[2]}; }
Eigen::Matrix3d Quat(const double* q) {
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
}

class RobotDescription : public testing::Test {
 protected:
  static ModelPtr Build(const WorldConfig& config) {
    return BuildSkidSteerModel(Husky(), config, Terrain(config.terrain, {}, 1));
  }
  int Body(const std::string& link) const {
    return mj_name2id(model_.get(), mjOBJ_BODY, link.c_str());
  }

  const models::UrdfRobot urdf_ = models::UrdfRobot::FromFile(Husky().urdf_path);
  const ModelPtr model_ = Build({});
};

TEST_F(RobotDescription, HasTheHuskysNumbers) {
  EXPECT_NEAR(urdf_.TotalMass(), 56.6, 0.05);  // the data sheet gives one decimal
  const auto front_left = urdf_.LinkPose("front_left_wheel_link").p;
  const auto rear_right = urdf_.LinkPose("rear_right_wheel_link").p;
  EXPECT_NEAR(front_left.x() - rear_right.x(), 0.512, 1e-12);
  EXPECT_NEAR(front_left.y() - rear_right.y(), Husky().skid_steer().command_track_m, 1e-12);
  const auto X_BS = urdf_.LinkPose("imu_link");
  EXPECT_EQ(X_BS.p, Eigen::Vector3d(0.19, 0, 0.149));
  EXPECT_GT(Eigen::AngleAxisd(X_BS.R).angle(), 3.0);  // it hangs upside down
  EXPECT_GT(urdf_.LinkPose("velocity_link").p.norm(), 0.1);
}

TEST_F(RobotDescription, WheelsAreAsLargeAsTheDriveBelieves) {
  std::ifstream file(Husky().urdf_path);
  std::stringstream text;
  text << file.rdbuf();
  std::stringstream radius;
  radius << "<cylinder radius=\"" << Husky().skid_steer().wheel_radius_m << "\"";
  int wheels = 0;
  for (auto at = text.str().find(radius.str()); at != std::string::npos;
       at = text.str().find(radius.str(), at + 1)) {
    ++wheels;
  }
  EXPECT_EQ(wheels, 8);  // four to see, four to touch
}

TEST_F(RobotDescription, MassesAgree) {
  double mass = 0.0;
  for (const auto& link : urdf_.links()) {
    const int body = Body(link.name);
    ASSERT_GT(body, 0) << link.name << " is missing: was it fused away?";
    EXPECT_EQ(model_->body_mass[body], link.inertial ? link.inertial->mass_kg : 0.0) << link.name;
    mass += model_->body_mass[body];
  }
  EXPECT_NEAR(mj_getTotalmass(model_.get()), mass, 1e-12);  // nothing else weighs anything
}

TEST_F(RobotDescription, RotatedInertiasAgree) {
  for (const auto& link : urdf_.links()) {
    if (!link.inertial) continue;
    const int body = Body(link.name);
    const Eigen::Matrix3d R = Quat(model_->body_iquat + 4 * body);
    const Eigen::Matrix3d inertia =
        R * Vec(model_->body_inertia + 3 * body).asDiagonal() * R.transpose();
    // MuJoCo diagonalises: round-off of an eigenvalue solver on numbers near 1.
    EXPECT_LT((inertia - link.inertial->I_C_L).norm(), 1e-13) << link.name;
    EXPECT_EQ(Vec(model_->body_ipos + 3 * body), link.inertial->p_LC) << link.name;
  }
}

TEST_F(RobotDescription, FramesAgreeAtRandomJointAngles) {
  const DataPtr data(mj_makeData(model_.get()));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(-10.0, 10.0);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<double> q(urdf_.joints().size());
    for (std::size_t j = 0; j < q.size(); ++j) {
      const int id = mj_name2id(model_.get(), mjOBJ_JOINT, urdf_.joints()[j].name.c_str());
      if (urdf_.joints()[j].type == models::JointType::kFixed) {
        EXPECT_EQ(id, -1);
        continue;
      }
      q[j] = data->qpos[model_->jnt_qposadr[id]] = angle(random);
      const Eigen::Vector3d axis = Vec(model_->jnt_axis + 3 * id);
      EXPECT_LT((axis - urdf_.joints()[j].axis).norm(), 1e-15);
    }
    mj_kinematics(model_.get(), data.get());
    for (std::size_t l = 0; l < urdf_.links().size(); ++l) {
      const int body = Body(urdf_.links()[l].name);
      const models::Pose X_BL = urdf_.LinkPose(static_cast<int>(l), q);
      EXPECT_LT((Vec(data->xpos + 3 * body) - X_BL.p).norm(), 1e-14) << urdf_.links()[l].name;
      const RowMajor3 R(data->xmat + 9 * body);
      EXPECT_LT((R - X_BL.R).norm(), 1e-13) << urdf_.links()[l].name;
    }
  }
}

TEST_F(RobotDescription, ActualDifferencesReachTheSimulatedRobotAlone) {
  WorldConfig config;
  config.actual.mass_scale = 1.1;
  config.actual.com_offset_m = {0.01, -0.02, 0.03};
  config.actual.track_scale = 1.05;
  const ModelPtr actual = Build(config);
  const int base = Body("base_link"), wheel = Body("rear_right_wheel_link");
  EXPECT_NEAR(actual->body_mass[base], 1.1 * 46.034, 1e-12);
  EXPECT_NEAR(actual->body_mass[wheel], 2.637, 1e-12);
  EXPECT_NEAR(actual->body_inertia[3 * base], 1.1 * model_->body_inertia[3 * base], 1e-12);
  const Eigen::Vector3d moved =
      Vec(actual->body_ipos + 3 * base) - Vec(model_->body_ipos + 3 * base);
  EXPECT_LT((moved - config.actual.com_offset_m).norm(), 1e-15);
  EXPECT_NEAR(actual->body_pos[3 * wheel + 1], -1.05 * 0.2775, 1e-12);
  EXPECT_EQ(urdf_.LinkPose("rear_right_wheel_link").p.y(), -0.2775);
}

}  // namespace
}  // namespace reckon::sim

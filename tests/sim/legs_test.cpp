// The legs of both quadrupeds as the estimator reads them from the URDF, against the bodies and the
// dynamics that MuJoCo makes of the same file.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "reckon/models/leg_dynamics.h"
#include "reckon/sim/foot_contacts.h"
#include "reckon/sim/free_joint.h"
#include "reckon/sim/legged_body.h"
#include "reckon/sim/legged_model.h"
#include "sim/quadrupeds.h"

namespace reckon::sim {
namespace {

using Eigen::Vector3d;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

class Legs : public testing::TestWithParam<RobotConfig> {
 protected:
  Legs() {
    std::uniform_real_distribution<double> angle(-1.2, 1.2);
    for (int i = 0; i < model_->nq; ++i) data_->qpos[i] = angle(random_);
    for (int i = 0; i < model_->nv; ++i) data_->qvel[i] = angle(random_);
    const Eigen::Quaterniond turn(Eigen::Quaterniond::UnitRandom());
    base_.Place({turn.toRotationMatrix(), Vector3d(0.3, -0.2, 5.0)}, *data_);
    mj_forward(model_.get(), data_.get());
    q_.resize(static_cast<Eigen::Index>(body_.joints().size()));
    dq_ = q_;
    for (std::size_t i = 0; i < body_.joints().size(); ++i) {
      q_[i] = data_->qpos[model_->jnt_qposadr[Joint(i)]];
      dq_[i] = data_->qvel[Dof(i)];
    }
  }

  int Joint(std::size_t i) const {
    return mj_name2id(model_.get(), mjOBJ_JOINT, body_.joints()[i].c_str());
  }
  int Dof(std::size_t i) const { return model_->jnt_dofadr[Joint(i)]; }
  int FootBody(int leg) const {
    return mj_name2id(model_.get(), mjOBJ_BODY, body_.kinematics(leg).foot().c_str());
  }

  std::mt19937 random_{7};
  const models::UrdfRobot urdf_ = models::UrdfRobot::FromFile(GetParam().urdf_path);
  const LeggedConfig drive_ = std::get<LeggedConfig>(GetParam().drive);
  const LeggedBody body_{urdf_, drive_};
  const WorldConfig config_;
  const Terrain terrain_{config_.terrain, {}, 1};
  const ModelPtr model_ = BuildLeggedModel(GetParam(), config_, urdf_, body_, terrain_, 1);
  const DataPtr data_ = MakeData(*model_);
  const FreeJoint base_{*model_, mj_name2id(model_.get(), mjOBJ_BODY, "trunk")};
  models::EncoderVector q_, dq_;
};

TEST_P(Legs, PutTheFeetWhereTheSimulatorHasThem) {
  const models::Pose X_WB = base_.Pose(*data_);
  for (int leg = 0; leg < body_.legs(); ++leg) {
    const Vector3d p_WF = X_WB * body_.kinematics(leg).Evaluate(q_).p_BF;
    const Vector3d simulated(data_->xpos + 3 * FootBody(leg));
    EXPECT_LT((p_WF - simulated).norm(), 1e-12) << leg;  // rounding of lengths of a metre
  }
}

TEST_P(Legs, MoveTheFeetAsTheSimulatorDoes) {
  const models::Pose X_WB = base_.Pose(*data_);
  RowMajor Jp(3, model_->nv), Jr(3, model_->nv);
  for (int leg = 0; leg < body_.legs(); ++leg) {
    mj_jacBody(model_.get(), data_.get(), Jp.data(), Jr.data(), FootBody(leg));
    const models::FootPosition foot = body_.kinematics(leg).Evaluate(q_);
    for (int k = 0; k < LeggedBody::kLegJoints; ++k) {
      const int dof = Dof(static_cast<std::size_t>(LeggedBody::kLegJoints * leg + k));
      EXPECT_LT((X_WB.R * foot.J.col(k) - Jp.col(dof)).norm(), 1e-12);
      EXPECT_LT((X_WB.R * foot.A.col(k) - Jr.col(dof)).norm(), 1e-12);
    }
  }
}

TEST_P(Legs, JacobiansAreDerivatives) {
  constexpr double kStep =
      1e-6;  // its cube times the third derivative of a metre: 1e-18; rounding 1e-10
  for (int leg = 0; leg < body_.legs(); ++leg) {
    const auto& kinematics = body_.kinematics(leg);
    const models::FootPosition foot = kinematics.Evaluate(q_);
    for (int k = 0; k < LeggedBody::kLegJoints; ++k) {
      models::EncoderVector more = q_, less = q_;
      more[kinematics.entries()[k]] += kStep;
      less[kinematics.entries()[k]] -= kStep;
      const Vector3d slope =
          (kinematics.Evaluate(more).p_BF - kinematics.Evaluate(less).p_BF) / (2.0 * kStep);
      EXPECT_LT((foot.J.col(k) - slope).norm(), 1e-9);
    }
  }
}

TEST_P(Legs, WeighWhatTheSimulatorWeighs) {
  const double simulated = mj_getTotalmass(model_.get());
  EXPECT_NEAR(body_.mass_kg(), simulated, 1e-12);
  EXPECT_NEAR(urdf_.TotalMass(), simulated, 1e-12);
}

TEST_P(Legs, HaveTheSimulatorsMassMatrix) {
  RowMajor M(model_->nv, model_->nv);
  mj_fullM(model_.get(), data_.get(), M.data());
  for (int leg = 0; leg < body_.legs(); ++leg) {
    const auto own = body_.dynamics(leg).MassMatrix(LeggedBody::Of(leg, q_));
    for (int i = 0; i < LeggedBody::kLegJoints; ++i) {
      for (int j = 0; j < LeggedBody::kLegJoints; ++j) {
        const auto first = static_cast<std::size_t>(LeggedBody::kLegJoints * leg);
        EXPECT_NEAR(own(i, j), M(Dof(first + i), Dof(first + j)), 1e-12);
      }
    }
  }
}

TEST_P(Legs, NeedTheSimulatorsTorques) {
  std::uniform_real_distribution<double> draw(-20.0, 20.0);
  for (int i = 0; i < model_->nv; ++i) data_->qacc[i] = draw(random_);
  std::vector<double> torque(static_cast<std::size_t>(model_->nv));
  mj_rne(model_.get(), data_.get(), 1, torque.data());
  const Eigen::Matrix3d R_BW = base_.Pose(*data_).R.transpose();
  models::BodyMotion body;
  body.w_rad_s = Vector3d(data_->qvel + 3);  // a free joint's: linear in W, angular in B
  body.dw_rad_s2 = Vector3d(data_->qacc + 3);
  body.specific_force_m_s2 =
      R_BW * (Vector3d(data_->qacc) + config_.gravity_m_s2 * Vector3d::UnitZ());
  for (int leg = 0; leg < body_.legs(); ++leg) {
    models::LegVector ddq(LeggedBody::kLegJoints);
    const auto first = static_cast<std::size_t>(LeggedBody::kLegJoints * leg);
    for (std::size_t k = 0; k < LeggedBody::kLegJoints; ++k) ddq[k] = data_->qacc[Dof(first + k)];
    const models::LegVector own = body_.dynamics(leg).InverseDynamics(
        LeggedBody::Of(leg, q_), LeggedBody::Of(leg, dq_), ddq, body);
    for (std::size_t k = 0; k < LeggedBody::kLegJoints; ++k) {
      // MuJoCo's recursion leaves the armature to its mass matrix.
      const double simulated = torque[Dof(first + k)] + drive_.armature_kg_m2[k] * ddq[k];
      EXPECT_NEAR(own[k], simulated, 1e-10);
    }
  }
}

TEST_P(Legs, GravityAloneIsHeldByItsTorque) {
  std::fill(data_->qvel, data_->qvel + model_->nv, 0.0);
  mj_forward(model_.get(), data_.get());
  const Vector3d up_B = base_.Pose(*data_).R.transpose() * Vector3d::UnitZ();
  for (int leg = 0; leg < body_.legs(); ++leg) {
    const auto own = body_.dynamics(leg).GravityTorque(LeggedBody::Of(leg, q_), up_B, 9.81);
    for (std::size_t k = 0; k < LeggedBody::kLegJoints; ++k) {
      const auto first = static_cast<std::size_t>(LeggedBody::kLegJoints * leg);
      EXPECT_NEAR(own[k], data_->qfrc_bias[Dof(first + k)], 1e-12);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Both, Legs, testing::Values(MiniCheetah(), Raibo()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace reckon::sim

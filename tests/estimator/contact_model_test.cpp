#include "reckon/estimator/contact_model.h"

#include <gtest/gtest.h>

#include "estimator/dense.h"
#include "estimator/draws.h"
#include "estimator/reference.h"
#include "reckon/estimator/height_model.h"
#include "reckon/estimator/left_invariant_ekf.h"
#include "reckon/estimator/multiplicative_ekf.h"
#include "reckon/estimator/right_invariant_ekf.h"

namespace reckon::estimator {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing_estimator::Draws;
using testing_estimator::Real;
using testing_estimator::State;
using testing_estimator::Vec15;
using testing_estimator::Vec3;
using testing_estimator::Widened;

constexpr Slot kFoot = FootSlot(1);

/// A state with one foot: its error has the form of the position's. Of e the velocity's place,
/// which no contact touches, stands for the foot's error.
struct Walker {
  State body;
  Vec3 d;
};

Walker TruthBehind(ErrorForm form, const Walker& hat, const Vec15& e) {
  Vec15 of_foot = e;
  of_foot.segment<3>(kPosition) = e.segment<3>(kVelocity);
  State foot = hat.body;
  foot.p = hat.d;
  return {testing_estimator::TruthBehind(form, hat.body, e),
          testing_estimator::TruthBehind(form, foot, of_foot).p};
}

template <class Core>
class Contacts : public ::testing::Test {};
using Cores = ::testing::Types<RightInvariantEkf, LeftInvariantEkf, MultiplicativeEkf>;
TYPED_TEST_SUITE(Contacts, Cores);

/// Rows of a measurement with the foot's in the place of the velocity's.
template <int kRows>
Eigen::Matrix<Real, kRows, 15> RowsWithFoot(const Linearisation<kRows>& m) {
  Eigen::Matrix<Real, kRows, 15> H = Eigen::Matrix<Real, kRows, 15>::Zero();
  for (const auto& term : m.terms()) {
    const int place = term.slot == kFoot ? kVelocity : testing_estimator::PlaceOf(term.slot);
    H.template middleCols<3>(place) += Dense(term).template cast<Real>();
  }
  return H;
}

TYPED_TEST(Contacts, RowsAreTheNumericalOnes) {
  Draws draws(51);
  for (int i = 0; i < 20; ++i) {
    NavigationState x = draws.State();
    x.At(kFoot) = x.p + draws.Vector(0.5);
    const Walker hat{Widened(x), x.At(kFoot).template cast<Real>()};
    const auto innovation = [&](const Vec15& e) -> Vec3 {
      const Walker truth = TruthBehind(TypeParam::kForm, hat, e);
      const Vec3 y = truth.body.R.transpose() * (truth.d - truth.body.p);
      return hat.body.R * y - (hat.d - hat.body.p);
    };
    FootReading y;
    y.h = x.R.transpose() * (x.At(kFoot) - x.p);
    const auto m = LinearisedContact(y, kFoot, x);
    EXPECT_LT(m.z.norm(), 1e-13);
    const auto expected = (-testing_estimator::Differences<3>(innovation)).eval();
    const auto H = RowsWithFoot(TypeParam::Convert(m, x));
    EXPECT_LT(static_cast<double>((H - expected).cwiseAbs().maxCoeff()), 1e-11);

    const auto height = [&](const Vec15& e) -> Eigen::Matrix<Real, 1, 1> {
      return Eigen::Matrix<Real, 1, 1>(TruthBehind(TypeParam::kForm, hat, e).d.z() - hat.d.z());
    };
    const auto floor = TypeParam::Convert(LinearisedHeight(0, 1, kFoot, x.At(kFoot)), x);
    EXPECT_LT(static_cast<double>((RowsWithFoot(floor) + testing_estimator::Differences<1>(height))
                                      .cwiseAbs()
                                      .maxCoeff()),
              1e-11);
  }
}

TYPED_TEST(Contacts, ANewFootHasTheErrorOfWhatPlacedIt) {
  Draws draws(52);
  for (int i = 0; i < 10; ++i) {
    TypeParam core;
    const ErrorCovariance P0 = draws.Covariance<15>(testing_estimator::UsualSigma());
    core.Start(draws.State(), P0);
    const ErrorCovariance before = core.P().Dense();
    FootReading y;
    y.h = draws.Vector(0.4);
    y.N = draws.Covariance<3>(Vector3d(0.01, 0.02, 0.005));
    const State hat = Widened(core.x());
    AddFoot(core, y, kFoot);
    const Vec3 h = y.h.template cast<Real>();
    EXPECT_LT((core.x().At(kFoot).template cast<Real>() - (hat.p + hat.R * h)).norm(), 1e-14);

    // The error of d̂ = p̂ + R̂ (h + n) against d = p + R h, by the error of the body and by n.
    const auto error = [&](const Vec15& e, const Vec3& n) -> Vec3 {
      const State truth = testing_estimator::TruthBehind(TypeParam::kForm, hat, e);
      State foot_hat = hat, foot = truth;
      foot_hat.p = hat.p + hat.R * h;
      foot.p = truth.p + truth.R * (h - n);
      return testing_estimator::Error(TypeParam::kForm, foot_hat, foot)
          .template segment<3>(kPosition);
    };
    const auto T = testing_estimator::Differences<3>(
        [&](const Vec15& e) -> Vec3 { return error(e, Vec3::Zero()); });
    const auto by_noise = testing_estimator::Differences<3>(
        [&](const Vec15& e) -> Vec3 { return error(Vec15::Zero(), e.template head<3>()); });
    const auto B = by_noise.template leftCols<3>().eval();
    const auto cross = (T * before.template cast<Real>()).eval();
    const auto own = (cross * T.transpose() + B * y.N.template cast<Real>() * B.transpose()).eval();
    const Eigen::Matrix<Real, 3, 3> found = ToEigen(core.P()(kFoot, kFoot)).template cast<Real>();
    EXPECT_LT(testing_estimator::WorstCorrelationError(found, own), 1e-12);
    for (const Slot slot :
         {kThetaSlot, kVelocitySlot, kPositionSlot, kGyroBiasSlot, kAccelBiasSlot}) {
      const Matrix3d block = ToEigen(core.P().Get(kFoot, slot));
      const int place = testing_estimator::PlaceOf(slot);
      for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) {
          const Real scale = std::sqrt(own(r, r) * before(place + c, place + c));
          EXPECT_LT(static_cast<double>(std::abs(block(r, c) - cross(r, place + c)) / scale),
                    1e-12);
        }
      }
    }
    EXPECT_EQ(core.P().Dense(), before) << "nothing else changed";
    core.P().RemoveFoot(kFoot);
    EXPECT_EQ(core.P().Dense(), before);
  }
}

models::UrdfRobot OneLeg() {
  return models::UrdfRobot::FromText(R"(<robot name="leg"><link name="base"/>
    <link name="thigh"/><link name="shank"/><link name="foot"/>
    <joint name="hip" type="revolute"><parent link="base"/><child link="thigh"/>
      <origin xyz="0.2 0.1 0"/><axis xyz="0 1 0"/>
      <limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
    <joint name="knee" type="revolute"><parent link="thigh"/><child link="shank"/>
      <origin xyz="0 0 -0.3"/><axis xyz="0 1 0"/>
      <limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
    <joint name="toe" type="fixed"><parent link="shank"/><child link="foot"/>
      <origin xyz="0 0 -0.4"/></joint></robot>)");
}

TEST(FootReading, IsWhereTheLegPutsTheFoot) {
  const std::string joints[] = {"hip", "knee"};
  const models::LegKinematics leg(OneLeg(), "foot", joints);
  models::EncoderVector straight_down = Eigen::Vector2d::Zero();
  Noise noise;
  noise.joint_angle_rad = 0.01;
  noise.foot_position_m = 0.002;
  const FootReading y = ReadFoot(leg, straight_down, {0.05, 0, 0.1}, noise);
  EXPECT_LT((y.h - Vector3d(0.15, 0.1, -0.8)).norm(), 1e-15);
  // The hip swings 0.7 m and the knee 0.4 m of leg along x; nothing moves the foot sideways or up.
  const Vector3d variance(1e-4 * (0.49 + 0.16) + 4e-6, 4e-6, 4e-6);
  EXPECT_LT((y.N - Matrix3d(variance.asDiagonal())).norm(), 1e-18);
}

}  // namespace
}  // namespace reckon::estimator

#include <gtest/gtest.h>

#include <cmath>

#include "estimator/dense.h"
#include "estimator/draws.h"
#include "estimator/reference.h"
#include "reckon/estimator/left_invariant_ekf.h"
#include "reckon/estimator/multiplicative_ekf.h"
#include "reckon/estimator/right_invariant_ekf.h"
#include "reckon/estimator/velocity_model.h"
#include "reckon/estimator/wheel_model.h"

namespace reckon::estimator {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing_estimator::DenseH;
using testing_estimator::Draws;
using testing_estimator::Real;
using testing_estimator::Vec15;
using testing_estimator::Vec3;
using testing_estimator::Widened;

models::Pose RandomMounting(Draws& draws) { return {draws.Rotation(), draws.Vector(0.5)}; }

template <class Core>
class VelocityRows : public ::testing::Test {};
using Cores = ::testing::Types<RightInvariantEkf, LeftInvariantEkf, MultiplicativeEkf>;
TYPED_TEST_SUITE(VelocityRows, Cores);

TYPED_TEST(VelocityRows, AreTheNumericalOnes) {
  Draws draws(31);
  for (int i = 0; i < 20; ++i) {
    const NavigationState x = draws.State();
    const models::Pose X_IS = RandomMounting(draws);
    const Vector3d gyro = draws.Vector();
    const auto hat = Widened(x);
    // What a perfect sensor would say at the truth behind an error, against what is expected at
    // the estimate: z = R̂ (R_IS y − ω̂ × r) − v̂, with the true ω the sample less the true bias.
    const auto innovation = [&](const Vec15& e) -> Vec3 {
      const auto truth = testing_estimator::TruthBehind(TypeParam::kForm, hat, e);
      const Vec3 r = X_IS.p.cast<Real>();
      const auto y =
          (truth.R.transpose() * truth.v + (gyro.cast<Real>() - truth.bg).cross(r)).eval();
      return hat.R * (y - (gyro.cast<Real>() - hat.bg).cross(r)) - hat.v;
    };
    const Eigen::Matrix<Real, 3, 15> expected = -testing_estimator::Differences<3>(innovation);

    models::BodyVelocitySample y;
    y.v_WS_S = X_IS.R.transpose() * (x.R.transpose() * x.v + (gyro - x.gyro_bias).cross(X_IS.p));
    y.covariance = Matrix3d::Identity();
    const Linearisation<3> m =
        TypeParam::Convert(LinearisedVelocity(y, X_IS, {gyro - x.gyro_bias, 0.0}, x), x);
    EXPECT_LT(m.z.norm(), 1e-14) << "a measurement that agrees";
    EXPECT_LT(static_cast<double>((DenseH(m) - expected).cwiseAbs().maxCoeff()), 1e-11);
  }
}

TEST(VelocityModel, InnovationIsTheDisagreementInWorldAxes) {
  // The body drives at 1 m/s along its x, turned by 90° to the world's y; the sensor looks back.
  NavigationState x;
  x.R = Exp({0, 0, M_PI / 2});
  x.v = {0, 1, 0};
  const models::Pose X_IS{Exp({0, 0, M_PI}), Vector3d(0, 0, 0.5)};
  models::BodyVelocitySample y;
  y.v_WS_S = {-1.25, 0, 0};
  y.covariance = Vector3d(1, 4, 9).asDiagonal();
  const Linearisation<3> m = LinearisedVelocity(y, X_IS, {}, x);
  EXPECT_LT((m.z - Vector3d(0, 0.25, 0)).norm(), 1e-15);
  // The sensor's x is the world's −y.
  EXPECT_LT((m.N - Matrix3d(Vector3d(4, 1, 9).asDiagonal())).norm(), 1e-14);
}

TEST(VelocityModel, NoiseIncludesThatOfTheGyroscopeOverTheLeverArm) {
  // A lever arm of 2 m along x: rate noise about y and z moves the sensor, about x it does not.
  const models::Pose X_IS{Matrix3d::Identity(), Vector3d(2, 0, 0)};
  models::BodyVelocitySample y;
  y.covariance = 0.01 * Matrix3d::Identity();
  const Linearisation<3> m =
      LinearisedVelocity(y, X_IS, {Vector3d::Zero(), 0.25}, NavigationState{});
  EXPECT_LT((m.N - Matrix3d(Vector3d(0.01, 1.01, 1.01).asDiagonal())).norm(), 1e-15);
}

models::WheelDrive FourWheels() {
  models::WheelDrive drive;
  drive.left = {0, 2};
  drive.right = {1, 3};
  drive.rolling_radius_m = 0.2;
  return drive;
}

models::EncoderSample Rates(std::initializer_list<double> rates) {
  models::EncoderSample sample;
  sample.rate_rad_s.resize(static_cast<Eigen::Index>(rates.size()));
  std::copy(rates.begin(), rates.end(), sample.rate_rad_s.data());
  sample.angle_rad = sample.rate_rad_s;
  return sample;
}

TEST(WheelModel, AveragesEachSide) {
  const auto rates = MeanRates(Rates({1, 10, 3, 20}), FourWheels());
  ASSERT_TRUE(rates);
  EXPECT_DOUBLE_EQ(rates->left, 2.0);
  EXPECT_DOUBLE_EQ(rates->right, 15.0);
  EXPECT_FALSE(MeanRates(Rates({1, 10, 3}), FourWheels())) << "a wheel is missing";
}

TEST(WheelModel, SaysForwardSpeedAndNothingSideways) {
  Noise noise;
  noise.wheel_forward_m_per_s = 0.1;
  noise.wheel_lateral_m_per_s = 0.2;
  noise.wheel_vertical_m_per_s = 0.3;
  const auto velocity = WheelVelocity({2.0, 3.0}, FourWheels(), noise);
  EXPECT_LT((velocity.v_WS_S - Vector3d(0.5, 0, 0)).norm(), 1e-16);
  EXPECT_LT((velocity.covariance - Matrix3d(Vector3d(0.01, 0.04, 0.09).asDiagonal())).norm(),
            1e-16);
}

}  // namespace
}  // namespace reckon::estimator

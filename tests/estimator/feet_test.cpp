#include <gtest/gtest.h>

#include "estimator/forms.h"
#include "estimator/quadruped.h"
#include "reckon/estimator/imu_filter.h"

namespace reckon::estimator {
namespace {

using testing_estimator::ContactsAt;
using testing_estimator::JointsAt;
using testing_estimator::kMs;
using testing_estimator::QuadrupedSetup;
using testing_estimator::RestingImu;
using testing_estimator::Stance;
using testing_estimator::TestPrior;
using testing_estimator::TimeNs;

template <class Core>
class Feet : public ::testing::Test {
 protected:
  /// A filter at rest that takes its feet on one after the other, 100 ms apart.
  void StandUp(const estimator::Setup& setup, const Prior& prior) {
    filter_ = std::make_unique<ImuFilter<Core>>(setup);
    filter_->Start(prior);
    for (int feet = 1; feet <= 4; ++feet) {
      Rest(100 * kMs);
      EXPECT_EQ(Send(ContactsAt(t_ns_, true, feet > 1, feet > 2, feet > 3)), Refusal::kNone);
      EXPECT_EQ(Send(JointsAt(t_ns_, Stance())), Refusal::kNone);
      EXPECT_EQ(static_cast<int>(filter_->core().P().active().size()), 5 + feet);
    }
  }

  void Rest(TimeNs duration_ns) {
    for (const TimeNs end_ns = t_ns_ + duration_ns; t_ns_ < end_ns;) {
      t_ns_ += 5 * kMs;
      EXPECT_EQ(Send(RestingImu(t_ns_)), Refusal::kNone);
    }
  }

  Refusal Send(const models::Measurement& m) { return filter_->Process(m).refusal; }

  Eigen::Matrix3d Block(Slot slot) const { return ToEigen(filter_->core().P()(slot, slot)); }

  std::unique_ptr<ImuFilter<Core>> filter_;
  TimeNs t_ns_ = 0;
};
using Cores = ::testing::Types<RightInvariantEkf, LeftInvariantEkf, MultiplicativeEkf>;
TYPED_TEST_SUITE(Feet, Cores);

TYPED_TEST(Feet, EachGetsItsSlipNotOnlyTheLast) {
  estimator::Setup setup = QuadrupedSetup();
  setup.noise.gyro_noise_density_rad_per_s_sqrt_hz = 0.0;
  setup.noise.gyro_bias_walk_rad_per_s2_sqrt_hz = 0.0;
  Prior prior = TestPrior();
  // A known orientation and gyroscope: nothing but slip moves a foot's error.
  prior.covariance.diagonal().segment<3>(kTheta).setZero();
  prior.covariance.diagonal().segment<3>(kGyroBias).setZero();
  this->StandUp(setup, prior);
  std::array<Eigen::Matrix3d, 4> before;
  for (int foot = 0; foot < 4; ++foot) before[foot] = this->Block(FootSlot(foot));
  this->Rest(1000 * kMs);
  const double slip = setup.noise.foot_slip_m_per_s_sqrt_hz;
  for (int foot = 0; foot < 4; ++foot) {
    const Eigen::Matrix3d grown = this->Block(FootSlot(foot)) - before[foot];
    // Round-off of 200 sums.
    EXPECT_LT((grown - slip * slip * Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-15)
        << "foot " << foot << ":\n"
        << grown;
  }
}

TYPED_TEST(Feet, DoNotStandInThePlaceOfTheBiases) {
  const estimator::Setup setup = QuadrupedSetup();
  Prior prior = TestPrior();
  ErrorVector sigma;
  sigma << 0, 0, 0, 0, 0, 0, 0, 0, 0, 1e-3, 2e-3, 3e-3, 1e-2, 2e-2, 3e-2;
  prior.covariance.diagonal().tail<6>() = sigma.tail<6>().cwiseAbs2();
  // All four at once: what creates a foot does not correct, so that nothing is learnt of a bias.
  this->filter_ = std::make_unique<ImuFilter<TypeParam>>(setup);
  this->filter_->Start(prior);
  EXPECT_EQ(this->Send(ContactsAt(0, true, true, true, true)), Refusal::kNone);
  EXPECT_EQ(this->Send(JointsAt(0, Stance())), Refusal::kNone);
  this->Rest(1000 * kMs);
  ASSERT_EQ(this->filter_->core().P().active().size(), 9u);
  const ErrorCovariance P = this->filter_->Belief()->covariance;
  ErrorVector variance = sigma.cwiseAbs2();
  const double gyro_walk = setup.noise.gyro_bias_walk_rad_per_s2_sqrt_hz;
  const double accel_walk = setup.noise.accel_bias_walk_m_per_s3_sqrt_hz;
  variance.segment<3>(kGyroBias).array() += gyro_walk * gyro_walk;  // times one second
  variance.segment<3>(kAccelBias).array() += accel_walk * accel_walk;
  const Eigen::Matrix<double, 6, 6> expected = variance.tail<6>().asDiagonal();
  EXPECT_LT((P.bottomRightCorner<6, 6>() - expected).cwiseAbs().maxCoeff(), 1e-17) << P;
}

TYPED_TEST(Feet, LeaveTheBiasesCovarianceWhenTheyLeave) {
  const estimator::Setup setup = QuadrupedSetup();
  this->StandUp(setup, TestPrior());
  this->Rest(100 * kMs);
  EXPECT_EQ(this->Send(JointsAt(this->t_ns_, Stance())), Refusal::kNone);
  const ErrorCovariance before = this->filter_->Belief()->covariance;
  EXPECT_EQ(this->Send(ContactsAt(this->t_ns_, false, false, false, false)), Refusal::kNone);
  EXPECT_EQ(this->filter_->core().P().active().size(), 5u);
  EXPECT_EQ(this->filter_->Belief()->covariance, before) << "the marginal is a block";
}

}  // namespace
}  // namespace reckon::estimator

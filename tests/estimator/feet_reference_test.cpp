#include <gtest/gtest.h>

#include "estimator/dense_legged.h"
#include "estimator/draws.h"
#include "estimator/forms.h"
#include "estimator/quadruped.h"
#include "reckon/estimator/imu_filter.h"

namespace reckon::estimator {
namespace {

using testing_estimator::BeliefOf;
using testing_estimator::ContactsAt;
using testing_estimator::Draws;
using testing_estimator::JointsAt;
using testing_estimator::kMs;
using testing_estimator::LeggedBelief;
using testing_estimator::Real;
using testing_estimator::Stance;
using testing_estimator::TimeNs;
using testing_estimator::WorstCorrelationError;

/// How far a filter is from the reference: its covariance in correlations, its mean in metres (or
/// rad) at the most.
struct Distance {
  double covariance = 0.0, mean = 0.0;

  void Take(const LeggedBelief& filter, const LeggedBelief& reference) {
    covariance = std::max(covariance, WorstCorrelationError(filter.P, reference.P));
    const auto e = testing_estimator::Error(reference.form, filter.x, reference.x);
    mean = std::max(mean, static_cast<double>(e.cwiseAbs().maxCoeff()));
  }
};

/// A walk of the whole filter, of which every message is repeated by the reference from where the
/// filter stood before it.
template <class Core>
class FeetReference : public ::testing::Test {
 protected:
  FeetReference() : setup_(Told()), filter_(setup_) {
    Prior prior = testing_estimator::TestPrior();
    prior.X_WB = {draws_.Rotation(), draws_.Vector(1.0)};
    prior.v_WB = draws_.Vector(0.5);
    filter_.Start(prior);
  }

  static estimator::Setup Told() {
    estimator::Setup setup = testing_estimator::QuadrupedSetup();
    setup.gate.action = GateAction::kOff;  // the draws below know of no robot
    return setup;
  }

  LeggedBelief Belief() const {
    return BeliefOf(Core::kForm, filter_.core().x(), filter_.core().P());
  }

  void Send(const models::Measurement& m) { ASSERT_EQ(filter_.Process(m).refusal, Refusal::kNone); }

  void Move(Real slip) {
    LeggedBelief reference = Belief();
    models::ImuSample sample;
    sample.gyro_rad_s = draws_.Vector(1.0);
    sample.accel_m_s2 = draws_.Vector(5.0);
    sample.interval_ns = 5 * kMs;
    t_ns_ += 5 * kMs;
    Send({testing_estimator::kImu, t_ns_, t_ns_, sample});
    const auto& R_BI = setup_.suite.sensors[testing_estimator::kImu].X_BS.R;
    const auto square = [](double s) { return s * s; };
    const Noise& n = setup_.noise;
    reference.Propagate(
        (R_BI * sample.gyro_rad_s).cast<Real>(), (R_BI * sample.accel_m_s2).cast<Real>(), 0.005,
        setup_.gravity_m_s2,
        {square(n.gyro_noise_density_rad_per_s_sqrt_hz),
         square(n.accel_noise_density_m_per_s2_sqrt_hz),
         square(n.gyro_bias_walk_rad_per_s2_sqrt_hz), square(n.accel_bias_walk_m_per_s3_sqrt_hz)},
        slip);
    moved_.Take(Belief(), reference);
  }

  void Correct() {
    const auto& legs = setup_.suite.legs->legs;
    models::EncoderVector angles = Stance();
    for (Eigen::Index i = 0; i < angles.size(); ++i) angles[i] += 2e-3 * draws_.Normal();
    LeggedBelief reference = Belief();
    std::vector<FootReading> readings;
    for (int i = 0; i < kMaxFeet; ++i) {
      if (!filter_.core().P().IsActive(FootSlot(i))) continue;
      readings.push_back(ReadFoot(legs[static_cast<std::size_t>(i)], angles,
                                  setup_.suite.sensors[testing_estimator::kImu].X_BS.p,
                                  setup_.noise));
    }
    reference.CorrectStacked(readings);
    const Report report = filter_.Process(JointsAt(t_ns_, angles));
    EXPECT_EQ(report.corrections().size(), readings.size());
    corrected_.Take(Belief(), reference);
  }

  Draws draws_{71};
  estimator::Setup setup_;
  ImuFilter<Core> filter_;
  TimeNs t_ns_ = 0;
  Distance moved_, corrected_;
};
using Cores = ::testing::Types<RightInvariantEkf, LeftInvariantEkf, MultiplicativeEkf>;
TYPED_TEST_SUITE(FeetReference, Cores);

TYPED_TEST(FeetReference, EveryStepAndEveryCorrectionOfAWalkIsTheDenseOne) {
  const Real slip = this->setup_.noise.foot_slip_m_per_s_sqrt_hz;
  const std::array<std::array<bool, 4>, 3> stances{
      {{true, false, true, true}, {true, true, true, true}, {false, true, true, false}}};
  for (const auto& s : stances) {
    this->Send(ContactsAt(this->t_ns_, s[0], s[1], s[2], s[3]));
    this->Move(slip);
    this->Send(JointsAt(this->t_ns_, Stance()));  // new feet are placed
    for (int i = 0; i < 10; ++i) {
      this->Move(slip);
      this->Correct();
    }
  }
  // One operation each, 6e-15 to 4e-14 measured a metre from the origin. Farther away the forms
  // whose θ turns positions lose digits in H P Hᵀ (6e-12 at 8 m), the right-invariant one none.
  EXPECT_LT(this->moved_.covariance, 1e-12);
  EXPECT_LT(this->moved_.mean, 1e-13);
  EXPECT_LT(this->corrected_.covariance, 1e-12) << "in sequence is not all at once";
  EXPECT_LT(this->corrected_.mean, 1e-12);
}

TYPED_TEST(FeetReference, ARollingFootIsTheDenseOne) {
  this->Send(ContactsAt(0, true, false, true, true));
  this->Send(JointsAt(0, Stance()));
  for (int i = 0; i < 5; ++i) {
    this->Move(this->setup_.noise.foot_slip_m_per_s_sqrt_hz);
    this->Correct();
  }
  TypeParam core = this->filter_.core();
  RollingFeet rolling;
  std::vector<testing_estimator::Roll> rolls;
  for (const int foot : {0, 2, 3}) {
    rolling.u.col(foot) = this->draws_.Vector(0.3);
    rolling.lever.col(foot) = this->draws_.Vector(0.02);
    rolls.push_back(
        {rolling.u.col(foot).template cast<Real>(), rolling.lever.col(foot).template cast<Real>()});
  }
  const Eigen::Vector3d gyro = this->draws_.Vector(1.0), accel = this->draws_.Vector(5.0);
  const ProcessNoise noise{1e-4, 1e-3, 1e-6, 1e-6};
  constexpr double kDt = 0.02;
  LeggedBelief reference = BeliefOf(TypeParam::kForm, core.x(), core.P());
  LeggedBelief standing = reference;
  reference.Propagate(gyro.cast<Real>(), accel.cast<Real>(), kDt, this->setup_.gravity_m_s2, noise,
                      0, rolls);
  standing.Propagate(gyro.cast<Real>(), accel.cast<Real>(), kDt, this->setup_.gravity_m_s2, noise);
  core.Propagate({gyro - core.x().gyro_bias, accel - core.x().accel_bias, kDt},
                 {0, 0, -this->setup_.gravity_m_s2}, noise, &rolling);
  const LeggedBelief moved = BeliefOf(TypeParam::kForm, core.x(), core.P());
  Distance distance, without;
  distance.Take(moved, reference);
  without.Take(moved, standing);
  EXPECT_LT(distance.covariance, 1e-12);
  EXPECT_LT(distance.mean, 1e-13);
  EXPECT_GT(without.covariance, 1e-8);  // a foot that stands is another one
  EXPECT_GT(without.mean, 1e-4);
}

TYPED_TEST(FeetReference, NoticesASlipThatIsALittleLess) {
  this->Send(ContactsAt(0, true, true, true, true));
  this->Send(JointsAt(0, Stance()));
  this->Move(0.99 * this->setup_.noise.foot_slip_m_per_s_sqrt_hz);
  EXPECT_GT(this->moved_.covariance, 1e-8);
}

}  // namespace
}  // namespace reckon::estimator

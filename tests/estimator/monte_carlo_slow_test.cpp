#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <functional>
#include <string>
#include <vector>

#include "estimator/dense.h"
#include "estimator/forms.h"
#include "estimator/simulated_drive.h"
#include "reckon/estimator/contact_model.h"
#include "reckon/estimator/depth_model.h"
#include "reckon/estimator/height_model.h"
#include "reckon/estimator/pose_model.h"
#include "reckon/estimator/standstill_model.h"
#include "reckon/estimator/velocity_model.h"
#include "reckon/estimator/wheel_model.h"

// Whether errors scatter as the covariance says: 2,000 draws of the error before, of the IMU's
// noise and of the measurement's. Errors are small (0.01 rad, 0.1 m), so that what the first order
// leaves out, some 1e-4 of them, is far below what 2,000 draws resolve.
namespace reckon::estimator {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing_estimator::ChiSquareAt;
using testing_estimator::Draws;
using testing_estimator::NameOf;

constexpr int kRuns = 2000;
constexpr int kSteps = 200;  ///< one second
constexpr double kDt = 5e-3;
constexpr double kGyroSampleVariance = 1e-4;  ///< of the sample that a lever arm's velocity takes
const Vector3d kDown(0, 0, -9.81);
const Vector3d kFoot(0.3, -0.2, -0.5);                  ///< in I, where it is set down
const Vector3d kFootSigma(0.02, 0.03, 0.01);            ///< of a reading of it
const ProcessNoise kNoise{2.5e-5, 2.5e-3, 1e-6, 1e-4};  ///< strong: it matters within the second

ErrorVector PriorSigma() {
  ErrorVector s;
  s << 0.01, 0.01, 0.01, 0.05, 0.05, 0.05, 0.1, 0.1, 0.1, 2e-3, 2e-3, 2e-3, 0.02, 0.02, 0.02;
  return s;
}

/// A world at the end of the second: what is true, and the filters that have come there.
template <class Core>
struct World {
  NavigationState truth;
  Vector3d w;       ///< the true angular rate
  Vector3d foot_W;  ///< where a foot stands, set down at the start
  Core core;        ///< with that foot in slot 0
};

/// What moves the truth in step `i`, whatever its orientation `R`.
Increment Motion(int i, const Matrix3d& R) {
  const Vector3d w(0.3 * std::sin(0.02 * i), 0.4, -0.5 * std::cos(0.03 * i));
  return {w, R.transpose() * (Vector3d(std::cos(0.05 * i), 0.5, -0.2) - kDown), kDt};
}

/// Ends at rest: a zero velocity is one of the measurements.
NavigationState DrawnStart(Draws& draws) {
  NavigationState x;
  x.R = draws.Rotation();
  x.p = draws.Vector(1.0);
  x.gyro_bias = draws.Vector(0.02);
  x.accel_bias = draws.Vector(0.1);
  NavigationState end = x;
  for (int i = 0; i < kSteps; ++i) end = Propagated(end, Motion(i, end.R), kDown);
  x.v = -end.v;
  return x;
}

template <class Core>
World<Core> Drawn(Draws& draws, const ProcessNoise& believed) {
  World<Core> world;
  NavigationState& x = world.truth;
  x = DrawnStart(draws);
  const ErrorVector sigma = PriorSigma();
  const ErrorVector e = sigma.cwiseProduct(draws.Normals<15>());
  const testing_estimator::State hat = testing_estimator::Erring(
      Core::kForm, testing_estimator::Widened(x), e.cast<testing_estimator::Real>());
  world.core.x() = {hat.R.cast<double>(), hat.v.cast<double>(), hat.p.cast<double>(),
                    hat.bg.cast<double>(), hat.ba.cast<double>()};
  world.core.P().Start(sigma.cwiseAbs2().asDiagonal());
  world.foot_W = x.p + x.R * kFoot;
  const Matrix3d foot_N = kFootSigma.cwiseAbs2().asDiagonal();
  AddFoot(world.core, {kFoot + kFootSigma.cwiseProduct(draws.Vector()), foot_N}, FootSlot(0));
  const auto white = [&](double density2) { return draws.Vector(std::sqrt(density2 / kDt)); };
  const auto walk = [&](double density2) { return draws.Vector(std::sqrt(density2 * kDt)); };
  for (int i = 0; i < kSteps; ++i) {
    const Increment u = Motion(i, x.R);
    world.w = u.w;
    const Vector3d gyro = world.w + x.gyro_bias + white(kNoise.gyro);
    const Vector3d accel = u.a + x.accel_bias + white(kNoise.accel);
    const NavigationState& estimate = world.core.x();
    world.core.Propagate({gyro - estimate.gyro_bias, accel - estimate.accel_bias, kDt}, kDown,
                         believed);
    x = Propagated(x, u, kDown);
    x.gyro_bias += walk(kNoise.gyro_walk);
    x.accel_bias += walk(kNoise.accel_walk);
  }
  return world;
}

template <int kRows, class Core>
void Correct(Core& core, const Linearisation<kRows>& m) {
  const auto& own = Core::Convert(m, core.x());
  const KalmanCorrection<kRows> kalman(core.P(), own);
  core.Retract(kalman.Gain());
  kalman.UpdateCovariance(core.P());
}

/// Mean of e²/P of each coordinate and of eᵀ P⁻¹ e, over the runs.
struct Scatter {
  ErrorVector squares = ErrorVector::Zero();
  double nees = 0.0;

  void Add(const ErrorVector& e, const ErrorCovariance& P) {
    squares += (e.array().square() / P.diagonal().array()).matrix() / kRuns;
    nees += e.dot(P.ldlt().solve(e)) / kRuns;
  }
  /// A χ² of one degree of freedom has variance 2: five sigmas of the mean for each coordinate.
  bool EveryCoordinateFits() const {
    return ((squares.array() - 1.0).abs() < 5.0 * std::sqrt(2.0 / kRuns)).all();
  }
  /// One in a million, both sides.
  bool NeesFits() const {
    const double sum = nees * kRuns, dof = 15.0 * kRuns;
    return sum > ChiSquareAt(-4.89, dof) && sum < ChiSquareAt(4.89, dof);
  }
};

/// A correction of the world's filter by a sensor whose noise is drawn with the standard deviation
/// that the filter believes in, times `honesty`.
template <class Core>
struct Kind {
  std::string name;
  std::function<void(World<Core>&, Draws&, double honesty)> correct;
};

template <class Core>
std::vector<Kind<Core>> Velocities() {
  const models::Pose X_IS{Exp({0.3, -0.2, 0.9}), {0.4, -0.3, 0.2}};
  const auto turn = [](const World<Core>& world, Draws& draws) {
    const Vector3d w = world.w + world.truth.gyro_bias +
                       draws.Vector(std::sqrt(kGyroSampleVariance)) - world.core.x().gyro_bias;
    return TurnRate{w, kGyroSampleVariance};
  };
  return {{"body velocity",
           [=](World<Core>& world, Draws& draws, double honesty) {
             Matrix3d root;
             root << 0.03, 0, 0, 0.01, 0.02, 0, -0.01, 0.01, 0.04;
             models::BodyVelocitySample y;
             y.covariance = root * root.transpose();
             const NavigationState& x = world.truth;
             y.v_WS_S = X_IS.R.transpose() * (x.R.transpose() * x.v + world.w.cross(X_IS.p)) +
                        honesty * root * draws.Vector();
             Correct(world.core, LinearisedVelocity(y, X_IS, turn(world, draws), world.core.x()));
           }},
          {"wheels",
           [=](World<Core>& world, Draws& draws, double honesty) {
             // Their three rows, with noise that differs by the axis.
             const Vector3d sigma(0.02, 0.05, 0.1);
             models::BodyVelocitySample y;
             y.covariance = sigma.cwiseAbs2().asDiagonal();
             const NavigationState& x = world.truth;
             const models::Pose X_IB{Matrix3d::Identity(), {-0.1, 0.05, -0.2}};
             y.v_WS_S = x.R.transpose() * x.v + world.w.cross(X_IB.p) +
                        honesty * sigma.cwiseProduct(draws.Vector());
             Correct(world.core, LinearisedVelocity(y, X_IB, turn(world, draws), world.core.x()));
           }},
          {"zero velocity",
           [](World<Core>& world, Draws& draws, double honesty) {
             auto m = LinearisedZeroVelocity(0.03, world.core.x());
             m.z += draws.Vector(0.03 * honesty);
             Correct(world.core, m);
           }},
          {"zero rate", [](World<Core>& world, Draws& draws, double honesty) {
             const Vector3d w = world.truth.gyro_bias + draws.Vector(1e-3 * honesty);
             Correct(world.core, LinearisedZeroRate(w, 1e-6, world.core.x()));
           }}};
}

template <class Core>
std::vector<Kind<Core>> Positions() {
  const models::Pose X_IS{Exp({0.1, 0.2, -0.4}), {0.3, 0.1, -0.2}};
  return {{"depth",
           [=](World<Core>& world, Draws& draws, double honesty) {
             const NavigationState& x = world.truth;
             const double depth = -(x.p + x.R * X_IS.p).z() + 0.02 * honesty * draws.Normal();
             Correct(world.core, LinearisedDepth({depth}, X_IS.p, 0.02, world.core.x()));
           }},
          {"position",
           [=](World<Core>& world, Draws& draws, double honesty) {
             const NavigationState& x = world.truth;
             models::PoseSample y;
             y.position_sigma_m = Vector3d(0.02, 0.05, 0.1);
             y.X_WS = models::Pose{x.R, x.p} * X_IS;
             y.X_WS.p += honesty * y.position_sigma_m.cwiseProduct(draws.Vector());
             Correct(world.core, LinearisedPosition(y, X_IS, 1.0, world.core.x()));
           }},
          {"yaw",
           [=](World<Core>& world, Draws& draws, double honesty) {
             const NavigationState& x = world.truth;
             models::PoseSample y;
             y.has_orientation = true;
             y.orientation_sigma_rad = Vector3d::Constant(0.005);
             y.X_WS = models::Pose{x.R, x.p} * X_IS;
             y.X_WS.R = Exp({0, 0, 0.005 * honesty * draws.Normal()}) * y.X_WS.R;
             if (const auto m = LinearisedYaw(y, X_IS, 1.0, world.core.x())) {
               Correct(world.core, *m);
             }
           }},
          {"contact",
           [](World<Core>& world, Draws& draws, double honesty) {
             const NavigationState& x = world.truth;
             const Vector3d h = x.R.transpose() * (world.foot_W - x.p);
             const Matrix3d N = kFootSigma.cwiseAbs2().asDiagonal();
             Correct(world.core,
                     LinearisedContact({h + honesty * kFootSigma.cwiseProduct(draws.Vector()), N},
                                       FootSlot(0), world.core.x()));
           }},
          {"floor under a foot", [](World<Core>& world, Draws& draws, double honesty) {
             const double height = world.foot_W.z() + 0.02 * honesty * draws.Normal();
             Correct(world.core,
                     LinearisedHeight(height, 0.02, FootSlot(0), world.core.x().At(FootSlot(0))));
           }}};
}

template <class Core>
class MonteCarlo : public ::testing::Test {
 protected:
  /// The scatter before any correction and after each kind of them.
  std::vector<std::pair<std::string, Scatter>> Scatters(const ProcessNoise& believed,
                                                        double honesty) {
    auto kinds = Velocities<Core>();
    for (auto& kind : Positions<Core>()) kinds.push_back(std::move(kind));
    std::vector<std::pair<std::string, Scatter>> all{{"propagation", {}}};
    for (const auto& kind : kinds) all.emplace_back(kind.name, Scatter{});
    Draws draws(77);
    for (int run = 0; run < kRuns; ++run) {
      const World<Core> start = Drawn<Core>(draws, believed);
      for (std::size_t k = 0; k < all.size(); ++k) {
        World<Core> world = start;
        if (k > 0) kinds[k - 1].correct(world, draws, honesty);
        all[k].second.Add(ErrorBetween(Core::kForm, world.core.x(), world.truth),
                          world.core.P().Dense());
      }
    }
    return all;
  }
};
using Cores = ::testing::Types<RightInvariantEkf, LeftInvariantEkf, MultiplicativeEkf>;
TYPED_TEST_SUITE(MonteCarlo, Cores);

TYPED_TEST(MonteCarlo, ErrorsScatterAsTheCovarianceSays) {
  for (const auto& [name, scatter] : this->Scatters(kNoise, 1.0)) {
    EXPECT_TRUE(scatter.EveryCoordinateFits()) << name << ": " << scatter.squares.transpose();
    EXPECT_TRUE(scatter.NeesFits()) << name << ": NEES " << scatter.nees << " of 15";
  }
}

TYPED_TEST(MonteCarlo, NoiseBelievedTooSmallShows) {
  ProcessNoise tenth = kNoise;
  tenth.gyro /= 10;
  tenth.accel /= 10;
  EXPECT_FALSE(this->Scatters(tenth, 1.0).front().second.NeesFits()) << "of the IMU";
  for (const auto& [name, scatter] : this->Scatters(kNoise, std::sqrt(10.0))) {
    EXPECT_EQ(scatter.NeesFits(), name == "propagation") << name << ": " << scatter.nees;
  }
}

}  // namespace
}  // namespace reckon::estimator

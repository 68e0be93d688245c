// The simulated robot against independent computations.
#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <Eigen/LU>

#include "reckon/sim/world.h"
#include "sim/husky.h"

namespace reckon::sim {
namespace {

constexpr double kLength = 0.512, kTrack = 0.555, kMass = 56.582, kGravity = 9.81, kFriction = 0.8;
// Centre of mass over the ground: 46.034 kg at 0.062 m and four wheels at 0.03282 m over the base's
// origin, which stands 0.13228 m high.
constexpr double kComHeight = 0.13228 + (46.034 * 0.062 + 10.548 * 0.03282) / kMass;
// A tyre that carries a quarter of the robot rolls on the radius R − δ/3.
constexpr double kRolling = 1.0 - kMass * kGravity / 4 / 32e3 / 3 / 0.1651;

/// A skid-steer in a steady turn as a planar body on four Coulomb contacts with load transfer:
/// wheel speeds v ∓ ω B/2 are given; forces and moments balance the centripetal acceleration.
class PlanarModel {
 public:
  explicit PlanarModel(double com_height_m, double com_x_m = 0.0)
      : height_(com_height_m), com_x_(com_x_m) {}

  /// (vx, vy, ωz) for the commanded (v, ω).
  Eigen::Vector3d Solve(double v, double w) const {
    Eigen::Vector3d q(v, -0.02 * w, 0.54 * w);
    for (int i = 0; i < 100; ++i) {
      const Eigen::Vector3d r = Residual(q, v, w);
      if (r.norm() < 1e-10) return q;
      Eigen::Matrix3d J;
      for (int j = 0; j < 3; ++j)
        J.col(j) = (Residual(q + 1e-7 * Eigen::Vector3d::Unit(j), v, w) - r) / 1e-7;
      const Eigen::Vector3d step = -J.partialPivLu().solve(r);
      double length = 1.0;
      while (length > 1e-4 && Residual(q + length * step, v, w).norm() > r.norm()) length /= 2;
      q += length * step;
    }
    ADD_FAILURE() << "the planar model did not converge";
    return q;
  }

 private:
  Eigen::Vector3d Residual(const Eigen::Vector3d& q, double v, double w) const {
    // Of the centre of mass, which lies com_x_ ahead of the wheels' centre.
    const double ax = -q(2) * (q(1) + q(2) * com_x_), ay = q(2) * q(0);
    Eigen::Vector3d sum(-kMass * ax, -kMass * ay, 0);
    for (const double x : {kLength / 2, -kLength / 2}) {
      for (const double y : {kTrack / 2, -kTrack / 2}) {
        const double ahead = (kGravity * com_x_ - ax * height_) * x / (kLength * kLength);
        const double aside = -ay * height_ * y / (kTrack * kTrack);
        const double load = kMass * (kGravity / 4 + ahead + aside);
        const Eigen::Vector2d slip(q(0) - q(2) * y - (v - w * y), q(1) + q(2) * x);
        const Eigen::Vector2d force = -kFriction * load * slip / (slip.norm() + 1e-15);
        sum += Eigen::Vector3d(force.x(), force.y(), (x - com_x_) * force.y() - y * force.x());
      }
    }
    return sum;
  }

  double height_, com_x_;
};

struct TurnRow {
  double v, w;
  Eigen::Vector3d result;  // vx, vy, ωz
};
const std::array<TurnRow, 5> kTurns{{{0.0, 0.9, {0, 0, 0.4862}},
                                     {0.0, 2.0, {0, 0, 1.0805}},
                                     {0.6, 0.6, {0.6019, -0.0061, 0.3245}},
                                     {0.9, 1.2, {0.9106, -0.0369, 0.6546}},
                                     {0.3, 1.5, {0.3051, -0.0189, 0.8117}}}};

WorldConfig Profile(double v, double w) {
  WorldConfig config;
  config.motion.path = PathKind::kVelocityProfile;
  config.motion.start_s = 0.0;
  config.motion.profile = {{0.0, v, w}};
  return config;
}

/// Means of (vx, vy, ωz) in B once the turn is steady, and of the wheel speeds' difference.
struct SteadyTurn {
  Eigen::Vector3d motion = Eigen::Vector3d::Zero();
  double ratio = 0.0;  // (v_right − v_left)/B over ωz, with the radius that rolls
};

SteadyTurn Measure(const WorldConfig& config) {
  World world(Husky(), config, 1);
  while (world.motion().t_ns < 5 * models::kNsPerSecond) world.Advance();
  SteadyTurn turn;
  double difference = 0.0;
  const int samples = 5000;
  for (int i = 0; i < samples; ++i) {
    world.Advance();
    const auto truth = world.TruthNow();
    const Eigen::Vector3d v_WB_B = truth.X_WB.R.transpose() * truth.v_WB;
    turn.motion += Eigen::Vector3d(v_WB_B.x(), v_WB_B.y(), truth.w_WB_B.z()) / samples;
    difference +=
        (truth.wheel_rate_rad_s.tail(2).mean() - truth.wheel_rate_rad_s.head(2).mean()) / samples;
  }
  turn.ratio = kRolling * 0.1651 * difference / kTrack / turn.motion.z();
  return turn;
}

TEST(PhysicsOracles, ThePlanarModelGivesThePublishedTable) {
  const PlanarModel model(kComHeight);
  for (const auto& [v, w, published] : kTurns) {
    // The table has four decimals.
    EXPECT_LT((model.Solve(v, w) - published).cwiseAbs().maxCoeff(), 0.51e-4) << v << ", " << w;
  }
}

TEST(PhysicsOracles, TheRobotTurnsAsThePlanarModelDoes) {
  const PlanarModel model(kComHeight), without_transfer(0.0);
  for (const auto& [v, w, published] : kTurns) {
    const Eigen::Vector3d expected = model.Solve(kRolling * v, kRolling * w);
    const Eigen::Vector3d measured = Measure(Profile(v, w)).motion;
    // The tyre's finite relaxation length and its damper (60 N s/m of slip below 0.3 m/s) turn the
    // friction of each wheel by about one part in a hundred: 2e-3 of speeds below 1.
    EXPECT_LT((measured - expected).cwiseAbs().maxCoeff(), 2e-3)
        << v << ", " << w << ": " << measured.transpose() << " against " << expected.transpose();
  }
  // A control: without load transfer, the fast turn of the table would be missed.
  EXPECT_GT((without_transfer.Solve(0.9, 1.2) - kTurns[3].result).cwiseAbs().maxCoeff(), 1e-2);
}

TEST(PhysicsOracles, EqualLoadsTurnByTheClosedForm) {
  // Isotropic Coulomb friction and equal loads on the spot: χ = 1 + (L/B)².
  const double closed_form = 1.0 + std::pow(kLength / kTrack, 2);
  EXPECT_NEAR(closed_form, 1.851, 5e-4);
  const double ratio = Measure(Profile(0.0, 0.9)).ratio;
  EXPECT_NEAR(ratio, closed_form, 0.002);  // 0.1 %: the tyre's damper and relaxation
}

TEST(PhysicsOracles, AnUnevenLoadTurnsMoreEasily) {
  // The loaded axle pivots, the other one is dragged: χ falls, and the body's origin drifts.
  for (const double com_x : {0.04, -0.06}) {
    WorldConfig config = Profile(0.0, 0.9);
    config.actual.com_offset_m.x() = com_x * kMass / 46.034;  // of the base link
    const Eigen::Vector3d expected = PlanarModel(kComHeight, com_x).Solve(0.0, kRolling * 0.9);
    const SteadyTurn turn = Measure(config);
    EXPECT_LT((turn.motion - expected).cwiseAbs().maxCoeff(), 2e-3) << com_x;
    EXPECT_LT(turn.ratio, 1.8);
  }
}

TEST(PhysicsOracles, FlatGroundDoesNotShake) {
  WorldConfig config = Profile(0.8, 0.0);
  World world(Husky(), config, 1);
  const Eigen::Vector3d p_BS(0.19, 0.0, 0.149);  // the IMU
  while (world.motion().t_ns < 3 * models::kNsPerSecond) world.Advance();
  double sum = 0.0, squares = 0.0;
  const int samples = 10000;
  for (int i = 0; i < samples; ++i) {
    world.Advance();
    const auto& m = world.motion();
    const double a =
        ((m.X_WB_next * p_BS).z() - 2 * (m.X_WB * p_BS).z() + (m.X_WB_previous * p_BS).z()) / 1e-6;
    sum += a;
    squares += a * a;
  }
  EXPECT_LT(std::sqrt(squares / samples - std::pow(sum / samples, 2)), 1e-4);
  EXPECT_GT(world.TruthNow().v_WB.x(), 0.78);  // it does drive
}

TEST(PhysicsOracles, SlopesHoldWithoutCreep) {
  for (const double angle_deg : {10.0, 20.0, 35.0}) {
    for (const double uphill_deg : {0.0, 60.0, 180.0}) {
      WorldConfig config;
      config.terrain.kind = TerrainKind::kSlope;
      config.terrain.angle_deg = angle_deg;
      config.terrain.uphill_deg = uphill_deg;
      World world(Husky(), config, 1);
      world.Advance();
      const Eigen::Vector3d start = world.motion().X_WB.p;
      while (world.motion().t_ns < 10 * models::kNsPerSecond) world.Advance();
      // The residue of coming to rest, 1e-6 m/s at most; a creep of MuJoCo's own friction would be
      // millimetres.
      EXPECT_LT((world.motion().X_WB.p - start).norm(), 1e-6)
          << angle_deg << "°, " << uphill_deg << "°";
    }
  }
}

TEST(PhysicsOracles, ASlopeSlipsByTheTyresCompliance) {
  // Rolling along a slope, the tyre gives F = k σ (slip ratio): 10° costs m g sin(10°)/(4 k σ)
  // = 1.9 %.
  const auto slip_ratio = [](double angle_deg) {
    WorldConfig config = Profile(0.8, 0.0);
    config.terrain.kind = TerrainKind::kSlope;
    config.terrain.angle_deg = angle_deg;
    World world(Husky(), config, 1);
    while (world.motion().t_ns < 8 * models::kNsPerSecond) world.Advance();
    const auto truth = world.TruthNow();
    return 1.0 - truth.v_WB.norm() / (kRolling * 0.1651 * truth.wheel_rate_rad_s.mean());
  };
  const double expected =
      kMass * kGravity * std::sin(10 * std::numbers::pi / 180) / (4 * 25e3 * 0.05);
  EXPECT_NEAR(expected, 0.019, 5e-4);
  // The damper carries c v/(kσ) = 4 % of the force; the axles share the load unevenly.
  EXPECT_NEAR(slip_ratio(10.0), expected, 0.08 * expected);
  EXPECT_NEAR(slip_ratio(-10.0), -expected, 0.08 * expected);
}

TEST(PhysicsOracles, KerbsArePassedUpright) {
  WorldConfig config;
  config.terrain.kind = TerrainKind::kKerbs;
  config.motion.path = PathKind::kWaypoints;
  config.motion.waypoints_m = {{11.0, 0.0}};
  World world(Husky(), config, 1);
  double flat = 0.0, highest = 0.0, steepest = 1.0;
  while (world.motion().t_ns < 20 * models::kNsPerSecond) {
    world.Advance();
    const auto& X_WB = world.motion().X_WB;
    if (world.motion().t_ns == 0) flat = X_WB.p.z();
    highest = std::max(highest, X_WB.p.z() - flat);
    steepest = std::min(steepest, X_WB.R(2, 2));
  }
  EXPECT_NEAR(world.motion().X_WB.p.x(), 11.0, 0.2);  // over three kerbs
  EXPECT_GT(highest, 0.018);  // one axle on a kerb of 4 cm lifts the middle by 2 cm,
  EXPECT_LT(highest, 0.06);   // and it does not leap
  EXPECT_GT(steepest, std::cos(15 * std::numbers::pi / 180));
}

}  // namespace
}  // namespace reckon::sim

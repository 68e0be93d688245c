#include "reckon/sim/dvl_beams.h"

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>
#include <Eigen/Cholesky>

namespace reckon::sim {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Readings = std::vector<std::optional<double>>;

constexpr double kAngleDeg = 22.5, kSigma = 0.005;
const double kAngle = kAngleDeg * std::numbers::pi / 180;

DvlBeams Janus() { return {"dvl", kAngleDeg, {45, 135, 225, 315}}; }

Readings Along(const DvlBeams& beams, const Vector3d& v) {
  Readings readings;
  for (const Vector3d& u : beams.directions()) readings.emplace_back(u.dot(v));
  return readings;
}

TEST(DvlBeams, GiveTheVelocityBack) {
  const DvlBeams beams = Janus();
  const Vector3d v(1.2, -0.3, 0.1);
  const auto four = beams.Solve(Along(beams, v), kSigma);
  ASSERT_TRUE(four);
  EXPECT_LT((four->velocity_m_s - v).norm(), 1e-15);
  EXPECT_EQ(four->beams, 4);
  EXPECT_LT(four->disagreement_m_s, 1e-15);
  for (std::size_t lost = 0; lost < 4; ++lost) {
    Readings readings = Along(beams, v);
    readings[lost].reset();
    const auto three = beams.Solve(readings, kSigma);
    ASSERT_TRUE(three);
    EXPECT_LT((three->velocity_m_s - v).norm(), 1e-15);
    EXPECT_EQ(three->disagreement_m_s, 0.0);
    readings[(lost + 1) % 4].reset();
    EXPECT_FALSE(beams.Solve(readings, kSigma)) << "two beams are no velocity";
  }
}

TEST(DvlBeams, LookDown) {
  const DvlBeams beams = Janus();
  for (const Vector3d& u : beams.directions()) {
    EXPECT_NEAR(u.z(), -std::cos(kAngle), 1e-15);
    EXPECT_NEAR(u.norm(), 1.0, 1e-15);
  }
  EXPECT_GT(beams.directions()[0].x(), 0.0);
  EXPECT_GT(beams.directions()[0].y(), 0.0);
}

/// Mean squares of the error of many noisy solutions, and their mean NEES.
struct Scatter {
  Vector3d square = Vector3d::Zero();
  double nees = 0.0, disagreement = 0.0;
};

constexpr int kDraws = 20000;

Scatter ScatterOf(const DvlBeams& beams, bool three) {
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal(0.0, kSigma);
  const Vector3d v(1.0, 0.5, -0.2);
  Scatter scatter;
  for (int i = 0; i < kDraws; ++i) {
    Readings readings = Along(beams, v);
    for (auto& reading : readings) *reading += normal(engine);
    if (three) readings[2].reset();
    const BeamSolution solution = *beams.Solve(readings, kSigma);
    const Vector3d e = solution.velocity_m_s - v;
    scatter.square += e.cwiseAbs2() / kDraws;
    scatter.nees += e.dot(solution.covariance_m2_s2.llt().solve(e)) / kDraws;
    scatter.disagreement += solution.disagreement_m_s * solution.disagreement_m_s / kDraws;
  }
  return scatter;
}

/// A mean square of so many draws scatters by sqrt(2/n): 5 sigma.
const double kFiveSigma = 5 * std::sqrt(2.0 / kDraws);

TEST(DvlBeams, ScatterAsTheGeometryOfAJanusSays) {
  const Scatter scatter = ScatterOf(Janus(), false);
  const double level = kSigma / (std::sqrt(2.0) * std::sin(kAngle));
  const double vertical = kSigma / (2.0 * std::cos(kAngle));
  EXPECT_NEAR(scatter.square.x() / (level * level), 1.0, kFiveSigma);
  EXPECT_NEAR(scatter.square.y() / (level * level), 1.0, kFiveSigma);
  EXPECT_NEAR(scatter.square.z() / (vertical * vertical), 1.0, kFiveSigma);
  EXPECT_NEAR(scatter.nees / 3, 1.0, kFiveSigma / std::sqrt(3.0));
  // One number too many: the beams' own deviation.
  EXPECT_NEAR(scatter.disagreement / (kSigma * kSigma), 1.0, kFiveSigma);
}

TEST(DvlBeams, DeliverTheCovarianceOfThree) {
  const Scatter three = ScatterOf(Janus(), true), four = ScatterOf(Janus(), false);
  EXPECT_NEAR(three.nees / 3, 1.0, kFiveSigma / std::sqrt(3.0));
  EXPECT_GT(three.square.x(), 1.2 * four.square.x()) << "it is a worse one";
}

std::string Complaint(double angle_deg, const std::vector<double>& azimuths_deg) {
  try {
    DvlBeams("sensor 'd'", angle_deg, azimuths_deg);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(DvlBeams, RefuseAGeometryThatIsBlind) {
  EXPECT_EQ(Complaint(25, {0, 120, 240}), "");
  const std::string angle = "sensor 'd': beam_angle_deg must lie between 0 and 90, without them";
  for (const double wrong : {0.0, 90.0, -5.0, std::nan("")}) {
    EXPECT_EQ(Complaint(wrong, {0, 120, 240}), angle);
  }
  EXPECT_EQ(Complaint(25, {0, 180}), "sensor 'd': azimuths_deg must be 3 to 8 beams");
  EXPECT_EQ(Complaint(25, {0, 180, 180}),
            "sensor 'd': azimuths_deg leave a direction that no beam sees");
}

}  // namespace
}  // namespace reckon::sim

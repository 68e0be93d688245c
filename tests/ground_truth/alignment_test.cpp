#include "reckon/ground_truth/alignment.h"

#include <gtest/gtest.h>

#include <array>

#include "ground_truth/tracks.h"
#include "reckon/ground_truth/ate.h"
#include "reckon/ground_truth/statistics.h"
#include "reckon/ground_truth/tum.h"

namespace reckon::ground_truth {
namespace {

using testing::CircleTrack;
using testing::Rot;
using testing::Rz;

double PositionRmse(const Track& track, const Similarity& alignment) {
  return Summarise(AbsoluteError(track.samples(), alignment).position_m).rmse;
}

/// A circle whose estimates were all moved by X and scaled.
Track MovedCircle(const models::Pose& X, double scale = 1.0) {
  return CircleTrack(200, 10.0, [&](estimator::Estimate& estimate) {
    estimate.X_WB = {X.R * estimate.X_WB.R, scale * (X.R * estimate.X_WB.p) + X.p};
    estimate.v_WB = scale * (X.R * estimate.v_WB);
  });
}

/// Each alignment takes away exactly the motion that it may, in position, orientation and velocity.
TEST(Alignment, TakesAwayWhatItMay) {
  const models::Pose yaw_position{Rz(0.7), {1.0, -2.0, 3.0}};
  const models::Pose any{Rot(0.4, {1.0, 2.0, 3.0}), {1.0, -2.0, 3.0}};
  struct Case {
    Alignment alignment;
    Track track;
    bool removes;
  };
  const std::array cases{
      Case{Alignment::kNone, MovedCircle({}), true},
      Case{Alignment::kNone, MovedCircle(yaw_position), false},
      Case{Alignment::kYawPosition, MovedCircle(yaw_position), true},
      Case{Alignment::kYawPosition, MovedCircle(any), false},
      Case{Alignment::kFirstYawPosition, MovedCircle(yaw_position), true},
      Case{Alignment::kFirstYawPosition, MovedCircle(any), false},
      Case{Alignment::kFirstPose, MovedCircle(any), true},
      Case{Alignment::kFirstPose, MovedCircle(any, 1.1), false},
      Case{Alignment::kSe3, MovedCircle(any), true},
      Case{Alignment::kSe3, MovedCircle(any, 1.1), false},
      Case{Alignment::kSim3, MovedCircle(any, 1.1), true},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(static_cast<int>(c.alignment));
    const Similarity alignment = Align(c.alignment, c.track.samples());
    const AbsoluteErrors errors = AbsoluteError(c.track.samples(), alignment);
    const double position = Summarise(errors.position_m).max;
    if (c.removes) {
      EXPECT_LT(position, 1e-12);  // roundings of numbers of order 10
      EXPECT_LT(Summarise(errors.orientation_deg).max, 1e-6);
      EXPECT_LT(Summarise(errors.velocity_m_s).max, 1e-12);
    } else {
      EXPECT_GT(position, 0.1);
    }
  }
}

/// The closed form of yaw + position against a search that knows nothing of it: over a grid of yaws
/// refined by golden section, with the best translation for each yaw by its own average.
TEST(Alignment, YawPositionEqualsABruteForceSearch) {
  const std::string folder = RECKON_SOURCE_DIR "/tests/ground_truth/evo_fixture/";
  const auto truth = ReadTum(folder + "truth.tum"), estimate = ReadTum(folder + "est.tum");
  Track track;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    Truth t;
    estimator::Estimate e;
    t.t_ns = e.t_ns = truth[i].t_ns;
    t.X_WB = truth[i].X_WB;
    e.X_WB = estimate[i].X_WB;
    track.Add(t, e);
  }
  const auto cost = [&](double yaw) {
    Eigen::Vector3d shift = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < truth.size(); ++i) {
      shift += truth[i].X_WB.p - Rz(yaw) * estimate[i].X_WB.p;
    }
    shift /= static_cast<double>(truth.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      sum += (truth[i].X_WB.p - Rz(yaw) * estimate[i].X_WB.p - shift).squaredNorm();
    }
    return std::sqrt(sum / static_cast<double>(truth.size()));
  };
  double best = 0.0;
  for (int k = -180; k < 180; ++k) {
    const double yaw = k * std::numbers::pi / 180.0;
    if (cost(yaw) < cost(best)) best = yaw;
  }
  double low = best - 0.02, high = best + 0.02;
  for (int k = 0; k < 60; ++k) {
    const double a = low + 0.382 * (high - low), b = high - 0.382 * (high - low);
    (cost(a) < cost(b) ? high : low) = cost(a) < cost(b) ? b : a;
  }
  const double rmse = PositionRmse(track, Align(Alignment::kYawPosition, track.samples()));
  EXPECT_NEAR(rmse, cost(0.5 * (low + high)), 1e-12 * rmse);
  // Computed once by a program that is not this one, and kept beside evo's numbers.
  EXPECT_NEAR(rmse, 0.48562843866505573, 1e-9 * rmse);
}

TEST(Alignment, OfNothingIsNothing) {
  const Similarity alignment = Align(Alignment::kSe3, {});
  EXPECT_EQ(alignment.scale, 1.0);
  EXPECT_EQ(alignment.X.R, Eigen::Matrix3d::Identity());
}

}  // namespace
}  // namespace reckon::ground_truth

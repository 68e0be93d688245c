#include "reckon/ground_truth/ate.h"

#include <gtest/gtest.h>

#include "ground_truth/tracks.h"
#include "reckon/ground_truth/statistics.h"

namespace reckon::ground_truth {
namespace {

using testing::CircleTrack;
using testing::Rot;
using testing::Rz;

TEST(RotationAngle, IsExactFromTinyAnglesToHalfTurns) {
  const Eigen::Vector3d axis(1.0, -2.0, 0.5);
  for (const double angle : {1e-12, 1e-9, 1e-3, 1.0, 3.0, std::numbers::pi}) {
    // The matrix itself is rounded at 1e-16.
    EXPECT_NEAR(RotationAngle(Rot(angle, axis)), angle, 4e-16 + 1e-14 * angle);
  }
  EXPECT_EQ(RotationAngle(Eigen::Matrix3d::Identity()), 0.0);
}

TEST(AbsoluteError, OfConstantErrors) {
  const Track track = CircleTrack(50, 10.0, [](estimator::Estimate& estimate) {
    estimate.X_WB.p += Eigen::Vector3d(3.0, 4.0, 0.0);
    estimate.X_WB.R = estimate.X_WB.R * Rz(std::numbers::pi / 6.0);
    estimate.v_WB += Eigen::Vector3d(0.0, 0.0, 2.0);
  });
  const AbsoluteErrors errors = AbsoluteError(track.samples(), {});
  ASSERT_EQ(errors.position_m.size(), 50U);
  for (std::size_t i = 0; i < 50; ++i) {
    EXPECT_NEAR(errors.position_m[i], 5.0, 1e-13);
    EXPECT_NEAR(errors.orientation_deg[i], 30.0, 1e-12);
    EXPECT_NEAR(errors.velocity_m_s[i], 2.0, 1e-14);
  }
}

/// Defects that a score must not miss: it grows by orders of magnitude.
TEST(AbsoluteError, SeesAShiftedStampAndASwappedQuaternion) {
  const auto score = [](const std::function<void(estimator::Estimate&)>& spoil) {
    const Track track = CircleTrack(200, 10.0, spoil);
    const auto alignment = Align(Alignment::kFirstPose, track.samples());
    return AbsoluteError(track.samples(), alignment);
  };
  const AbsoluteErrors honest = score([](estimator::Estimate&) {});
  EXPECT_LT(Summarise(honest.position_m).rmse, 1e-13);
  EXPECT_LT(Summarise(honest.orientation_deg).rmse, 1e-6);

  const AbsoluteErrors late = score([](estimator::Estimate& estimate) {
    const Truth truth =
        testing::CircleTruth(std::max<models::TimeNs>(0, estimate.t_ns - 20'000'000));
    estimate.X_WB = truth.X_WB;
  });
  EXPECT_NEAR(Summarise(late.position_m).rmse, 0.02, 0.004);  // 1 m/s for 20 ms

  const AbsoluteErrors swapped = score([](estimator::Estimate& estimate) {
    const Eigen::Quaterniond q(estimate.X_WB.R);
    estimate.X_WB.R = Eigen::Quaterniond(q.x(), q.y(), q.z(), q.w()).toRotationMatrix();
  });
  EXPECT_GT(Summarise(swapped.orientation_deg).rmse, 10.0);
}

}  // namespace
}  // namespace reckon::ground_truth

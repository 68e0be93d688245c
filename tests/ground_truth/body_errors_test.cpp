#include "reckon/ground_truth/body_errors.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

namespace reckon::ground_truth {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180.0;

TEST(BodyErrors, TellTiltHeadingAndBodyVelocityApart) {
  // 3° of pitch about the body's own axis, then 20° of yaw, on a body that already heads west; the
  // body's velocity is believed 0.4 m/s too fast.
  TrackSample sample;
  sample.X_WB_true.R = AngleAxisd(2.0, Vector3d::UnitZ()).toRotationMatrix();
  sample.v_WB_true = sample.X_WB_true.R * Vector3d(1, 0, 0);
  sample.X_WB.R = AngleAxisd(20 * kDegree, Vector3d::UnitZ()) * sample.X_WB_true.R *
                  AngleAxisd(3 * kDegree, Vector3d::UnitY()).toRotationMatrix();
  sample.v_WB = sample.X_WB.R * Vector3d(1.4, 0, 0);
  const BodyErrors errors = BodyError(std::span(&sample, 1));
  ASSERT_EQ(errors.tilt_deg.size(), 1u);
  EXPECT_NEAR(errors.tilt_deg[0], 3.0, 1e-10);
  EXPECT_NEAR(errors.heading_deg[0], 20.0, 1e-10);
  EXPECT_NEAR(errors.velocity_m_s[0], 0.4, 1e-14);
}

TEST(BodyErrors, OfANegativeTurnAreOfItsSize) {
  TrackSample sample;
  sample.X_WB.R = AngleAxisd(-170 * kDegree, Vector3d::UnitZ()).toRotationMatrix();
  EXPECT_NEAR(BodyError(std::span(&sample, 1)).heading_deg[0], 170.0, 1e-10);
}

}  // namespace
}  // namespace reckon::ground_truth

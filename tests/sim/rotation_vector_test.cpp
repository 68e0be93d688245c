#include "reckon/sim/rotation_vector.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <unsupported/Eigen/MatrixFunctions>

namespace reckon::sim {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

const Vector3d kAxis = Vector3d(0.3, -0.7, 0.5).normalized();

Matrix3d Skew(const Vector3d& v) {
  Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// Angles on both sides of the switch between series and closed form (0.1 rad), and the extremes.
constexpr double kAngles[] = {0.0, 1e-12, 1e-6, 0.01, 0.0999999, 0.1, 0.1000001, 0.5, 2.0, 3.1};

TEST(RotationVector, ExpIsTheMatrixExponentialAndLogItsInverse) {
  for (const double angle : kAngles) {
    const Vector3d phi = angle * kAxis;
    const Matrix3d R = Skew(phi).exp();
    EXPECT_LT((RotationExp(phi) - R).norm(), 1e-14) << angle;
    EXPECT_LT((RotationLog(R) - phi).norm(), 1e-14 * (1.0 + angle)) << angle;
  }
}

// The upper right block of exp([K I; 0 0]) is Γ1.
TEST(RotationVector, Gamma1IsTheMeanRotation) {
  for (const double angle : kAngles) {
    const Vector3d phi = angle * kAxis;
    Eigen::Matrix<double, 6, 6> A = Eigen::Matrix<double, 6, 6>::Zero();
    A.topLeftCorner<3, 3>() = Skew(phi);
    A.topRightCorner<3, 3>().setIdentity();
    const Matrix3d expected = A.exp().topRightCorner<3, 3>();
    EXPECT_LT((Gamma1(phi) - expected).norm(), 2e-14) << angle;
    EXPECT_LT((Gamma1Inverse(phi) * expected - Matrix3d::Identity()).norm(), 2e-14) << angle;
  }
}

}  // namespace
}  // namespace reckon::sim

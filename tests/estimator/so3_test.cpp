#include "reckon/estimator/so3.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "estimator/draws.h"
#include "estimator/reference.h"

namespace reckon::estimator {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing_estimator::Draws;
using testing_estimator::Real;
using testing_estimator::Series;
using testing_estimator::Vec3;

double Distance(const Matrix3d& a, const testing_estimator::Mat3& b) {
  return static_cast<double>((a.cast<Real>() - b).cwiseAbs().maxCoeff());
}

/// Angles from nothing to nearly a full turn, on both sides of the switch at 0.5 rad.
constexpr double kAngles[] = {0.0,    1e-300, 1e-12, 1e-8, 1e-5, 1e-3,   0.0316, 0.0317, 0.1,
                              0.4999, 0.5001, 1.0,   2.0,  3.0,  3.1415, 3.2,    5.0,    6.2};

TEST(Gamma, IsItsPowerSeries) {
  Draws draws(1);
  for (const double angle : kAngles) {
    const Vector3d phi = angle * draws.Vector().normalized();
    for (int m = 0; m <= 3; ++m) {
      // A few ulp of entries of order one.
      EXPECT_LT(Distance(Gamma(m, phi), Series(m, phi.cast<Real>())), 4e-15)
          << "m = " << m << ", angle " << angle;
    }
  }
}

TEST(Gamma, IsContinuousWhereTheSeriesHandsOver) {
  Draws draws(2);
  for (int i = 0; i < 100; ++i) {
    const Vector3d axis = draws.Vector().normalized();
    for (int m = 0; m <= 3; ++m) {
      const Matrix3d below = Gamma(m, std::nextafter(0.5, 0.0) * axis);
      const Matrix3d above = Gamma(m, std::nextafter(0.5, 1.0) * axis);
      EXPECT_LT((below - above).cwiseAbs().maxCoeff(), 1e-14) << "m = " << m;
    }
    const Vector3d a = draws.Vector(10.0);
    for (int m = 1; m <= 2; ++m) {
      const Matrix3d below = RotationSeries(std::nextafter(0.5, 0.0) * axis).GammaDerivative(m, a);
      const Matrix3d above = RotationSeries(std::nextafter(0.5, 1.0) * axis).GammaDerivative(m, a);
      EXPECT_LT((below - above).cwiseAbs().maxCoeff(), 1e-12 * a.norm()) << "m = " << m;
    }
  }
}

TEST(Gamma, DerivativeIsTheNumericalOne) {
  Draws draws(3);
  for (const double angle : {1e-9, 1e-3, 0.3, 0.499, 0.501, 1.5, 3.0}) {
    const Vector3d phi = angle * draws.Vector().normalized();
    const Vector3d a = draws.Vector(10.0);
    for (int m = 1; m <= 2; ++m) {
      testing_estimator::Mat3 numerical;
      for (int i = 0; i < 3; ++i) {
        const Vec3 h = 1e-5L * Vec3::Unit(i);
        const Vec3 up = Series(m, phi.cast<Real>() + h) * a.cast<Real>();
        const Vec3 down = Series(m, phi.cast<Real>() - h) * a.cast<Real>();
        numerical.col(i) = (up - down) / 2e-5L;
      }
      // The differences' own error is h² ‖a‖ / 6.
      EXPECT_LT(Distance(RotationSeries(phi).GammaDerivative(m, a), numerical), 1e-10 * a.norm())
          << "m = " << m << ", angle " << angle;
    }
  }
}

TEST(So3, IsAGroup) {
  Draws draws(4);
  for (int i = 0; i < 200; ++i) {
    const Vector3d phi = draws.Vector(), psi = draws.Vector();
    const Matrix3d A = Exp(phi), B = Exp(psi);
    EXPECT_LT((A.transpose() * A - Matrix3d::Identity()).norm(), 2e-15);
    EXPECT_NEAR(A.determinant(), 1.0, 2e-15);
    EXPECT_LT((Exp(-phi) * A - Matrix3d::Identity()).norm(), 2e-15);
    // One axis: angles add.
    EXPECT_LT((Exp(0.3 * phi) * Exp(0.7 * phi) - A).norm(), 3e-15);
    // The adjoint: R Exp(ψ) Rᵀ = Exp(R ψ).
    EXPECT_LT((A * B * A.transpose() - Exp(A * psi)).norm(), 1e-14);
    EXPECT_LT((Exp(Log(A * B)) - A * B).norm(), 1e-14);
  }
}

TEST(So3, LogInvertsExp) {
  Draws draws(5);
  for (const double angle :
       {0.0, 1e-300, 1e-12, 1e-9, 2e-9, 1e-5, 0.1, 1.0, 3.0, 3.14, 3.1415926}) {
    for (int i = 0; i < 20; ++i) {
      const Vector3d phi = angle * draws.Vector().normalized();
      EXPECT_LT((Log(Exp(phi)) - phi).norm(), 2e-15 + 2e-15 * angle) << angle;
    }
  }
}

TEST(So3, LogOfHalfTurnsIsOneOfTheTwo) {
  constexpr double kPi = std::numbers::pi;
  for (const Vector3d& axis : {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1),
                               Vector3d(1, 1, 0), Vector3d(-1, 2, -3)}) {
    const Vector3d n = axis.normalized();
    const Matrix3d R = 2.0 * n * n.transpose() - Matrix3d::Identity();
    const Vector3d phi = Log(R);
    EXPECT_NEAR(phi.norm(), kPi, 1e-15);
    EXPECT_LT(phi.cross(n).norm(), 1e-14);
  }
}

TEST(So3, LeftJacobianMovesSumsIntoProducts) {
  Draws draws(6);
  for (int i = 0; i < 50; ++i) {
    const Vector3d phi = draws.Vector();
    const Vector3d delta = 1e-7 * draws.Vector().normalized();
    const Vector3d moved = Log(Exp(phi + delta) * Exp(phi).transpose());
    // Second order in δ: 1e-14; round-off of a rotation: 1e-15.
    EXPECT_LT((moved - LeftJacobian(phi) * delta).norm(), 3e-14);
  }
}

TEST(So3, LeftJacobianInverseIsTheInverse) {
  Draws draws(7);
  for (const double angle : kAngles) {
    const Vector3d phi = angle * draws.Vector().normalized();
    const Matrix3d product = LeftJacobianInverse(phi) * LeftJacobian(phi);
    // Towards a full turn the inverse grows without bound; its round-off with it.
    const double tolerance = 1e-14 * LeftJacobianInverse(phi).norm() * (angle > 6.0 ? 100.0 : 1.0);
    EXPECT_LT((product - Matrix3d::Identity()).norm(), tolerance) << angle;
  }
}

TEST(So3, SkewIsTheCrossProduct) {
  const Vector3d v(1, 2, 3), w(-4, 5, 6);
  EXPECT_EQ(Skew(v) * w, v.cross(w));
}

}  // namespace
}  // namespace reckon::estimator

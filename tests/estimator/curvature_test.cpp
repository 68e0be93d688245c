// What the second-order term of a height is worth: against samples of the error's own distribution,
// and for a filter that has lost its velocity.

#include <gtest/gtest.h>

#include <cmath>

#include "estimator/draws.h"
#include "estimator/reference.h"
#include "reckon/estimator/height_model.h"
#include "reckon/estimator/right_invariant_ekf.h"

namespace reckon::estimator {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing_estimator::Draws;
using testing_estimator::Vec15;
using testing_estimator::Widened;

/// A tilt of a few degrees and a position of some metres, correlated as gravity makes them: a body
/// whose velocity nobody measured.
ErrorCovariance Drifted(Draws& draws) {
  Eigen::Matrix<double, kErrorSize, 1> sigma;
  sigma << 0.05, 0.05, 0.1, 0.5, 0.5, 0.5, 3, 3, 1, 1e-3, 1e-3, 1e-3, 0.1, 0.1, 0.1;
  return draws.Covariance<kErrorSize>(sigma);
}

TEST(HeightCurvature, HasTheMeanSquareOfWhatLinearisingLeavesOut) {
  Draws draws(5);
  constexpr int kSamples = 30'000;
  for (int i = 0; i < 3; ++i) {
    NavigationState x = draws.State();
    x.p = draws.Vector(10.0);
    const ErrorCovariance P = Drifted(draws);
    RightInvariantEkf core;
    core.Start(x, P);
    const Vector3d r(0.2, -0.1, 0.3);
    const Vector3d q = x.p + x.R * r;
    const Linearisation<1> linear = LinearisedHeight(q.z(), 0.01, kPositionSlot, q);
    Linearisation<1> curved = linear;
    core.AddCurvature(r, 1.0, curved);

    // The remainder c of the height behind an error: true height = q_z + H ξ + c.
    const Eigen::Matrix<double, kErrorSize, kErrorSize> L = P.llt().matrixL();
    const auto hat = Widened(x);
    double square = 0.0;
    for (int k = 0; k < kSamples; ++k) {
      const Eigen::Matrix<double, kErrorSize, 1> e = L * draws.Normals<kErrorSize>();
      const auto truth = testing_estimator::TruthBehind(ErrorForm::kRightInvariant, hat,
                                                        Vec15(e.cast<testing_estimator::Real>()));
      const auto height = (truth.p + truth.R * r.cast<testing_estimator::Real>()).z();
      const double first = e[1] * q.x() - e[0] * q.y() - e[8];  // −(θ × q)_z − ξ_z
      const double c = static_cast<double>(height) - q.z() - first;
      square += c * c;
    }
    // Terms of third order are left out: some 5 % of the second at these angles. The samples leave
    // 2 % of the mean square.
    square /= kSamples;
    EXPECT_NEAR(curved.N(0) - linear.N(0), square, 0.1 * square);
    EXPECT_EQ(curved.z, linear.z);
    EXPECT_EQ(curved.lasting, 0.0);

    Linearisation<1> lasting = linear;
    core.AddCurvature(r, 200.0, lasting);
    EXPECT_EQ(lasting.N, curved.N);
    EXPECT_NEAR(lasting.lasting, 199.0 * (curved.N(0) - linear.N(0)), 1e-12 * lasting.lasting);
  }
}

TEST(HeightCurvature, LeavesACertainTiltBe) {
  Draws draws(6);
  NavigationState x = draws.State();
  Eigen::Matrix<double, kErrorSize, 1> sigma = Eigen::Matrix<double, kErrorSize, 1>::Constant(1e-4);
  RightInvariantEkf core;
  core.Start(x, draws.Covariance<kErrorSize>(sigma));
  const Linearisation<1> linear = LinearisedHeight(1.0, 0.01, kPositionSlot, x.p);
  Linearisation<1> curved = linear;
  core.AddCurvature(Vector3d::Zero(), 200.0, curved);
  EXPECT_EQ(curved.z, linear.z);
  EXPECT_EQ(curved.N, linear.N);
}

}  // namespace
}  // namespace reckon::estimator

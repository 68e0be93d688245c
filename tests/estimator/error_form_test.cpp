#include "reckon/estimator/error_form.h"

#include <gtest/gtest.h>

#include "estimator/draws.h"
#include "estimator/reference.h"

namespace reckon::estimator {
namespace {

using testing_estimator::Draws;
using testing_estimator::Real;
using testing_estimator::Vec15;
using testing_estimator::Widened;

constexpr ErrorForm kForms[] = {ErrorForm::kRightInvariant, ErrorForm::kLeftInvariant,
                                ErrorForm::kMultiplicative};

TEST(ErrorForm, MapsAreTheNumericalOnes) {
  Draws draws(41);
  for (const ErrorForm from : kForms) {
    for (const ErrorForm to : kForms) {
      const NavigationState x = draws.State();
      const auto hat = Widened(x);
      const auto expected = testing_estimator::Differences<15>([&](const Vec15& e) -> Vec15 {
        return testing_estimator::Error(to, hat, testing_estimator::TruthBehind(from, hat, e));
      });
      const ErrorCovariance T = FormMap(from, to, x);
      // Positions of some 50 m times the differences' 1e-14.
      EXPECT_LT(static_cast<double>((T.cast<Real>() - expected).cwiseAbs().maxCoeff()), 1e-11);
    }
  }
}

TEST(ErrorForm, ThereAndBackIsTheIdentity) {
  Draws draws(42);
  const NavigationState x = draws.State();
  const ErrorCovariance P = draws.Covariance<15>(testing_estimator::UsualSigma());
  for (const ErrorForm from : kForms) {
    for (const ErrorForm to : kForms) {
      const ErrorCovariance there = ConvertForm(P, from, to, x);
      const ErrorCovariance back = ConvertForm(there, to, from, x);
      EXPECT_LT(testing_estimator::WorstCorrelationError(back, P), 1e-11);
    }
  }
}

TEST(ErrorForm, ErrorBetweenIsTheDefinitionForErrorsOfAnySize) {
  Draws draws(43);
  for (const ErrorForm form : kForms) {
    for (const double size : {1e-9, 1e-3, 1.0, 3.0}) {
      const NavigationState x = draws.State();
      Vec15 e = draws.Normals<15>().cast<Real>();
      e.segment<3>(kTheta) *= size / static_cast<double>(e.segment<3>(kTheta).norm());
      const auto wide = testing_estimator::Erring(form, Widened(x), e);
      NavigationState hat;
      hat.R = wide.R.cast<double>();
      hat.v = wide.v.cast<double>();
      hat.p = wide.p.cast<double>();
      hat.gyro_bias = wide.bg.cast<double>();
      hat.accel_bias = wide.ba.cast<double>();
      EXPECT_LT(static_cast<double>((ErrorBetween(form, hat, x).cast<Real>() - e).norm()), 1e-12)
          << size;
    }
  }
}

TEST(ErrorForm, TheAdjointCarriesInvariantErrorsOfAnySize) {
  Draws draws(44);
  const NavigationState x = draws.State(), hat = draws.State();
  const ErrorVector right = ErrorBetween(ErrorForm::kRightInvariant, hat, x);
  const ErrorVector left = ErrorBetween(ErrorForm::kLeftInvariant, hat, x);
  const auto T = FormMap(ErrorForm::kRightInvariant, ErrorForm::kLeftInvariant, hat);
  EXPECT_LT((T * right - left).norm(), 1e-12 * right.norm() * T.norm());
  const auto M = FormMap(ErrorForm::kRightInvariant, ErrorForm::kMultiplicative, hat);
  const ErrorVector multiplicative = ErrorBetween(ErrorForm::kMultiplicative, hat, x);
  EXPECT_GT((M * right - multiplicative).norm(), 1e-3) << "true of small errors alone";
}

}  // namespace
}  // namespace reckon::estimator

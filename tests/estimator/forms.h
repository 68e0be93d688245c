#pragma once

#include <array>
#include <memory>
#include <string>

#include "estimator/robot.h"
#include "reckon/estimator/left_invariant_ekf.h"
#include "reckon/estimator/multiplicative_ekf.h"
#include "reckon/estimator/right_invariant_ekf.h"

namespace reckon::testing_estimator {

using estimator::ErrorForm;

/// Every error form that a filter can have.
inline constexpr std::array<ErrorForm, 3> kForms{
    ErrorForm::kRightInvariant, ErrorForm::kLeftInvariant, ErrorForm::kMultiplicative};

inline std::string NameOf(ErrorForm form) {
  if (form == ErrorForm::kRightInvariant) return "right";
  return form == ErrorForm::kLeftInvariant ? "left" : "multiplicative";
}

/// The registry's filter of this error form.
inline std::unique_ptr<estimator::Estimator> MakeOf(ErrorForm form, estimator::Setup setup,
                                                    const estimator::Prior& prior) {
  setup.error = form;
  return Make(form == ErrorForm::kMultiplicative ? "mekf" : "inekf", setup, prior);
}

}  // namespace reckon::testing_estimator

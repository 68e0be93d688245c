#pragma once

#include <Eigen/Core>
#include <cmath>

#include "reckon/estimator/error_form.h"
#include "reckon/estimator/gate.h"
#include "reckon/estimator/kalman.h"
#include "reckon/estimator/report.h"

namespace reckon::estimator {

/// What a correction looks like before a gate judges it. Innovations of velocities, contacts and
/// rates are shown in the body's axes, where a reader expects them.
template <int kRows>
Correction Described(const KalmanCorrection<kRows>& kalman, const Linearisation<kRows>& m,
                     const Eigen::Matrix3d& R) {
  Correction correction;
  correction.rows = kRows;
  correction.nis = kalman.nis();
  if constexpr (kRows == 3) {
    correction.innovation = R.transpose() * m.z;
    correction.covariance = R.transpose() * kalman.S() * R;
  } else {
    correction.innovation[0] = m.z(0);
    correction.covariance(0, 0) = kalman.S()(0);
  }
  return correction;
}

/// Decides what becomes of a correction that sees `slots`. A velocity or a vector between points
/// turns with the error (NisWithCurvature); what sees the orientation itself does not.
template <class Core>
void Judge(const InnovationGate& gate, const Core& core, SlotSet slots, Correction& correction) {
  if (!std::isfinite(correction.nis)) {
    correction.decision = Decision::kRefused;
    correction.reason = Refusal::kNotFinite;
    return;
  }
  correction.decision = gate.Judge(correction.rows, correction.nis);
  const bool turns = correction.rows == 3 && !slots.Has(kThetaSlot) &&
                     (slots.Has(kVelocitySlot) || slots.Has(kPositionSlot));
  if (!turns || correction.decision == Decision::kAccepted) return;
  Eigen::Matrix3d P = ToEigen(core.P()(kThetaSlot, kThetaSlot));
  const Eigen::Matrix3d& R = core.x().R;
  if (Core::kForm == ErrorForm::kRightInvariant) P = (R.transpose() * P * R).eval();
  correction.decision = gate.Judge(3, NisWithCurvature(correction, P));
}

}  // namespace reckon::estimator

#pragma once

#include <array>

#include "reckon/estimator/report.h"
#include "reckon/estimator/setup.h"

namespace reckon::estimator {

/// The x with P(χ²_dof ≤ x) = probability, for 1 to 3 degrees of freedom and 0 < probability < 1.
/// Throws std::invalid_argument otherwise.
double ChiSquareQuantile(int dof, double probability);

/// NIS of a correction of three rows by a vector that turns with the error: z = −J(θ) ξ + n in the
/// right-invariant form, J = Γ1, where a filter has −ξ + n. What is left out to second order, ½ θ ×
/// z, is counted as noise: S + ¼ [z]× P_θ [z]×ᵀ. `P_theta` is the orientation's covariance in the
/// axes of the innovation. Does not allocate.
double NisWithCurvature(const Correction& correction, const Eigen::Matrix3d& P_theta);

/// Judges corrections by their normalised innovation squared.
class InnovationGate {
 public:
  explicit InnovationGate(const Gate& gate);

  /// NIS beyond which a correction of `rows` rows is not believed.
  double Limit(int rows) const { return limits_[static_cast<std::size_t>(rows)]; }

  Decision Judge(int rows, double nis) const;

 private:
  GateAction action_;
  std::array<double, kMaxRows + 1> limits_{};
};

}  // namespace reckon::estimator

#include "reckon/estimator/gate.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <Eigen/Cholesky>

#include "reckon/estimator/so3.h"

namespace reckon::estimator {
namespace {

/// P(χ²_dof ≤ x) in closed form.
double ChiSquareCdf(int dof, double x) {
  if (dof == 2) return -std::expm1(-0.5 * x);
  const double normal = std::erf(std::sqrt(0.5 * x));
  if (dof == 1) return normal;
  return normal - std::sqrt(2.0 * x / std::numbers::pi) * std::exp(-0.5 * x);
}

}  // namespace

double ChiSquareQuantile(int dof, double probability) {
  if (dof < 1 || dof > 3) throw std::invalid_argument("χ² quantile: 1 to 3 degrees of freedom");
  if (!(probability > 0.0 && probability < 1.0)) {
    throw std::invalid_argument("χ² quantile: the probability must lie between 0 and 1");
  }
  double low = 0.0;
  double high = 1.0;
  while (ChiSquareCdf(dof, high) < probability && high < 1e3) high *= 2.0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (ChiSquareCdf(dof, middle) < probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double NisWithCurvature(const Correction& correction, const Eigen::Matrix3d& P_theta) {
  const Eigen::Vector3d& z = correction.innovation;
  const Eigen::Matrix3d S = correction.covariance + 0.25 * Skew(z) * P_theta * Skew(z).transpose();
  return z.dot(S.ldlt().solve(z));
}

InnovationGate::InnovationGate(const Gate& gate) : action_(gate.action) {
  for (int rows = 1; rows <= kMaxRows; ++rows) {
    limits_[static_cast<std::size_t>(rows)] = ChiSquareQuantile(rows, gate.probability);
  }
}

Decision InnovationGate::Judge(int rows, double nis) const {
  if (action_ == GateAction::kOff || nis <= Limit(rows)) return Decision::kAccepted;
  switch (action_) {
    case GateAction::kWarn:
      return Decision::kWarned;
    case GateAction::kInflate:
      return Decision::kInflated;
    default:
      return Decision::kRejected;
  }
}

}  // namespace reckon::estimator

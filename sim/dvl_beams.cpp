#include "reckon/sim/dvl_beams.h"

#include <cassert>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <Eigen/LU>

namespace reckon::sim {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Below this determinant of UᵀU a direction is as good as unseen.
constexpr double kLeastDeterminant = 1e-6;

}  // namespace

DvlBeams::DvlBeams(const std::string& name, double angle_deg,
                   const std::vector<double>& azimuths_deg) {
  if (!(angle_deg > 0.0 && angle_deg < 90.0)) {
    throw std::invalid_argument(name + ": beam_angle_deg must lie between 0 and 90, without them");
  }
  if (azimuths_deg.size() < 3 || azimuths_deg.size() > kMost) {
    throw std::invalid_argument(name + ": azimuths_deg must be 3 to 8 beams");
  }
  const double angle = angle_deg * std::numbers::pi / 180;
  Matrix3d seen = Matrix3d::Zero();
  for (const double azimuth_deg : azimuths_deg) {
    const double azimuth = azimuth_deg * std::numbers::pi / 180;
    directions_.emplace_back(std::sin(angle) * std::cos(azimuth),
                             std::sin(angle) * std::sin(azimuth), -std::cos(angle));
    seen += directions_.back() * directions_.back().transpose();
  }
  if (!(seen.determinant() > kLeastDeterminant)) {
    throw std::invalid_argument(name + ": azimuths_deg leave a direction that no beam sees");
  }
}

std::optional<BeamSolution> DvlBeams::Solve(std::span<const std::optional<double>> along_beam_m_s,
                                            double sigma_m_s) const {
  assert(along_beam_m_s.size() == directions_.size());
  Matrix3d seen = Matrix3d::Zero();
  Vector3d sum = Vector3d::Zero();
  BeamSolution solution;
  for (std::size_t i = 0; i < directions_.size(); ++i) {
    if (!along_beam_m_s[i]) continue;
    seen += directions_[i] * directions_[i].transpose();
    sum += directions_[i] * *along_beam_m_s[i];
    ++solution.beams;
  }
  if (solution.beams < 3 || !(seen.determinant() > kLeastDeterminant)) return std::nullopt;
  const Matrix3d inverse = seen.inverse();
  solution.velocity_m_s = inverse * sum;
  solution.covariance_m2_s2 = sigma_m_s * sigma_m_s * 0.5 * (inverse + inverse.transpose());
  double square = 0.0;
  for (std::size_t i = 0; i < directions_.size(); ++i) {
    if (!along_beam_m_s[i]) continue;
    square += std::pow(*along_beam_m_s[i] - directions_[i].dot(solution.velocity_m_s), 2);
  }
  if (solution.beams > 3) solution.disagreement_m_s = std::sqrt(square / (solution.beams - 3));
  return solution;
}

}  // namespace reckon::sim

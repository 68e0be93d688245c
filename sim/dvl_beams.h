#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace reckon::sim {

/// What a Doppler log makes of its beams: a velocity in its axes with a covariance, and how well
/// the beams agree.
struct BeamSolution {
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_m2_s2 = Eigen::Matrix3d::Zero();
  int beams = 0;
  /// Figure of merit [m/s]: the RMS of what the beams say beyond the velocity, for each number too
  /// many; zero for three beams, which cannot disagree.
  double disagreement_m_s = 0.0;
};

/// The beams of a Doppler velocity log, fixed in its frame S, whose z points up: beam i looks down
/// at θ from −z with azimuth α_i about z,
///     u_i = (sin θ cos α_i, sin θ sin α_i, −cos θ),
/// and measures u_i · v. Nothing but the constructor allocates.
class DvlBeams {
 public:
  static constexpr std::size_t kMost = 8;

  /// Throws std::invalid_argument, which begins with `name`: an angle outside (0°, 90°), at which
  /// the beams say nothing of some direction; fewer than 3 beams or more than kMost; azimuths that
  /// leave a direction unseen.
  DvlBeams(const std::string& name, double angle_deg, const std::vector<double>& azimuths_deg);

  std::span<const Eigen::Vector3d> directions() const& { return directions_; }
  std::span<const Eigen::Vector3d> directions() && = delete;

  /// v = (UᵀU)⁻¹ Uᵀ y over the beams that have a value, and σ² (UᵀU)⁻¹ for beams of deviation
  /// `sigma_m_s`; nothing for fewer than three beams or where those leave a direction unseen.
  std::optional<BeamSolution> Solve(std::span<const std::optional<double>> along_beam_m_s,
                                    double sigma_m_s) const;

 private:
  std::vector<Eigen::Vector3d> directions_;
};

}  // namespace reckon::sim

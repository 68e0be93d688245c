#pragma once

#include <Eigen/Core>
#include <array>

#include "reckon/models/contact_sample.h"

namespace reckon::sim {

/// The ground as a blind robot knows it: a plane through the points where its feet stood last.
///
/// Slopes are those of least squares over the points about the robot, low-passed with 0.15 s; the
/// height under the robot is low-passed with 0.05 s.
class SupportPlane {
 public:
  using Points = std::array<Eigen::Vector3d, models::kMaxFeet>;  ///< in W

  explicit SupportPlane(int feet) : feet_(feet) {}

  /// Starts on what the feet stand on.
  void Start(const Points& feet, const Eigen::Vector2d& p);

  /// One tick: the feet's bottoms as they are known, and where the robot is. Does not allocate.
  void Update(const Points& feet, const Eigen::Vector2d& p, double dt_s);

  /// z in W of the plane at a point, and under the robot.
  double HeightAt(const Eigen::Vector2d& q) const { return height_ + slope_.dot(q - p_); }
  double height() const { return height_; }

  /// ∂z/∂x and ∂z/∂y in W, and the normal.
  const Eigen::Vector2d& slope() const { return slope_; }
  Eigen::Vector3d normal() const {
    return Eigen::Vector3d(-slope_.x(), -slope_.y(), 1.0).normalized();
  }

 private:
  struct Fit {
    Eigen::Vector2d slope;
    double height;
  };
  Fit FitTo(const Points& feet, const Eigen::Vector2d& p) const;

  int feet_;
  Eigen::Vector2d slope_ = Eigen::Vector2d::Zero(), p_ = Eigen::Vector2d::Zero();
  double height_ = 0.0;
};

}  // namespace reckon::sim

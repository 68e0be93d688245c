#pragma once

#include <Eigen/Core>
#include <array>

#include "reckon/models/contact_sample.h"

namespace reckon::sim {

using Wrench = Eigen::Matrix<double, 6, 1>;  ///< force, then moment

/// The forces that standing feet press with, so that together they make a wrench.
///
/// With r_i from the centre of mass to foot i's bottom, it minimises
///     |Σ (f_i, r_i × f_i) − b|²_S + ε |f|² + ε |f − f_before|²
/// over f_i = f0 l_i n + Σ_k g_k λ_ik with the four edges g_k = n ± μ/√2 t1 ± μ/√2 t2 of a pyramid
/// inside the friction cone and 0 ≤ λ ≤ f_most l_i / 2: a box, solved by projected coordinate
/// descent from the last solution. A foot's load l_i, 0 to 1, fades it in and out.
class ForceDistribution {
 public:
  struct Foot {
    bool stands = false;
    double load = 1.0;
    Eigen::Vector3d r = Eigen::Vector3d::Zero();  ///< from the centre of mass
  };
  using Feet = std::array<Foot, models::kMaxFeet>;
  using Forces = std::array<Eigen::Vector3d, models::kMaxFeet>;

  /// `weight_n` of the robot, which all forces are measured by, and the height of its body
  /// [m], by which moments are.
  ForceDistribution(int feet, double weight_n, double height_m);

  /// In the axes of `wrench` (force, then moment about the centre of mass); zero for feet that do
  /// not stand. Does not allocate.
  const Forces& Update(const Feet& feet, const Wrench& wrench, const Eigen::Vector3d& normal,
                       double friction);

 private:
  static constexpr int kEdges = 4, kMost = kEdges * models::kMaxFeet;
  using Vector = Eigen::Matrix<double, kMost, 1>;
  using Edges = Eigen::Matrix<double, 3, kEdges>;

  static Edges EdgesOf(const Eigen::Vector3d& normal, double friction);
  void Descend(const Eigen::Matrix<double, kMost, kMost>& H, const Vector& g, const Vector& upper);

  int feet_;
  double least_n_, most_n_;
  Wrench weight_;  ///< S
  Vector lambda_ = Vector::Zero();
  Forces forces_;
};

}  // namespace reckon::sim

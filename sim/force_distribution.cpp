#include "reckon/sim/force_distribution.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace reckon::sim {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kSmallForces = 2e-3, kSmallChanges = 2e-3;
constexpr int kSweeps = 80;
constexpr double kLeastShare = 0.034, kMostShare = 1.8;  // of the weight: of a foot that stands
constexpr double kConverged = 1e-9;                      // of the weight
/// Weights of the force's and the moment's rows for a body 0.29 m high. Two point feet make a
/// wrench of rank five: where it must fail, it fails level, and footholds repair the velocity.
constexpr double kForceWeights[] = {1.0, 1.0, 4.0}, kMomentWeights[] = {40.0, 40.0, 15.0};
constexpr double kHeightOfWeights = 0.29;

Matrix3d Cross(const Vector3d& r) {
  Matrix3d C;
  C << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0;
  return C;
}

}  // namespace

ForceDistribution::ForceDistribution(int feet, double weight_n, double height_m)
    : feet_(feet), least_n_(kLeastShare * weight_n), most_n_(kMostShare * weight_n) {
  const double scale = kHeightOfWeights / height_m;
  for (int i = 0; i < 3; ++i) {
    weight_[i] = kForceWeights[i];
    weight_[3 + i] = kMomentWeights[i] * scale * scale;
  }
  forces_.fill(Vector3d::Zero());
}

ForceDistribution::Edges ForceDistribution::EdgesOf(const Vector3d& normal, double friction) {
  const Vector3d t1 = (Vector3d::UnitX() - normal.x() * normal).normalized();
  const Vector3d t2 = normal.cross(t1);
  const double edge = friction / std::numbers::sqrt2;
  Edges edges;
  for (int k = 0; k < kEdges; ++k) {
    edges.col(k) = normal + (k & 1 ? edge : -edge) * t1 + (k & 2 ? edge : -edge) * t2;
  }
  return edges;
}

const ForceDistribution::Forces& ForceDistribution::Update(const Feet& feet, const Wrench& wrench,
                                                           const Vector3d& normal,
                                                           double friction) {
  const Edges G = EdgesOf(normal, friction);
  Eigen::Matrix<double, 6, kMost> B = Eigen::Matrix<double, 6, kMost>::Zero();  // wrench of λ
  Vector upper = Vector::Zero(), target = Vector::Zero();
  Wrench missing = wrench;
  const Eigen::Matrix<double, kEdges, kEdges> GtG = G.transpose() * G;
  for (int i = 0; i < feet_; ++i) {
    const Foot& foot = feet[i];
    if (!foot.stands) {
      lambda_.segment<kEdges>(kEdges * i).setZero();
      continue;
    }
    const Vector3d base = least_n_ * foot.load * normal;
    missing.head<3>() -= base;
    missing.tail<3>() -= foot.r.cross(base);
    B.block<3, kEdges>(0, kEdges * i) = G;
    B.block<3, kEdges>(3, kEdges * i) = Cross(foot.r) * G;
    upper.segment<kEdges>(kEdges * i).setConstant(0.5 * most_n_ * foot.load);
    target.segment<kEdges>(kEdges * i) =
        G.transpose() * (kSmallChanges * forces_[i] - (kSmallForces + kSmallChanges) * base);
  }
  Eigen::Matrix<double, kMost, kMost> H = B.transpose() * weight_.asDiagonal() * B;
  for (int i = 0; i < feet_; ++i) {
    H.block<kEdges, kEdges>(kEdges * i, kEdges * i) += (kSmallForces + kSmallChanges) * GtG;
  }
  Descend(H, B.transpose() * weight_.cwiseProduct(missing) + target, upper);
  for (int i = 0; i < feet_; ++i) {
    forces_[i].setZero();
    if (!feet[i].stands) continue;
    forces_[i] = least_n_ * feet[i].load * normal + G * lambda_.segment<kEdges>(kEdges * i);
  }
  return forces_;
}

/// Minimises ½ λᵀHλ − gᵀλ over the box.
void ForceDistribution::Descend(const Eigen::Matrix<double, kMost, kMost>& H, const Vector& g,
                                const Vector& upper) {
  const int size = kEdges * feet_;
  lambda_ = lambda_.cwiseMin(upper);
  Vector left = g - H * lambda_;
  const double converged = kConverged * most_n_;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    double moved = 0.0;
    for (int k = 0; k < size; ++k) {
      if (upper[k] <= 0.0) continue;
      const double next = std::clamp(lambda_[k] + left[k] / H(k, k), 0.0, upper[k]);
      const double step = next - lambda_[k];
      if (step == 0.0) continue;
      lambda_[k] = next;
      left -= step * H.col(k);
      moved = std::max(moved, std::abs(step));
    }
    if (moved < converged) return;
  }
}

}  // namespace reckon::sim

#include "reckon/ground_truth/alignment.h"

#include <Eigen/Geometry>
#include <cmath>

namespace reckon::ground_truth {
namespace {

Eigen::Matrix3d Rz(double yaw) {
  return Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

Similarity Umeyama(std::span<const TrackSample> samples, bool with_scale) {
  const auto n = static_cast<Eigen::Index>(samples.size());
  Eigen::Matrix3Xd estimate(3, n), truth(3, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    estimate.col(i) = samples[static_cast<std::size_t>(i)].X_WB.p;
    truth.col(i) = samples[static_cast<std::size_t>(i)].X_WB_true.p;
  }
  if (!estimate.allFinite() || !truth.allFinite()) return {};
  const Eigen::Matrix4d T = Eigen::umeyama(estimate, truth, with_scale);
  const double scale = with_scale ? std::cbrt(T.topLeftCorner<3, 3>().determinant()) : 1.0;
  return {scale, {T.topLeftCorner<3, 3>() / scale, T.topRightCorner<3, 1>()}};
}

/// With a, b the centred estimate and truth, the best yaw is that of Σ (a·b, a×b) in the plane.
Similarity YawPosition(std::span<const TrackSample> samples) {
  Eigen::Vector3d mean_estimate = Eigen::Vector3d::Zero(), mean_truth = Eigen::Vector3d::Zero();
  for (const TrackSample& sample : samples) {
    mean_estimate += sample.X_WB.p;
    mean_truth += sample.X_WB_true.p;
  }
  mean_estimate /= static_cast<double>(samples.size());
  mean_truth /= static_cast<double>(samples.size());
  double cosine = 0.0, sine = 0.0;
  for (const TrackSample& sample : samples) {
    const Eigen::Vector3d a = sample.X_WB.p - mean_estimate, b = sample.X_WB_true.p - mean_truth;
    cosine += a.x() * b.x() + a.y() * b.y();
    sine += a.x() * b.y() - a.y() * b.x();
  }
  const Eigen::Matrix3d R = Rz(std::atan2(sine, cosine));
  return {1.0, {R, mean_truth - R * mean_estimate}};
}

/// The yaw ψ for which Rz(ψ) R̂ is nearest to R.
Similarity FirstYawPosition(const TrackSample& first) {
  const Eigen::Matrix3d E = first.X_WB_true.R * first.X_WB.R.transpose();
  const Eigen::Matrix3d R = Rz(std::atan2(E(1, 0) - E(0, 1), E(0, 0) + E(1, 1)));
  return {1.0, {R, first.X_WB_true.p - R * first.X_WB.p}};
}

}  // namespace

Similarity Align(Alignment alignment, std::span<const TrackSample> samples) {
  if (samples.empty()) return {};
  const TrackSample& first = samples.front();
  switch (alignment) {
    case Alignment::kNone:
      return {};
    case Alignment::kFirstPose:
      return {1.0, first.X_WB_true * first.X_WB.Inverse()};
    case Alignment::kYawPosition:
      return YawPosition(samples);
    case Alignment::kSe3:
      return Umeyama(samples, false);
    case Alignment::kSim3:
      return Umeyama(samples, true);
    case Alignment::kFirstYawPosition:
      return FirstYawPosition(first);
  }
  return {};
}

}  // namespace reckon::ground_truth

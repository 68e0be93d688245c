#include "reckon/sim/route.h"

#include <algorithm>
#include <cassert>

namespace reckon::sim {

using Eigen::Vector3d;

Route::Route(const std::vector<Vector3d>& points) {
  assert(!points.empty());
  for (const Vector3d& point : points) {
    if (points_.empty()) {
      reached_.push_back(0.0);
    } else {
      const double piece = (point - points_.back()).norm();
      if (piece < 1e-9) continue;
      reached_.push_back(reached_.back() + piece);
    }
    points_.push_back(point);
  }
}

/// Index of the piece's first point.
std::size_t Route::PieceAt(double s) const {
  const auto after = std::upper_bound(reached_.begin() + 1, reached_.end() - 1, s);
  return static_cast<std::size_t>(after - reached_.begin()) - 1;
}

Vector3d Route::At(double s) const {
  if (points_.size() == 1) return points_.front();
  const std::size_t i = PieceAt(s);
  const double along = std::clamp(s, 0.0, length()) - reached_[i];
  return points_[i] + along / (reached_[i + 1] - reached_[i]) * (points_[i + 1] - points_[i]);
}

Vector3d Route::Direction(double s) const {
  if (points_.size() == 1) return Vector3d::Zero();
  const std::size_t i = PieceAt(s);
  return (points_[i + 1] - points_[i]).normalized();
}

double Route::Nearest(const Vector3d& p, double s, double window) const {
  const double end = std::min(s + window, length());
  double best_s = s, best = (At(s) - p).squaredNorm();
  if (points_.size() == 1) return best_s;
  for (std::size_t i = PieceAt(s); i + 1 < points_.size() && reached_[i] <= end; ++i) {
    const Vector3d piece = points_[i + 1] - points_[i];
    const double foot = reached_[i] + (p - points_[i]).dot(piece) / piece.norm();
    const double least = std::max(s, reached_[i]), most = std::min(end, reached_[i + 1]);
    if (least > most) continue;
    const double at = std::clamp(foot, least, most);
    const double distance = (At(at) - p).squaredNorm();
    if (distance >= best) continue;
    best = distance;
    best_s = at;
  }
  return best_s;
}

}  // namespace reckon::sim

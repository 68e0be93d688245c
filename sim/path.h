#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

namespace reckon::sim {

/// A curve in the plane by arc length s, made of straight lines and circular arcs, from the origin
/// of the world. A closed path goes on round; an open one goes on straight beyond its end.
class Path {
 public:
  struct Point {
    Eigen::Vector2d p = Eigen::Vector2d::Zero();
    double heading_rad = 0.0;
  };

  /// Corners (0, 0), (a, 0), (a, a), (0, a): counter-clockwise, or mirrored in y.
  static Path Square(double side_m, bool clockwise);
  /// Starts along +x, the centre on the left, or on the right if clockwise.
  static Path Circle(double radius_m, bool clockwise);
  /// Two circles that touch at the origin: the left one first, or the right one if clockwise.
  static Path FigureEight(double radius_m, bool clockwise);
  /// Straight lines from the origin through the points; equal neighbours are skipped.
  static Path Waypoints(const std::vector<std::array<double, 2>>& points);

  bool closed() const { return closed_; }
  double length() const { return length_; }  ///< of one lap

  /// The point at arc length s ≥ 0. Does not allocate.
  Point At(double s) const;

 private:
  struct Segment {
    Point start;
    double length = 0.0, curvature = 0.0;
  };

  explicit Path(bool closed) : closed_(closed) {}
  void AddLine(const Point& start, double length) { Add({start, length, 0.0}); }
  void Add(const Segment& segment);
  static Point Along(const Segment& segment, double s);

  std::vector<Segment> segments_;
  double length_ = 0.0;
  bool closed_ = false;
};

}  // namespace reckon::sim

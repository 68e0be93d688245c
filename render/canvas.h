#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

typedef struct mjModel_ mjModel;  // NOLINT(modernize-use-using): MuJoCo's own declarations
typedef struct mjData_ mjData;    // NOLINT(modernize-use-using)

namespace reckon::render {

/// Where the camera is and what it looks at, in W.
struct View {
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
  double distance_m = 3.0;
  double azimuth_deg = 45.0;     ///< of the direction in which it looks, from x towards y
  double elevation_deg = -20.0;  ///< negative: it looks down
};

/// A straight line in the picture.
struct Line {
  Eigen::Vector3d from, to;
  Eigen::Vector4f colour = {1, 1, 1, 1};
  double width_m = 0.01;
};

/// One picture, 8-bit RGB, rows from top to bottom.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

/// What is between the camera and what it sees.
enum class Medium { kAir, kWater };

/// Draws the geoms of a MuJoCo model off screen. A context of OpenGL must be current.
class Canvas {
 public:
  /// Throws std::runtime_error if there is nothing to draw into.
  Canvas(const mjModel& model, Medium medium, int width, int height);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  /// The scene of `data`, whose kinematics are up to date, and `lines`.
  Picture Draw(const mjData& data, const View& view, std::span<const Line> lines);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Writes a picture as a binary portable pixmap. Throws std::runtime_error.
void WritePpm(const Picture& picture, const std::string& path);

}  // namespace reckon::render

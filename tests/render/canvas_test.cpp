#include "reckon/render/canvas.h"

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "reckon/render/gl_context.h"
#include "reckon/sim/world.h"
#include "sim/bluerov2.h"

// The driver keeps memory of its own, and its library is unloaded before leaks are looked for:
// which are its own can't be told any more. All other checks of the sanitizers hold.
extern "C" int __lsan_is_turned_off() { return 1; }  // NOLINT(bugprone-reserved-identifier)

namespace reckon::render {
namespace {

using Eigen::Vector3d;

constexpr int kWidth = 320, kHeight = 240;

struct Rgb {
  int r = 0, g = 0, b = 0;
};

Rgb At(const Picture& picture, int x, int y) {
  const std::uint8_t* pixel = picture.rgb.data() + 3 * (y * picture.width + x);
  return {pixel[0], pixel[1], pixel[2]};
}

bool IsGreen(const Rgb& c) { return c.g > c.r + 40 && c.g > c.b + 40; }

/// Where a point is in the picture [pixels]: a pinhole with MuJoCo's vertical field of 45°.
Eigen::Vector2d Projected(const View& view, const Vector3d& point) {
  const double azimuth = view.azimuth_deg * std::numbers::pi / 180;
  const double elevation = view.elevation_deg * std::numbers::pi / 180;
  const Vector3d forward(std::cos(elevation) * std::cos(azimuth),
                         std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
  const Vector3d right = forward.cross(Vector3d::UnitZ()).normalized();
  const Vector3d from = view.target - view.distance_m * forward, d = point - from;
  const double scale = 0.5 * kHeight / std::tan(std::numbers::pi / 8) / d.dot(forward);
  return {0.5 * kWidth + scale * d.dot(right), 0.5 * kHeight - scale * d.dot(right.cross(forward))};
}

class CanvasTest : public ::testing::Test {
 protected:
  void SetUp() override {
    try {
      context_ = GlContext::Make("auto", kWidth, kHeight);
    } catch (const std::runtime_error& error) {
      GTEST_SKIP() << error.what();
    }
  }

  static sim::World MakeWorld() {
    sim::WorldConfig config = sim::Sea();
    config.mission.start_depth_m = config.mission.depth_m = 8.0;
    sim::World world(sim::BlueRov2(), config, 1);
    world.Advance();
    return world;
  }

  std::unique_ptr<GlContext> context_;
};

TEST_F(CanvasTest, DrawsLinesWhereProjectionSaysTheyAre) {
  const sim::World world = MakeWorld();
  Canvas canvas(world.physics_model(), Medium::kWater, kWidth, kHeight);
  const Vector3d p = world.motion().X_WB.p;
  const Line line{p + Vector3d(0, 0, 0.3), p + Vector3d(0, 0, 0.9), {0, 1, 0, 1}, 0.02};
  for (const double azimuth : {30.0, 200.0}) {
    const View view{.target = p, .distance_m = 4.0, .azimuth_deg = azimuth, .elevation_deg = -20};
    const Picture picture = canvas.Draw(world.physics_data(), view, {&line, 1});
    ASSERT_EQ(picture.rgb.size(), 3U * kWidth * kHeight);
    double x = 0.0, y = 0.0, count = 0.0;
    for (int row = 0; row < kHeight; ++row) {
      for (int column = 0; column < kWidth; ++column) {
        if (!IsGreen(At(picture, column, row))) continue;
        x += column + 0.5;
        y += row + 0.5;
        count += 1.0;
      }
    }
    ASSERT_GT(count, 20.0);
    const Eigen::Vector2d middle = Projected(view, 0.5 * (line.from + line.to));
    EXPECT_NEAR(x / count, middle.x(), 3.0);
    EXPECT_NEAR(y / count, middle.y(), 3.0);
  }
}

TEST_F(CanvasTest, SeesTheVehicleAndTheSameBytesAgain) {
  const sim::World world = MakeWorld();
  Canvas canvas(world.physics_model(), Medium::kWater, kWidth, kHeight);
  const Vector3d p = world.motion().X_WB.p;
  const View view{.target = p, .distance_m = 2.0, .azimuth_deg = 60, .elevation_deg = -20};
  const Picture with = canvas.Draw(world.physics_data(), view, {});
  EXPECT_EQ(canvas.Draw(world.physics_data(), view, {}).rgb, with.rgb);
  // Its floats are blue, as nothing else in the middle of the picture is.
  int blue = 0;
  for (int row = kHeight / 4; row < 3 * kHeight / 4; ++row) {
    for (int column = kWidth / 4; column < 3 * kWidth / 4; ++column) {
      const Rgb c = At(with, column, row);
      blue += c.b > 2 * c.g && c.b > 3 * c.r;
    }
  }
  EXPECT_GT(blue, 500);
}

TEST(GlContext, SaysWhatItTried) {
  try {
    (void)GlContext::Make("vulkan", 1, 1);
    FAIL() << "was made";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("'vulkan' is not auto, egl or osmesa"),
              std::string::npos);
  }
}

TEST(Picture, IsWrittenFromTopToBottom) {
  const auto path = std::filesystem::temp_directory_path() / "reckon_picture_test.ppm";
  WritePpm({.width = 1, .height = 2, .rgb = {1, 2, 3, 4, 5, 6}}, path.string());
  std::ifstream file(path, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  EXPECT_EQ(text, "P6\n1 2\n255\n\x01\x02\x03\x04\x05\x06");
  std::filesystem::remove(path);
  EXPECT_THROW(WritePpm({}, "/nowhere/at/all.ppm"), std::runtime_error);
}

}  // namespace
}  // namespace reckon::render

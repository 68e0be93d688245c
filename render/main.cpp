// Draws one picture of a scenario: reckon_still SCENARIO AT_S OUT.ppm [azimuth elevation distance]

#include <mujoco/mujoco.h>

#include <cstdio>
#include <exception>
#include <numbers>
#include <string>

#include "reckon/harness/robot_file.h"
#include "reckon/harness/yaml_reader.h"
#include "reckon/render/canvas.h"
#include "reckon/render/gl_context.h"
#include "reckon/sim/dvl_beams.h"
#include "reckon/sim/world.h"

namespace {

using reckon::render::Line;

/// The beams of each Doppler log: green where they meet what they can measure, else red and as long
/// as they reach.
std::vector<Line> BeamsOf(const reckon::harness::Robot& robot, const reckon::sim::World& world) {
  const Eigen::Vector4f locked(0.1F, 0.8F, 0.3F, 0.6F), lost(0.9F, 0.2F, 0.1F, 0.6F);
  std::vector<Line> lines;
  const auto* surroundings = world.environment().surroundings;
  for (const auto& sensor : robot.sensors) {
    const auto* dvl = std::get_if<reckon::sim::DvlConfig>(&sensor.errors);
    if (dvl == nullptr || surroundings == nullptr) continue;
    const reckon::sim::DvlBeams beams(sensor.name, dvl->beam_angle_deg, dvl->azimuths_deg);
    const auto X_WS = world.motion().X_WB * sensor.X_BS;
    const double cos_beam = std::cos(dvl->beam_angle_deg * std::numbers::pi / 180.0);
    for (const Eigen::Vector3d& u : beams.directions()) {
      const Eigen::Vector3d direction = X_WS.R * u;
      const auto hit = surroundings->Cast(X_WS.p, direction);
      const double altitude = hit ? hit->range_m * cos_beam : 1e9;
      const bool lock = altitude >= dvl->altitude_min_m && altitude <= dvl->altitude_max_m;
      const double length = hit ? hit->range_m : dvl->altitude_max_m / cos_beam;
      lines.push_back({X_WS.p, X_WS.p + length * direction, lock ? locked : lost, 0.008});
    }
  }
  return lines;
}

int Run(int argc, char** argv) {
  constexpr int kWidth = 1280, kHeight = 720;
  const auto scenario = reckon::harness::ReadScenario(argv[1], {});
  const auto robot = reckon::harness::LoadRobot(scenario);
  reckon::sim::World world(robot.simulated, scenario.world, scenario.seed);
  const double at_s = std::stod(argv[2]);
  do {
    world.Advance();
  } while (reckon::models::Seconds(world.motion().t_ns) < at_s);
  reckon::render::View view{.target = world.motion().X_WB.p};
  if (argc > 4) view.azimuth_deg = std::stod(argv[4]);
  if (argc > 5) view.elevation_deg = std::stod(argv[5]);
  if (argc > 6) view.distance_m = std::stod(argv[6]);
  const auto context = reckon::render::GlContext::Make("auto", kWidth, kHeight);
  const auto medium =
      scenario.world.water ? reckon::render::Medium::kWater : reckon::render::Medium::kAir;
  reckon::render::Canvas canvas(world.physics_model(), medium, kWidth, kHeight);
  WritePpm(canvas.Draw(world.physics_data(), view, BeamsOf(robot, world)), argv[3]);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "reckon_still SCENARIO AT_S OUT.ppm [AZIMUTH ELEVATION DISTANCE]\n");
    return 2;
  }
  try {
    return Run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  }
}

#include "reckon/harness/drive_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "reckon/sim/hydrodynamics.h"
#include "reckon/sim/legged_body.h"
#include "reckon/sim/seabed.h"
#include "reckon/sim/thrusters.h"
#include "reckon/sim/walking_controller.h"

namespace reckon::harness {
namespace {

class DriveRules {
 public:
  DriveRules(const Scenario& scenario, const RuleBook& book) : s_(scenario), book_(book) {}

  void Run(const models::UrdfRobot& urdf, const std::string& base_link) const {
    CheckWorld();
    if (const auto* wheels = std::get_if<sim::SkidSteerConfig>(&s_.drive)) {
      Forbid("/mission", "this robot drives: its `motion:` says where it goes");
      CheckMotion();
      CheckWheels(*wheels, urdf, base_link);
      book_.Require(!s_.world.water.has_value(), "/world/water",
                    "no water: this robot drives on the ground");
    } else if (const auto* swimmer = std::get_if<sim::UnderwaterConfig>(&s_.drive)) {
      Forbid("/motion", "this robot swims: its `mission:` says where it goes");
      CheckSwimmer(*swimmer);
    } else if (const auto* walker = std::get_if<sim::LeggedConfig>(&s_.drive)) {
      Forbid("/mission", "this robot walks: its `motion:` says where it goes");
      CheckMotion();
      CheckWalker(*walker, urdf);
    }
    if (sim::KindOf(s_.drive) != sim::DriveKind::kLegged) CheckHasNoLegs();
  }

 private:
  void Forbid(const std::string& path, const std::string& why) const {
    if (book_.IsWritten(path)) book_.Complain(path, why);
  }

  void CheckWorld() const {
    const sim::TerrainConfig& t = s_.world.terrain;
    book_.Require(t.kind != sim::TerrainKind::kRough || t.shortest_wave_m <= t.longest_wave_m,
                  "/world/terrain/longest_wave_m",
                  "at least shortest_wave_m, " + NumberText(t.shortest_wave_m));
    book_.Require(t.kind != sim::TerrainKind::kKerbs || t.kerb_spacing_m >= t.LeastKerbSpacing(),
                  "/world/terrain/kerb_spacing_m",
                  "at least " + NumberText(t.LeastKerbSpacing()) +
                      ", the kerb's width and room for the robot");
    for (std::size_t i = 0; i < s_.world.patches.size(); ++i) {
      const auto& box = s_.world.patches[i].box_m;
      book_.Require(box[2] > 0 && box[3] > 0, "/world/patches/" + std::to_string(i) + "/box_m",
                    "[centre x, centre y, size x, size y] with sizes above 0");
    }
  }

  void CheckMotion() const {
    const sim::MotionConfig& m = s_.world.motion;
    if (m.path == sim::PathKind::kWaypoints) {
      const auto elsewhere = [](const auto& point) {
        return std::hypot(point[0], point[1]) > 1e-6;
      };
      const auto& points = m.waypoints_m;
      book_.Require(std::any_of(points.begin(), points.end(), elsewhere), "/motion/waypoints_m",
                    "at least one point [x, y] other than the origin");
    }
    if (m.path != sim::PathKind::kVelocityProfile) return;
    book_.Require(!m.profile.empty(), "/motion/profile",
                  "at least one row [t_s, v_m_s, yaw_rate_rad_s]");
    double last = -1.0;
    for (std::size_t i = 0; i < m.profile.size(); ++i) {
      const auto& row = m.profile[i];
      const std::string path = "/motion/profile/" + std::to_string(i);
      book_.Require(row[0] > last && row[0] >= 0.0, path + "/0", "times of at least 0 that rise");
      book_.Require(std::abs(row[1]) <= 20.0, path + "/1", "a speed from -20 to 20");
      book_.Require(std::abs(row[2]) <= 20.0, path + "/2", "a turn rate from -20 to 20");
      last = row[0];
    }
  }

  void CheckWheels(const sim::SkidSteerConfig& config, const models::UrdfRobot& urdf,
                   const std::string& base_link) const {
    Names joints, wheels;
    for (const auto& joint : urdf.joints()) {
      joints.push_back(joint.name);
      if (sim::IsWheelJoint(urdf, joint, base_link)) wheels.push_back(joint.name);
    }
    std::set<std::string> seen;
    for (const auto& [key, side] : {std::pair{"left_joints", &config.left_joints},
                                    std::pair{"right_joints", &config.right_joints}}) {
      const std::string path = std::string("/drive/") + key;
      for (std::size_t i = 0; i < side->size(); ++i) {
        const std::string place = path + "/" + std::to_string(i);
        const std::string& joint = (*side)[i];
        book_.RequireOneOf(joint, joints, place, "joint in the URDF called");
        book_.Require(
            !Holds(joints, joint) || Holds(wheels, joint), place,
            fmt::format("a continuous joint of {} ({})", base_link, fmt::join(wheels, ", ")));
        book_.Require(seen.insert(joint).second, place, "each joint once");
      }
      book_.Require(!side->empty(), path, "at least one joint");
    }
    if (config.left_joints.size() + config.right_joints.size() > models::kMaxEncoders) {
      book_.Complain("/drive", "more than " + std::to_string(models::kMaxEncoders) + " wheels");
    }
  }

  void CheckWalker(const sim::LeggedConfig& config, const models::UrdfRobot& urdf) const {
    CheckHasNoWheels();
    book_.Require(!s_.world.water.has_value(), "/world/water",
                  "no water: this robot walks on the ground");
    book_.Require(s_.world.terrain.kind != sim::TerrainKind::kKerbs, "/world/terrain/kind",
                  "flat, slope, rough, stairs, debris or gravel: kerbs are for wheels");
    for (const std::string& foot : config.feet) {
      Names links;
      for (const auto& link : urdf.links()) links.push_back(link.name);
      book_.RequireOneOf(foot, links, "/drive/feet", "link in the URDF called");
      if (!Holds(links, foot)) return;
    }
    Try("/drive", [&] {
      const sim::LeggedBody body(urdf, config);
      Try("/control/gait", [&] {
        const sim::WalkingController check(body, config, s_.world.control, s_.world.gravity_m_s2);
      });
      for (const auto& [joint, offset] : s_.world.actual.encoder_offset_rad) {
        book_.RequireOneOf(joint, body.joints(), "/actual/encoder_offset_rad", "joint of a leg");
      }
    });
  }

  void CheckHasNoLegs() const {
    Forbid("/control", "this robot has no legs to walk on");
    const auto& actual = s_.world.actual;
    using Kind = sim::TerrainKind;
    const Kind kind = s_.world.terrain.kind;
    book_.Require(kind != Kind::kStairs && kind != Kind::kDebris && kind != Kind::kGravel,
                  "/world/terrain/kind", "ground for a robot without legs");
    book_.Require(!s_.world.pushes.has_value(), "/world/pushes", "none: they are for legs");
    book_.Require(actual.leg_offset_m.empty() && actual.foot_radius_offset_m == 0.0 &&
                      actual.encoder_offset_rad.empty(),
                  "/actual", "nothing of legs: this robot has none");
    for (const auto& [name, sensor] : s_.sensors) {
      const auto sent = sim::KindOf(sensor.errors);
      book_.Require(sent != models::SensorKind::kContacts &&
                        sent != models::SensorKind::kFootForces &&
                        sent != models::SensorKind::kTorques,
                    "/sensors/" + name + "/type",
                    "no contacts, foot forces or torques: this robot has no legs");
    }
  }

  void CheckHasNoWheels() const {
    const auto& actual = s_.world.actual;
    book_.Require(actual.wheel_radius_scale == sim::ActualConfig{}.wheel_radius_scale,
                  "/actual/wheel_radius_scale", "nothing: this robot has no wheels");
    book_.Require(actual.track_scale == 1.0, "/actual/track_scale",
                  "nothing: this robot has no wheels");
  }

  void CheckSwimmer(const sim::UnderwaterConfig& config) const {
    CheckHasNoWheels();
    book_.Require(s_.world.patches.empty(), "/world/patches", "none: they are for wheels");
    for (const auto& [name, sensor] : s_.sensors) {
      book_.Require(!std::holds_alternative<sim::EncoderConfig>(sensor.errors),
                    "/sensors/" + name + "/type", "no encoders: this robot has no wheels");
    }
    Try("/drive/hydrodynamics", [&] {
      const sim::Hydrodynamics check("hydrodynamics", config.hydrodynamics,
                                     s_.world.water->density_kg_m3, s_.world.gravity_m_s2);
    });
    Try("/drive/thrusters", [&] { const sim::Thrusters check("thrusters", config.thrusters); });
    if (s_.world.terrain.kind == sim::TerrainKind::kKerbs) {
      return book_.Complain("/world/terrain/kind", "a seabed is flat, slope or rough");
    }
    Try("/mission", [&] { CheckMission(); });
  }

  void CheckMission() const {
    const sim::Seabed seabed(s_.world, s_.seed);
    const auto depth = [&seabed](double x, double y) { return seabed.Depth(x, y); };
    const auto trouble = sim::MissionTrouble(sim::LegsOf(s_.world.mission), depth, 0.0);
    if (trouble) book_.Complain("/mission", *trouble);
  }

  /// What the simulator would refuse is a complaint at `path`.
  template <class Function>
  void Try(const std::string& path, const Function& function) const {
    try {
      function();
    } catch (const std::invalid_argument& error) {
      book_.Complain(path, error.what());
    }
  }

  const Scenario& s_;
  const RuleBook& book_;
};

}  // namespace

void CheckDriven(const Scenario& scenario, const models::UrdfRobot& urdf,
                 const std::string& base_link, const RuleBook& book) {
  DriveRules(scenario, book).Run(urdf, base_link);
}

}  // namespace reckon::harness

#include "reckon/sim/world.h"

#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "reckon/sim/legged_vehicle.h"
#include "reckon/sim/rotation_vector.h"
#include "reckon/sim/skid_steer_vehicle.h"
#include "reckon/sim/underwater_vehicle.h"

namespace reckon::sim {
namespace {

constexpr double kLongestSettle = 10.0;  // s beyond settle_s
constexpr double kSlidAway = 1.0;        // m from the origin: it will not come to rest
constexpr double kStillTime = 0.1;       // s that it must have been still for

const WorldConfig& Checked(const WorldConfig& config) {
  RequireIn(WorldConfig::kPhysicsStep, config.physics_step_s, "world", "physics_step_s");
  RequireIn(WorldConfig::kGravity, config.gravity_m_s2, "world", "gravity_m_s2");
  RequireIn(WorldConfig::kSettle, config.settle_s, "world", "settle_s");
  const double ns = config.physics_step_s * 1e9;
  if (!(std::abs(ns - std::round(ns)) < 1e-3)) {
    throw std::invalid_argument("world: physics_step_s must be a whole number of ns");
  }
  return config;
}

std::unique_ptr<Vehicle> MakeVehicle(const RobotConfig& robot, const WorldConfig& config,
                                     std::uint64_t seed) {
  switch (KindOf(robot.drive)) {
    case DriveKind::kSkidSteer:
      return std::make_unique<SkidSteerVehicle>(robot, config, seed);
    case DriveKind::kUnderwater:
      return std::make_unique<UnderwaterVehicle>(robot, config, seed);
    case DriveKind::kLegged:
      return std::make_unique<LeggedVehicle>(robot, config, seed);
  }
  throw std::invalid_argument("robot '" + robot.name + "': unknown drive");
}

}  // namespace

class World::Impl {
 public:
  Impl(const RobotConfig& robot, const WorldConfig& config, std::uint64_t seed)
      : config_(Checked(config)), vehicle_(MakeVehicle(robot, config_, seed)) {
    motion_.step_ns = std::llround(config.physics_step_s * 1e9);
    next_ = vehicle_->Read();
    Settle();
  }

  void Advance() {
    if (started_) {
      motion_.t_ns += motion_.step_ns;
      Step(motion_.t_ns);
    }
    started_ = true;
    motion_.X_WB_previous = previous_.X_WB;
    motion_.X_WB = now_.X_WB;
    motion_.X_WB_next = next_.X_WB;
    motion_.joint_angle_rad = now_.joint_angle_rad;
    motion_.joint_rate_rad_s = now_.joint_rate_rad_s;
    motion_.joint_command_n_m = now_.joint_command_n_m;
    motion_.joint_torque_n_m = now_.joint_torque_n_m;
    motion_.feet = now_.feet;
    motion_.gait = now_.gait;
    motion_.water_velocity_m_s = now_.water_velocity_m_s;
  }

  const MotionWindow& motion() const { return motion_; }

  const Vehicle& vehicle() const { return *vehicle_; }

  Environment environment() const {
    Environment environment;
    environment.step_ns = motion_.step_ns;
    environment.gravity_m_s2 = config_.gravity_m_s2;
    environment.surroundings = vehicle_->surroundings();
    if (!config_.water) return environment;
    environment.water_density_kg_m3 = config_.water->density_kg_m3;
    environment.sound_speed_m_s = config_.water->sound_speed_m_s;
    return environment;
  }

  ground_truth::Truth TruthNow() const {
    ground_truth::Truth truth;
    truth.t_ns = motion_.t_ns;
    truth.X_WB = now_.X_WB;
    truth.v_WB = motion_.Velocity(Eigen::Vector3d::Zero());
    truth.w_WB_B = RotationLog(previous_.X_WB.R.transpose() * next_.X_WB.R) /
                   (2.0 * models::Seconds(motion_.step_ns));
    if (now_.feet.count == 0) truth.wheel_rate_rad_s = now_.joint_rate_rad_s;
    truth.wheel_slip_m_s = now_.wheel_slip_m_s;
    truth.wheel_load_n = now_.wheel_load_n;
    truth.feet = now_.feet;
    return truth;
  }

 private:
  void Settle() {
    const auto steps = [&](double s) { return std::llround(s / config_.physics_step_s); };
    const auto least = steps(config_.settle_s), most = least + steps(kLongestSettle);
    long long still = 0;  // steps in a row: a swing is still for an instant
    for (long long i = 0; i < least || still < steps(kStillTime); ++i) {
      Step(-motion_.step_ns);
      still = vehicle_->IsSettled() ? still + 1 : 0;
      if (i > most || next_.X_WB.p.head<2>().norm() > kSlidAway) {
        throw std::invalid_argument(
            "world: the robot does not come to rest on this terrain (too steep for its friction?)");
      }
    }
    vehicle_->Release();
    Step(-motion_.step_ns);  // once for the look-ahead, once for the pose before t = 0
    Step(-motion_.step_ns);
  }

  /// Moves the three instants on by one physics step; `t_ns` is that of the middle one afterwards.
  void Step(models::TimeNs t_ns) {
    previous_ = now_;
    now_ = next_;
    vehicle_->Step(t_ns, now_);
    next_ = vehicle_->Read();
    Check();
  }

  void Check() const {
    const mjData& data = vehicle_->data();
    for (int i = 0; i < mjNWARNING; ++i) {
      if (data.warning[i].number > 0) {
        Fail(std::string("the physics engine warned: ") +
             mju_warningText(i, static_cast<std::size_t>(data.warning[i].lastinfo)));
      }
    }
    const auto& [R, p] = next_.X_WB;
    if (!p.allFinite() || !R.allFinite()) Fail("the physics diverged (a pose is not a number)");
    if (const auto trouble = vehicle_->Trouble(next_)) Fail(*trouble);
  }

  [[noreturn]] void Fail(const std::string& what) const {
    const auto& p = next_.X_WB.p;
    char where[160];
    std::snprintf(where, sizeof(where), " at x = %.3f m, y = %.3f m, z = %.3f m, t = %.3f s", p.x(),
                  p.y(), p.z(), models::Seconds(motion_.t_ns));
    throw WorldFailure(what + where);
  }

  WorldConfig config_;
  std::unique_ptr<Vehicle> vehicle_;
  MotionWindow motion_;
  VehicleState previous_, now_, next_;
  bool started_ = false;
};

World::World(const RobotConfig& robot, const WorldConfig& config, std::uint64_t seed)
    : impl_(std::make_unique<Impl>(robot, config, seed)) {}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

void World::Advance() { impl_->Advance(); }
const MotionWindow& World::motion() const { return impl_->motion(); }
Environment World::environment() const { return impl_->environment(); }
const mjModel_& World::physics_model() const { return impl_->vehicle().model(); }
const mjData_& World::physics_data() const { return impl_->vehicle().data(); }
ground_truth::Truth World::TruthNow() const { return impl_->TruthNow(); }

std::string World::PhysicsVersion() { return std::string("MuJoCo ") + mj_versionString(); }

}  // namespace reckon::sim

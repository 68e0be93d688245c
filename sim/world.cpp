#include "reckon/sim/world.h"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <stdexcept>
#include <string>

#include <Eigen/Geometry>

#include "reckon/models/urdf_robot.h"
#include "reckon/sim/driver.h"
#include "reckon/sim/rotation_vector.h"
#include "reckon/sim/skid_steer.h"
#include "reckon/sim/skid_steer_model.h"
#include "reckon/sim/terrain.h"

namespace reckon::sim {
namespace {

constexpr double kMaxTiltDeg = 75.0;
constexpr double kLongestSettle = 10.0;  // s beyond settle_s
constexpr double kStillSpeed = 1e-6;     // m/s and rad/s: the robot is at rest,
constexpr double kSlidAway = 1.0;        // m from the origin: it will not come to rest
constexpr double kStillTime = 0.1;       // s, when it has been as still for so long

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

/// Checked before MuJoCo meets it: these messages are the clearer ones.
models::UrdfRobot ReadUrdf(const RobotConfig& robot, const ActualConfig& actual) {
  auto urdf = models::UrdfRobot::FromFile(robot.urdf_path);
  SkidSteer::Check(robot, actual, urdf);
  return urdf;
}

DataPtr MakeData(const mjModel& model) {
  DataPtr data(mj_makeData(&model));
  if (!data) throw std::bad_alloc();
  return data;
}

/// x forward over the ground, so that the yaw is 0, and z along the ground's normal.
Eigen::Matrix3d StandOn(const Ground& ground) {
  Eigen::Matrix3d R;
  R.col(2) = Eigen::Vector3d(-ground.hx, -ground.hy, 1.0).normalized();
  R.col(0) = Eigen::Vector3d::UnitY().cross(R.col(2)).normalized();
  R.col(1) = R.col(2).cross(R.col(0));
  return R;
}

}  // namespace

class World::Impl {
 public:
  Impl(const RobotConfig& robot, const WorldConfig& config, std::uint64_t seed)
      : config_(Checked(config)),
        urdf_(ReadUrdf(robot, config.actual)),
        terrain_(config.terrain, config.patches, seed),
        driver_(config.motion),
        model_(BuildSkidSteerModel(robot, config, terrain_)),
        data_(MakeData(*model_)),
        steer_(robot, config, urdf_, *model_) {
    motion_.step_ns = std::llround(config.physics_step_s * 1e9);
    driver_period_steps_ =
        std::max(1LL, std::llround(1.0 / (Driver::kRateHz * config.physics_step_s)));
    Place();
    Settle();
  }

  void Advance() {
    if (started_) {
      motion_.t_ns += motion_.step_ns;
      Step();
    }
    started_ = true;
    motion_.X_WB_previous = previous_.X_WB;
    motion_.X_WB = now_.X_WB;
    motion_.X_WB_next = next_.X_WB;
    motion_.joint_angle_rad = now_.angle_rad;
    motion_.joint_rate_rad_s = now_.rate_rad_s;
  }

  const MotionWindow& motion() const { return motion_; }

  ground_truth::Truth TruthNow() const {
    ground_truth::Truth truth;
    truth.t_ns = motion_.t_ns;
    truth.X_WB = now_.X_WB;
    truth.v_WB = motion_.Velocity(Eigen::Vector3d::Zero());
    truth.w_WB_B = RotationLog(previous_.X_WB.R.transpose() * next_.X_WB.R) /
                   (2.0 * models::Seconds(motion_.step_ns));
    truth.wheel_rate_rad_s = now_.rate_rad_s;
    truth.wheel_slip_m_s = now_.slip_m_s;
    truth.wheel_load_n = now_.load_n;
    return truth;
  }

 private:
  struct Instant {
    models::Pose X_WB;
    models::EncoderVector angle_rad, rate_rad_s, slip_m_s, load_n;
  };

  /// On the ground at x = y = 0 with yaw 0, its wheels as deep in the ground as they will rest.
  void Place() {
    const Ground ground = terrain_.At(0.0, 0.0);
    const Eigen::Matrix3d R_WB = StandOn(ground);
    const double z = ground.h + steer_.RestHeight(*model_) / R_WB(2, 2);
    steer_.PlaceBase({R_WB, {0.0, 0.0, z}}, *data_);
    next_ = Read();
  }

  void Settle() {
    steer_.SetBrake(true);
    const auto steps = [&](double s) { return std::llround(s / config_.physics_step_s); };
    const auto least = steps(config_.settle_s), most = least + steps(kLongestSettle);
    long long still = 0;  // steps in a row: a swing is still for an instant
    for (long long i = 0; i < least || still < steps(kStillTime); ++i) {
      Step();
      still = Still() ? still + 1 : 0;
      if (i > most || next_.X_WB.p.head<2>().norm() > kSlidAway) {
        throw std::invalid_argument(
            "world: the robot does not come to rest on this terrain (too steep for its friction?)");
      }
    }
    steer_.SetBrake(false);
    Step();  // once for the look-ahead, once for the pose before t = 0
    Step();
    settled_ = true;
  }

  bool Still() const {
    return Eigen::Map<const Eigen::VectorXd>(data_->qvel, model_->nv).lpNorm<Eigen::Infinity>() <
           kStillSpeed;
  }

  /// Moves the three instants on by one physics step.
  void Step() {
    previous_ = now_;
    now_ = next_;
    steer_.Apply(settled_ ? Command() : DriveCommand{}, terrain_, *data_);
    now_.slip_m_s = steer_.slip_m_s();
    now_.load_n = steer_.load_n();
    // Equal to mj_step1, forces, mj_step2: the forces follow from positions and velocities alone.
    mj_step(model_.get(), data_.get());
    next_ = Read();
    Check();
  }

  const DriveCommand& Command() {
    if (motion_.t_ns / motion_.step_ns % driver_period_steps_ == 0) {
      const auto& [R, p] = now_.X_WB;
      command_ =
          driver_.Update(models::Seconds(motion_.t_ns), p.head<2>(), std::atan2(R(1, 0), R(0, 0)));
    }
    return command_;
  }

  Instant Read() {
    steer_.ReadWheels(*data_);
    return {steer_.BasePose(*data_), steer_.angle_rad(), steer_.rate_rad_s(), steer_.slip_m_s(),
            steer_.load_n()};
  }

  void Check() const {
    for (int i = 0; i < mjNWARNING; ++i) {
      if (data_->warning[i].number > 0) {
        Fail(std::string("the physics engine warned: ") +
             mju_warningText(i, static_cast<std::size_t>(data_->warning[i].lastinfo)));
      }
    }
    const auto& [R, p] = next_.X_WB;
    if (!p.allFinite() || !R.allFinite()) Fail("the physics diverged (a pose is not a number)");
    if (!terrain_.Contains(p.x(), p.y())) {
      char text[120];
      std::snprintf(text, sizeof(text), "the robot left the map (|x|, |y| ≤ %g m)",
                    terrain_.config().half_size_m);
      Fail(text);
    }
    static const double least_upright = std::cos(kMaxTiltDeg * std::numbers::pi / 180.0);
    if (R(2, 2) < least_upright) Fail("the robot turned over");
  }

  [[noreturn]] void Fail(const std::string& what) const {
    const auto& p = next_.X_WB.p;
    char where[160];
    std::snprintf(where, sizeof(where), " at x = %.3f m, y = %.3f m, z = %.3f m, t = %.3f s", p.x(),
                  p.y(), p.z(), models::Seconds(motion_.t_ns));
    throw WorldFailure(what + where);
  }

  WorldConfig config_;
  models::UrdfRobot urdf_;
  Terrain terrain_;
  Driver driver_;
  ModelPtr model_;
  DataPtr data_;
  SkidSteer steer_;
  MotionWindow motion_;
  Instant previous_, now_, next_;
  DriveCommand command_;
  long long driver_period_steps_ = 1;
  bool settled_ = false, started_ = false;
};

World::World(const RobotConfig& robot, const WorldConfig& config, std::uint64_t seed)
    : impl_(std::make_unique<Impl>(robot, config, seed)) {}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

void World::Advance() { impl_->Advance(); }
const MotionWindow& World::motion() const { return impl_->motion(); }
ground_truth::Truth World::TruthNow() const { return impl_->TruthNow(); }

std::string World::PhysicsVersion() { return std::string("MuJoCo ") + mj_versionString(); }

}  // namespace reckon::sim

#include "reckon/harness/describe_choices.h"

#include "reckon/estimator/registry.h"

namespace reckon::harness {

template <>
std::span<const Choice<sim::TerrainKind>> Choices() {
  using Kind = sim::TerrainKind;
  static const std::vector<Choice<Kind>> kChoices{
      {Kind::kFlat, "flat", "a plane"},
      {Kind::kSlope, "slope", "an inclined plane"},
      {Kind::kRough, "rough", "smooth random hills of a given RMS height, new ones for every seed"},
      {Kind::kKerbs, "kerbs", "boxes across the path on a plane"},
      {Kind::kStairs, "stairs", "flights up and down along x, for legs"},
      {Kind::kDebris, "debris", "bars, bricks and boards on a plane, for legs"},
      {Kind::kGravel, "gravel", "stones of one size side by side, for legs"}};
  return kChoices;
}

template <>
std::span<const Choice<sim::PathKind>> Choices() {
  using Kind = sim::PathKind;
  static const std::vector<Choice<Kind>> kChoices{
      {Kind::kStand, "stand", "stands still"},
      {Kind::kSquare, "square", "laps of a square, corners turned on the way"},
      {Kind::kCircle, "circle", "laps of a circle"},
      {Kind::kFigureEight, "figure_eight", "laps of two circles that touch"},
      {Kind::kWaypoints, "waypoints", "through given points, stopping at the last"},
      {Kind::kVelocityProfile, "velocity_profile", "given speeds and turn rates over time"}};
  return kChoices;
}

template <>
std::span<const Choice<sim::ImuMode>> Choices() {
  using Mode = sim::ImuMode;
  static const std::vector<Choice<Mode>> kChoices{
      {Mode::kIncrement, "increment", "integrates over the sample's interval, as real units do"},
      {Mode::kPoint, "point", "the rate and specific force at one instant, for comparison"}};
  return kChoices;
}

template <>
std::span<const Choice<sim::FaultKind>> Choices() {
  using Kind = sim::FaultKind;
  static const std::vector<Choice<Kind>> kChoices{
      {Kind::kDropout, "dropout", "nothing is sent"},
      {Kind::kStuck, "stuck", "the last good sample is sent again, freshly stamped"},
      {Kind::kBiasStep, "bias_step", "an offset on every channel"},
      {Kind::kScaleStep, "scale_step", "a factor on every channel"},
      {Kind::kSaturation, "saturation", "every channel is clipped"},
      {Kind::kExtraDelay, "extra_delay", "the message arrives later"},
      {Kind::kTimeJitter, "time_jitter", "the time of validity is misreported at random"},
      {Kind::kOutlierBurst, "outlier_burst", "three samples in ten get a large random error"},
      {Kind::kNanBurst, "nan_burst", "every channel is not a number"}};
  return kChoices;
}

template <>
std::span<const Choice<sim::SensorType>> Choices() {
  using Type = sim::SensorType;
  static const std::vector<Choice<Type>> kChoices{
      {Type::kImu, "imu", "gyroscope and accelerometer"},
      {Type::kEncoders, "encoders", "rotary encoders of all wheels or joints"},
      {Type::kBodyVelocity, "body_velocity", "an ideal velocity sensor with white noise"},
      {Type::kDepth, "depth", "a pressure sensor: how deep it lies"},
      {Type::kPose, "pose", "an absolute pose or position from outside, with white noise"},
      {Type::kDvl, "dvl", "a Doppler velocity log, beam by beam"},
      {Type::kContacts, "contacts", "which feet stand, by truth or by the gait"},
      {Type::kTorques, "torques", "of the motors of all joints"},
      {Type::kFootForces, "foot_forces", "what presses each foot, along the ground's normal"}};
  return kChoices;
}

template <>
std::span<const Choice<sim::DriveKind>> Choices() {
  using Kind = sim::DriveKind;
  static const std::vector<Choice<Kind>> kChoices{
      {Kind::kSkidSteer, "skid_steer", "wheels on the ground, one motor a side"},
      {Kind::kUnderwater, "underwater", "thrusters in the sea"},
      {Kind::kLegged, "legged", "legs of three joints each, walking blind"}};
  return kChoices;
}

template <>
std::span<const Choice<sim::GaitKind>> Choices() {
  using Kind = sim::GaitKind;
  static const std::vector<Choice<Kind>> kChoices{
      {Kind::kTrot, "trot", "diagonal pairs"},
      {Kind::kWalk, "walk", "one foot after the other"},
      {Kind::kPace, "pace", "pairs of a side"},
      {Kind::kPronk, "pronk", "all feet at once"},
      {Kind::kBound, "bound", "front feet, then rear feet"}};
  return kChoices;
}

template <>
std::span<const Choice<sim::ContactSource>> Choices() {
  using Source = sim::ContactSource;
  static const std::vector<Choice<Source>> kChoices{
      {Source::kTruth, "truth", "the true contacts"},
      {Source::kGait, "gait", "the schedule of the walking controller"}};
  return kChoices;
}

template <>
std::span<const Choice<sim::TorqueSource>> Choices() {
  using Source = sim::TorqueSource;
  static const std::vector<Choice<Source>> kChoices{
      {Source::kMeasured, "measured", "what the motors give, with errors"},
      {Source::kCommanded, "commanded", "what the controller asks for"}};
  return kChoices;
}

template <>
std::span<const Choice<sim::MissionKind>> Choices() {
  using Kind = sim::MissionKind;
  static const std::vector<Choice<Kind>> kChoices{
      {Kind::kHover, "hover", "goes down and holds its place"},
      {Kind::kDive, "dive", "goes down, stays a while and returns"},
      {Kind::kSquare, "square", "laps of a square at one depth"},
      {Kind::kLawnmower, "lawnmower", "parallel tracks at one depth"},
      {Kind::kHelix, "helix", "circles from one depth to another"},
      {Kind::kWaypoints, "waypoints", "through given points"}};
  return kChoices;
}

template <>
std::span<const Choice<sim::FeatureKind>> Choices() {
  using Kind = sim::FeatureKind;
  static const std::vector<Choice<Kind>> kChoices{
      {Kind::kBoulder, "boulder", "an ellipsoid, its lower half in the ground"},
      {Kind::kBlock, "block", "a box on the ground"},
      {Kind::kPipe, "pipe", "a lying cylinder: its length, then twice its diameter"}};
  return kChoices;
}

template <>
std::span<const Choice<estimator::GateAction>> Choices() {
  using Action = estimator::GateAction;
  static const std::vector<Choice<Action>> kChoices{
      {Action::kOff, "off", "no gate"},
      {Action::kWarn, "warn", "applied all the same, and counted"},
      {Action::kReject, "reject", "not applied"},
      {Action::kInflate, "inflate", "applied with its noise scaled up to the gate's edge"}};
  return kChoices;
}

template <>
std::span<const Choice<estimator::InitialisationKind>> Choices() {
  using Kind = estimator::InitialisationKind;
  static const std::vector<Choice<Kind>> kChoices{
      {Kind::kPrior, "prior", "from the prior alone"},
      {Kind::kStatic, "static",
       "tilt and gyroscope bias from a resting IMU, the rest from the prior"},
      {Kind::kPose, "pose",
       "orientation and position from the first pose sample, the rest from the prior"}};
  return kChoices;
}

template <>
std::span<const Choice<estimator::ErrorForm>> Choices() {
  static const std::vector<Choice<estimator::ErrorForm>> kChoices{
      {estimator::ErrorForm::kRightInvariant, "right", "right-invariant"},
      {estimator::ErrorForm::kLeftInvariant, "left", "left-invariant"}};
  return kChoices;
}

template <>
std::span<const Choice<estimator::FootKind>> Choices() {
  using Kind = estimator::FootKind;
  static const std::vector<Choice<Kind>> kChoices{
      {Kind::kRolling, "rolling", "a sphere that rolls on level ground"},
      {Kind::kStatic, "static", "a point that stands"}};
  return kChoices;
}

template <>
std::span<const Choice<estimator::LegCorrection>> Choices() {
  using Use = estimator::LegCorrection;
  static const std::vector<Choice<Use>> kChoices{
      {Use::kPosition, "position", "its place is part of the state"},
      {Use::kVelocity, "velocity", "leg odometry: a velocity correction"}};
  return kChoices;
}

template <>
std::span<const Choice<estimator::ForceModel>> Choices() {
  using Model = estimator::ForceModel;
  static const std::vector<Choice<Model>> kChoices{
      {Model::kMomentum, "momentum", "a momentum observer of each leg"},
      {Model::kInertia, "inertia", "the leg's dynamics, accelerations by difference"},
      {Model::kStatic, "static", "what the torques hold beside the leg's weight"}};
  return kChoices;
}

template <>
std::span<const Choice<estimator::SlipRule>> Choices() {
  using Rule = estimator::SlipRule;
  static const std::vector<Choice<Rule>> kChoices{
      {Rule::kOff, "off", "nothing"},
      {Rule::kSpeed, "speed", "its speed, as the state and the encoders have it"},
      {Rule::kNis, "nis", "the normalised innovation squared of its leg's odometry"}};
  return kChoices;
}

template <>
std::span<const Choice<estimator::SlipAction>> Choices() {
  using Action = estimator::SlipAction;
  static const std::vector<Choice<Action>> kChoices{
      {Action::kInflate, "inflate", "its own belief is widened along the innovation"},
      {Action::kDrop, "drop", "it is forgotten, and stands anew where the leg says"}};
  return kChoices;
}

template <>
std::span<const Choice<ground_truth::Alignment>> Choices() {
  using Align = ground_truth::Alignment;
  static const std::vector<Choice<Align>> kChoices{
      {Align::kNone, "none", "as it is"},
      {Align::kFirstPose, "first_pose", "the first poses coincide"},
      {Align::kFirstYawPosition, "first_yaw_position",
       "yaw and position of the first poses coincide"},
      {Align::kYawPosition, "yaw_position", "least squares over yaw and position"},
      {Align::kSe3, "se3", "least squares over rotation and position"},
      {Align::kSim3, "sim3", "the same, and scale"}};
  return kChoices;
}

template <>
std::span<const Choice<NoiseSource>> Choices() {
  static const std::vector<Choice<NoiseSource>> kChoices{
      {NoiseSource::kNominal, "nominal", "what the robot's folder says"},
      {NoiseSource::kMatched, "matched", "computed from `sensors:`, as far as that says it"}};
  return kChoices;
}

const std::vector<Choice<std::string>>& EstimatorTypes() {
  static const std::vector<Choice<std::string>> kTypes = [] {
    std::vector<Choice<std::string>> types;
    for (const auto& entry : estimator::Registry()) {
      const std::string name(entry.name);
      types.push_back({name, name, std::string(entry.description)});
    }
    types.push_back({"process", "process", "an external program on a pipe"});
    return types;
  }();
  return kTypes;
}

}  // namespace reckon::harness

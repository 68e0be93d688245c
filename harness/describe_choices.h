#pragma once

#include <span>
#include <string>
#include <vector>

#include "reckon/estimator/setup.h"
#include "reckon/ground_truth/score_options.h"
#include "reckon/harness/describe.h"
#include "reckon/harness/scenario.h"
#include "reckon/sim/robot_config.h"
#include "reckon/sim/sensor_config.h"
#include "reckon/sim/world_config.h"

namespace reckon::harness {

/// The range of a key that the simulator checks as well.
constexpr Limits Within(const sim::Range& range) {
  return {.min = range.min, .max = range.max, .above_min = range.above_min};
}

// The words of the scenario's enumerations, one table each.
template <>
std::span<const Choice<sim::TerrainKind>> Choices();
template <>
std::span<const Choice<sim::PathKind>> Choices();
template <>
std::span<const Choice<sim::ImuMode>> Choices();
template <>
std::span<const Choice<sim::FaultKind>> Choices();
template <>
std::span<const Choice<sim::FaultChannels>> Choices();
template <>
std::span<const Choice<sim::SensorType>> Choices();
template <>
std::span<const Choice<sim::DriveKind>> Choices();
template <>
std::span<const Choice<sim::GaitKind>> Choices();
template <>
std::span<const Choice<sim::ContactSource>> Choices();
template <>
std::span<const Choice<sim::TorqueSource>> Choices();
template <>
std::span<const Choice<sim::MissionKind>> Choices();
template <>
std::span<const Choice<sim::FeatureKind>> Choices();
template <>
std::span<const Choice<estimator::GateAction>> Choices();
template <>
std::span<const Choice<estimator::InitialisationKind>> Choices();
template <>
std::span<const Choice<estimator::ErrorForm>> Choices();
template <>
std::span<const Choice<estimator::FootKind>> Choices();
template <>
std::span<const Choice<estimator::LegCorrection>> Choices();
template <>
std::span<const Choice<estimator::ForceModel>> Choices();
template <>
std::span<const Choice<estimator::SlipRule>> Choices();
template <>
std::span<const Choice<estimator::SlipAction>> Choices();
template <>
std::span<const Choice<ground_truth::Alignment>> Choices();
template <>
std::span<const Choice<NoiseSource>> Choices();

/// The types of estimator: the registry's names and `process`.
const std::vector<Choice<std::string>>& EstimatorTypes();

/// The grades of an IMU and of a Doppler log.
const std::vector<Choice<std::string>>& ImuGrades();
const std::vector<Choice<std::string>>& DvlGrades();

}  // namespace reckon::harness

#pragma once

#include <cstddef>
#include <type_traits>
#include <variant>

#include "reckon/harness/describe_choices.h"
#include "reckon/harness/describe_dvl.h"
#include "reckon/harness/describe_leg_sensors.h"
#include "reckon/harness/describe_timing.h"
#include "reckon/harness/describe_traits.h"

namespace reckon::harness {

template <class Archive>
void DescribeGyroErrors(Archive& a, sim::TriadErrors& e) {
  a.Field("noise_density_rad_per_s_sqrt_hz", e.noise_density, "White noise", Between(0, 10));
  a.Field("bias_walk_rad_per_s2_sqrt_hz", e.bias_walk, "Random walk of the bias", Between(0, 10));
  a.Field("bias_instability_rad_per_s", e.bias_instability,
          "Standard deviation of a first-order Gauss-Markov bias", Between(0, 10));
  a.Field("bias_time_constant_s", e.bias_time_constant_s, "Its time constant", AboveUpTo(0, 1e9));
  a.Field("turn_on_bias_rad_per_s", e.turn_on_bias, "Sigma of the bias drawn once a run",
          Between(0, 10));
  a.Field("scale", e.scale, "Sigma of the scale error drawn once an axis", Between(0, 1));
  a.Field("misalignment_rad", e.misalignment, "Sigma of each off-diagonal term drawn once",
          Between(0, 1));
  a.Field("g_sensitivity_rad_per_s_per_m_s2", e.g_sensitivity,
          "Sigma of each term of the sensitivity to specific force, drawn once", Between(0, 1));
  a.Field("range_rad_per_s", e.range, "Clips at plus and minus this; 0: no limit", Between(0, 1e4));
  a.Field("resolution_rad_per_s", e.resolution, "Of one bit; 0: not quantised", Between(0, 10));
}

template <class Archive>
void DescribeAccelErrors(Archive& a, sim::TriadErrors& e) {
  a.Field("noise_density_m_per_s2_sqrt_hz", e.noise_density, "White noise", Between(0, 100));
  a.Field("bias_walk_m_per_s3_sqrt_hz", e.bias_walk, "Random walk of the bias", Between(0, 100));
  a.Field("bias_instability_m_per_s2", e.bias_instability,
          "Standard deviation of a first-order Gauss-Markov bias", Between(0, 100));
  a.Field("bias_time_constant_s", e.bias_time_constant_s, "Its time constant", AboveUpTo(0, 1e9));
  a.Field("turn_on_bias_m_per_s2", e.turn_on_bias, "Sigma of the bias drawn once a run",
          Between(0, 100));
  a.Field("scale", e.scale, "Sigma of the scale error drawn once an axis", Between(0, 1));
  a.Field("misalignment_rad", e.misalignment, "Sigma of each off-diagonal term drawn once",
          Between(0, 1));
  a.Field("range_m_per_s2", e.range, "Clips at plus and minus this; 0: no limit", Between(0, 1e5));
  a.Field("resolution_m_per_s2", e.resolution, "Of one bit; 0: not quantised", Between(0, 100));
}

/// Fills the triads of `imu` with those of its grade.
void ApplyGrade(sim::ImuConfig& imu);

template <class Archive>
void DescribeErrors(Archive& a, sim::ImuConfig& e) {
  DescribeTiming(a, e.timing);
  a.Word("grade", e.grade, ImuGrades(),
         "Data-sheet errors; what is written under gyro and accel wins over them");
  if constexpr (!Archive::kWrites) ApplyGrade(e);
  a.Field("mode", e.mode, "What a sample is");
  a.Group("gyro", "Errors of the gyroscope", [&e](auto& sub) { DescribeGyroErrors(sub, e.gyro); });
  a.Group("accel", "Errors of the accelerometer",
          [&e](auto& sub) { DescribeAccelErrors(sub, e.accel); });
  a.Field("bandwidth_hz", e.bandwidth_hz, "Of the anti-alias filter; 0: none", Between(0, 1e5));
  a.Field("bandwidth_poles", e.bandwidth_poles, "Poles of that filter", Between(1, 2));
}

template <class Archive>
void DescribeErrors(Archive& a, sim::EncoderConfig& e) {
  DescribeTiming(a, e.timing);
  a.Field("counts_per_rad", e.counts_per_rad, "At the wheel; 0: not quantised", Between(0, 1e9));
  a.Field("noise_rad", e.noise_rad, "White, per reading, before quantisation", Between(0, 1));
  a.Field("eccentricity_rad", e.eccentricity_rad, "Amplitude of an error once a turn",
          Between(0, 1));
  a.Field("offset_rad", e.offset_rad, "Sigma of the constant offset drawn once", Between(0, 100));
  a.Field("scale", e.scale, "Sigma of the scale error drawn once an encoder", Between(0, 1));
  a.Field("rate_window_s", e.rate_window_s, "The firmware differences counts over this window",
          AboveUpTo(0, 10));
  a.Field("rate_filter_hz", e.rate_filter_hz, "And smooths that with one pole; 0: does not",
          Between(0, 1e5));
}

template <class Archive>
void DescribeErrors(Archive& a, sim::BodyVelocityConfig& e) {
  DescribeTiming(a, e.timing);
  a.Field("noise_m_per_s", e.noise_m_per_s, "Sigma a sample, along the sensor's axes",
          Between(0, 100));
}

template <class Archive>
void DescribeErrors(Archive& a, sim::DepthConfig& e) {
  DescribeTiming(a, e.timing);
  a.Field("noise_m", e.noise_m, "Sigma a sample, white, before quantisation", Between(0, 100));
  a.Field("offset_m", e.offset_m, "Sigma of the constant offset drawn once", Between(0, 100));
  a.Field("resolution_m", e.resolution_m, "Of one bit; 0: not quantised", Between(0, 10));
  a.Field("assumed_density_kg_m3", e.assumed_density_kg_m3,
          "What it takes the water's density to be; 0: what it is", Between(0, 1100));
  a.Field("surface_drift_m_per_s_sqrt_hz", e.surface_drift_m_per_s_sqrt_hz,
          "Random walk of the depth at which it reads zero (weather, tide)", Between(0, 1));
}

template <class Archive>
void DescribeErrors(Archive& a, sim::PoseConfig& e) {
  DescribeTiming(a, e.timing);
  a.Field("noise_position_m", e.noise_position_m, "Sigma a sample, along the world's axes",
          Between(0, 1e4));
  a.Field("noise_orientation_rad", e.noise_orientation_rad,
          "Sigma a sample of the rotation vector from true to measured, about the world's axes",
          Between(0, 3.2));
  a.Field("orientation", e.orientation, "false: it knows its position alone");
}

template <sim::SensorType type, class Errors>
inline constexpr bool kIsOfType =
    std::is_same_v<std::variant_alternative_t<static_cast<std::size_t>(type), sim::SensorErrors>,
                   Errors>;
static_assert(kIsOfType<sim::SensorType::kImu, sim::ImuConfig> &&
              kIsOfType<sim::SensorType::kEncoders, sim::EncoderConfig> &&
              kIsOfType<sim::SensorType::kBodyVelocity, sim::BodyVelocityConfig> &&
              kIsOfType<sim::SensorType::kDepth, sim::DepthConfig> &&
              kIsOfType<sim::SensorType::kPose, sim::PoseConfig> &&
              kIsOfType<sim::SensorType::kDvl, sim::DvlConfig> &&
              kIsOfType<sim::SensorType::kContacts, sim::ContactSensorConfig> &&
              kIsOfType<sim::SensorType::kTorques, sim::TorqueConfig> &&
              kIsOfType<sim::SensorType::kFootForces, sim::FootForceConfig>);

/// The errors that a sensor of this type has before anything is written.
sim::SensorErrors DefaultErrors(sim::SensorType type);

template <class Archive>
void Describe(Archive& a, SensorConfig& s) {
  sim::SensorType type = sim::TypeOf(s.errors);
  a.Kind("type", type, Choices<sim::SensorType>(), "What it is", Need::kSomewhere);
  if (type != sim::TypeOf(s.errors)) s.errors = DefaultErrors(type);
  a.Field("frame", s.frame, "The URDF link that is the sensor's frame", {}, Need::kSomewhere);
  std::visit([&a](auto& errors) { DescribeErrors(a, errors); }, s.errors);
}

/// The key of the faults that change what a sensor measures.
template <class Archive>
void DescribeChannels(Archive& a, sim::FaultConfig& f) {
  a.Field("channels", f.channels,
          "What it strikes: `gyro` (rad/s) or `accel` (m/s²) of an IMU, `angle` (rad) or `rate` "
          "(rad/s) of encoders, or `all` the sensor measures, each in its own unit; of a pose "
          "sensor that is its position");
}

template <class Archive>
void Describe(Archive& a, sim::FaultConfig& f) {
  using Fault = sim::FaultConfig;
  using Kind = sim::FaultKind;
  a.Field("sensor", f.sensor, "The sensor that it strikes", {}, Need::kHere);
  a.Kind("kind", f.kind, Choices<Kind>(), "What happens", Need::kHere);
  a.Field("at_s", f.at_s, "When it begins", Within(Fault::kStart), Need::kHere);
  a.Field("for_s", f.for_s, "How long it lasts", Within(Fault::kDuration));
  switch (f.kind) {
    case Kind::kBiasStep:
      a.Field("offset", f.magnitude, "Added to every channel, in its own unit",
              Within(Fault::kOffset), Need::kHere);
      return DescribeChannels(a, f);
    case Kind::kScaleStep:
      a.Field("factor", f.magnitude, "Multiplies every channel", Within(Fault::kFactor),
              Need::kHere);
      return DescribeChannels(a, f);
    case Kind::kSaturation:
      a.Field("limit", f.magnitude, "Every channel is clipped at plus and minus this, in its unit",
              Within(Fault::kLimit), Need::kHere);
      return DescribeChannels(a, f);
    case Kind::kExtraDelay:
      return a.Field("delay_s", f.magnitude, "Added to the arrival", Within(Fault::kDelay),
                     Need::kHere);
    case Kind::kTimeJitter:
      return a.Field("std_s", f.magnitude,
                     "Sigma of the error of the time of validity; no message arrives before the "
                     "time that it claims",
                     Within(Fault::kJitter), Need::kHere);
    case Kind::kOutlierBurst:
      a.Field("std", f.magnitude, "Sigma of an outlier, in each channel's unit",
              Within(Fault::kOutlier), Need::kHere);
      return DescribeChannels(a, f);
    case Kind::kNanBurst:
      return DescribeChannels(a, f);
    case Kind::kDropout:
    case Kind::kStuck:
      return;
  }
}

}  // namespace reckon::harness

#pragma once

#include "reckon/harness/describe_choices.h"
#include "reckon/harness/describe_traits.h"

namespace reckon::harness {

/// Overwrites `dvl` with its grade.
void ApplyGrade(sim::DvlConfig& dvl);

template <class Archive>
void DescribeErrors(Archive& a, sim::DvlConfig& e) {
  using Dvl = sim::DvlConfig;
  a.Word("grade", e.grade, DvlGrades(), "Data-sheet numbers; what is written beside it wins");
  if constexpr (!Archive::kWrites) ApplyGrade(e);
  a.Field("rate_hz", e.timing.rate_hz, "Pings a second at most", AboveUpTo(0, 1e3));
  a.Field("rate_by_altitude", e.rate_by_altitude,
          "Rows [up to this altitude m, pings a second]; altitudes rise", AboveUpTo(0, 1e4));
  a.Field("latency_s", e.timing.latency_s, "From the last echo to the arrival", Between(0, 60));
  a.Field("stamp_error_s", e.timing.stamp_error_s,
          "The sensor's clock is off: a sample claims to be valid this much after it was",
          Between(-60, 60));
  a.Field("beam_angle_deg", e.beam_angle_deg, "Of a beam from the vertical",
          Within(Dvl::kBeamAngle));
  a.Field("azimuths_deg", e.azimuths_deg, "Of the beams, from the sensor's x towards its y",
          Between(-360, 360));
  a.Field("min_beams", e.min_beams, "Beams that a velocity needs", Within(Dvl::kMinBeams));
  a.Field("noise_m_per_s", e.noise_m_per_s, "Sigma of one beam's velocity", AboveUpTo(0, 10));
  a.Field("offset_m_per_s", e.offset_m_per_s, "Sigma of each beam's constant offset drawn once",
          Between(0, 10));
  a.Field("scale", e.scale, "Sigma of the scale error drawn once", Between(0, 1));
  a.Field("assumed_sound_speed_m_s", e.assumed_sound_speed_m_s,
          "What it takes the speed of sound to be; 0: what it is", Between(0, 1700));
  a.Field("altitude_min_m", e.altitude_min_m, "Least altitude of what a beam meets",
          Within(Dvl::kAltitude));
  a.Field("altitude_max_m", e.altitude_max_m, "Greatest altitude of what a beam meets",
          Within(Dvl::kAltitude));
  a.Field("max_incidence_deg", e.max_incidence_deg,
          "A beam that meets the ground at more than this from its normal gets no echo",
          Within(Dvl::kIncidence));
  a.Field("max_speed_m_s", e.max_speed_m_s, "Faster than this no beam answers", AboveUpTo(0, 100));
  a.Field("dropout", e.dropout, "Probability that a beam gets no echo", Between(0, 1));
  a.Field("water_track", e.water_track,
          "Without the ground it reports its velocity relative to the water");
  a.Field("water_noise_m_per_s", e.water_noise_m_per_s, "Sigma of one beam's velocity over water",
          Between(0, 10));
  a.Field("water_layer_m", e.water_layer_m, "How far under it that water is", AboveUpTo(0, 1000));
}

}  // namespace reckon::harness

#include "reckon/sim/dvl_grades.h"

#include <string>
#include <vector>

namespace reckon::sim {
namespace {

DvlConfig Named(std::string_view grade, DvlConfig config) {
  config.grade = grade;
  return config;
}

// Offsets: ± 1 mm/s of the horizontal velocity, σ/(√2 sin θ) of a beam's.
DvlConfig A50(std::string_view grade, double scale) {
  return Named(grade, {.timing = {.rate_hz = 15.0, .latency_s = 0.01},
                       .beam_angle_deg = 22.5,
                       .noise_m_per_s = 0.005,
                       .water_noise_m_per_s = 0.015,
                       .offset_m_per_s = 0.00027,
                       .scale = scale,
                       .altitude_min_m = 0.05,
                       .altitude_max_m = 50.0,
                       .max_speed_m_s = 3.75,
                       .rate_by_altitude = {{0.6, 15}, {3, 10}, {14, 5.5}, {36, 7.5}, {50, 3}},
                       .assumed_sound_speed_m_s = 1500.0});
}

DvlConfig Dvl1000() {
  return Named("dvl1000", {.timing = {.rate_hz = 8.0, .latency_s = 0.01},
                           .beam_angle_deg = 25.0,
                           .noise_m_per_s = 0.005,
                           .water_noise_m_per_s = 0.015,
                           .offset_m_per_s = 0.0003,
                           .scale = 0.0005,
                           .altitude_min_m = 0.2,
                           .altitude_max_m = 75.0});
}

DvlConfig Explorer() {
  return Named("explorer", {.timing = {.rate_hz = 12.0, .latency_s = 0.01},
                            .beam_angle_deg = 30.0,
                            .noise_m_per_s = 0.018,
                            .water_noise_m_per_s = 0.048,
                            .altitude_min_m = 0.5,
                            .altitude_max_m = 81.0});
}

DvlConfig Whn() {
  return Named("whn", {.timing = {.rate_hz = 7.0, .latency_s = 0.01},
                       .beam_angle_deg = 30.0,
                       .noise_m_per_s = 0.005,
                       .water_noise_m_per_s = 0.048,
                       .altitude_min_m = 0.7,
                       .altitude_max_m = 90.0});
}

}  // namespace

std::span<const DvlGrade> DvlGrades() {
  static const std::vector<DvlGrade> kGrades{
      {"ideal", {}, "four beams of 30 degrees and 1 mm/s, and no other error"},
      {"a50", A50("a50", 0.0005),
       "Water Linked A50, performance version (0.1 % ± 1 mm/s, 22.5 degrees, rates by altitude); "
       "the noise of a beam is not published and is that of a Nortek DVL1000"},
      {"a50_standard", A50("a50_standard", 0.005), "the same, standard version (1 %)"},
      {"dvl1000", Dvl1000(),
       "Nortek DVL1000; noise as the DAVE simulator models it, long-term accuracy of 0.1 % ± 1 "
       "mm/s of its class"},
      {"explorer", Explorer(), "Teledyne Explorer, as the DAVE simulator models it"},
      {"whn", Whn(),
       "Teledyne Workhorse Navigator, as the DAVE simulator models it; over water the noise of "
       "the Explorer"}};
  return kGrades;
}

const DvlGrade* FindDvlGrade(std::string_view name) {
  for (const DvlGrade& grade : DvlGrades()) {
    if (grade.name == name) return &grade;
  }
  return nullptr;
}

}  // namespace reckon::sim

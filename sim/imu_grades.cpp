#include "reckon/sim/imu_grades.h"

#include <array>
#include <numbers>

namespace reckon::sim {
namespace {

constexpr double kDeg = std::numbers::pi / 180.0;
constexpr double kDegPerHour = kDeg / 3600.0;    // rad/s
constexpr double kDegPerRootHour = kDeg / 60.0;  // rad/√s
constexpr double kPerRootHour = 1.0 / 60.0;      // (m/s)/√h in m/s/√s
constexpr double kG = 9.80665;                   // m/s²
constexpr double kMilliG = 1e-3 * kG;
constexpr double kMicroG = 1e-6 * kG;
constexpr double kSigmaOfAllanMinimum = 1.62;  // σ_B of a Gauss-Markov process, see the header
constexpr double kSigmaOfTolerance = 1.0 / 3.0;
constexpr double kSqrt500 = 22.360679774997898;  // √(τ/2), τ = 1000 s
constexpr double kSqrt150 = 12.24744871391589;   // √(τ/2), τ = 300 s

constexpr ImuGrade kPerfect{
    .name = "perfect", .alias = "", .gyro = {}, .accel = {}, .source = "no errors"};

// Four ranges each; here ±500 °/s at 65.5 LSB/(°/s) and ±4 g at 8192 LSB/g. The accelerometer's
// zero-g tolerance is ±50 mg in x and y and ±80 mg in z: their root mean square, 61.6 mg.
constexpr ImuGrade kConsumer{
    .name = "consumer",
    .alias = "mpu6050",
    .gyro = {.noise_density = 0.005 * kDeg,
             .turn_on_bias = 20.0 * kDeg * kSigmaOfTolerance,
             .scale = 0.03 * kSigmaOfTolerance,
             .misalignment = 0.02 * kSigmaOfTolerance,
             .g_sensitivity = 0.1 * kDeg / kG,
             .range = 500.0 * kDeg,
             .resolution = kDeg / 65.5},
    .accel = {.noise_density = 400.0 * kMicroG,
              .turn_on_bias = 61.6 * kMilliG * kSigmaOfTolerance,
              .scale = 0.03 * kSigmaOfTolerance,
              .misalignment = 0.02 * kSigmaOfTolerance,
              .range = 4.0 * kG,
              .resolution = kG / 8192.0},
    .source =
        "MPU-6050 data sheet, PS-MPU-6000A r3.4; ranges 500 deg/s and 4 g chosen; zero-rate, "
        "zero-g, scale and cross-axis tolerances as 3 sigma"};

// In-run bias 5 to 7 °/h: the upper end. User-calibrated: no turn-on bias.
constexpr ImuGrade kVn100{
    .name = "vn100",
    .alias = "",
    .gyro = {.noise_density = 0.0035 * kDeg,
             .bias_instability = 7.0 * kDegPerHour * kSigmaOfAllanMinimum,
             .range = 2000.0 * kDeg},
    .accel = {.noise_density = 0.14 * kMilliG,
              .bias_instability = 0.04 * kMilliG * kSigmaOfAllanMinimum,
              .range = 16.0 * kG},
    .source =
        "VN-100, secondary sources; bias instability as the Allan minimum, time constant "
        "assumed 300 s"};

// Sources give 20 to 80 µg/√Hz for the accelerometer: the upper end.
constexpr ImuGrade kGx5{
    .name = "3dm_gx5_25",
    .alias = "",
    .gyro = {.noise_density = 0.005 * kDeg,
             .bias_instability = 8.0 * kDegPerHour * kSigmaOfAllanMinimum,
             .range = 300.0 * kDeg},
    .accel = {.noise_density = 80.0 * kMicroG,
              .bias_instability = 0.04 * kMilliG * kSigmaOfAllanMinimum,
              .range = 8.0 * kG},
    .source =
        "3DM-GX5-25, secondary sources, which disagree on the accelerometer's noise; bias "
        "instability as the Allan minimum, time constant assumed 300 s"};

constexpr ImuGrade kTactical{
    .name = "tactical",
    .alias = "gnss_ins_sim_high",
    .gyro = {.noise_density = 0.002 * kDegPerRootHour,
             .bias_instability = 0.1 * kDegPerHour,
             .bias_time_constant_s = 100.0},
    .accel = {.noise_density = 2.5e-5 * kPerRootHour,
              .bias_instability = 3.6e-6,
              .bias_time_constant_s = 100.0},
    .source = "gnss-ins-sim, high accuracy; bias instability is the sigma of the process"};

constexpr ImuGrade kMid{
    .name = "gnss_ins_sim_mid",
    .alias = "",
    .gyro = {.noise_density = 0.25 * kDegPerRootHour,
             .bias_instability = 3.5 * kDegPerHour,
             .bias_time_constant_s = 100.0},
    .accel = {.noise_density = 0.03 * kPerRootHour,
              .bias_instability = 5e-5,
              .bias_time_constant_s = 100.0},
    .source = "gnss-ins-sim, medium accuracy; bias instability is the sigma of the process"};

constexpr ImuGrade kLow{
    .name = "gnss_ins_sim_low",
    .alias = "",
    .gyro = {.noise_density = 0.75 * kDegPerRootHour,
             .bias_instability = 10.0 * kDegPerHour,
             .bias_time_constant_s = 100.0},
    .accel = {.noise_density = 0.05 * kPerRootHour,
              .bias_instability = 2e-4,
              .bias_time_constant_s = 100.0},
    .source = "gnss-ins-sim, low accuracy; bias instability is the sigma of the process"};

constexpr ImuGrade kAdis{.name = "adis16448",
                         .alias = "",
                         .gyro = {.noise_density = 0.0135 * kDeg},
                         .accel = {.noise_density = 0.23 * kMilliG},
                         .source = "ADIS16448, noise as in kalibr's discussion of its data sheet"};

constexpr ImuGrade kAdisRotors{
    .name = "adis16448_rotors",
    .alias = "",
    .gyro = {.noise_density = 3.394e-4,
             .bias_instability = 3.8785e-5 * kSqrt500,
             .bias_time_constant_s = 1000.0,
             .turn_on_bias = 0.0087},
    .accel = {.noise_density = 4e-3,
              .bias_instability = 6e-3 * kSqrt150,
              .bias_time_constant_s = 300.0,
              .turn_on_bias = 0.196},
    .source =
        "defaults of the RotorS and uuv simulators for the ADIS16448; they give the density "
        "that drives the Gauss-Markov bias"};

constexpr ImuGrade kMti1{
    .name = "mti_1",
    .alias = "",
    .gyro = {.noise_density = 0.007 * kDeg,
             .bias_instability = 10.0 * kDegPerHour * kSigmaOfAllanMinimum},
    .accel = {.noise_density = 120.0 * kMicroG,
              .bias_instability = 0.03 * kMilliG * kSigmaOfAllanMinimum},
    .source =
        "Xsens MTi-1, secondary sources; bias instability as the Allan minimum, time constant "
        "assumed 300 s"};

constexpr std::array kGrades{kPerfect, kConsumer, kVn100, kGx5,        kTactical,
                             kMid,     kLow,      kAdis,  kAdisRotors, kMti1};

void AddBlanks(const std::string& triad, const TriadErrors& errors, bool is_gyro,
               std::vector<std::string>& blank) {
  const auto add = [&](const char* field, double value) {
    if (value == 0.0) blank.push_back(triad + "." + field);
  };
  add("noise_density", errors.noise_density);
  add("bias_walk", errors.bias_walk);
  add("bias_instability", errors.bias_instability);
  add("turn_on_bias", errors.turn_on_bias);
  add("scale", errors.scale);
  add("misalignment", errors.misalignment);
  if (is_gyro) add("g_sensitivity", errors.g_sensitivity);
  add("range", errors.range);
  add("resolution", errors.resolution);
}

}  // namespace

std::span<const ImuGrade> ImuGrades() { return kGrades; }

const ImuGrade* FindImuGrade(std::string_view name) {
  if (name.empty()) return nullptr;
  for (const ImuGrade& grade : kGrades) {
    if (grade.name == name || grade.alias == name) return &grade;
  }
  return nullptr;
}

std::vector<std::string> BlankFields(const ImuGrade& grade) {
  std::vector<std::string> blank;
  AddBlanks("gyro", grade.gyro, true, blank);
  AddBlanks("accel", grade.accel, false, blank);
  return blank;
}

}  // namespace reckon::sim

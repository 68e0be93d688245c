// Mutated scenarios: whatever comes in, a reader answers with a scenario or with an InputError.

#include <gtest/gtest.h>

#include <chrono>
#include <random>

#include "reckon/harness/robot_file.h"
#include "reckon/harness/yaml_reader.h"
#include "reckon/harness/yaml_writer.h"

namespace reckon::harness {
namespace {

const std::vector<std::string>& Seeds() {
  static const std::vector<std::string> kSeeds{
      "schema: 1\ndescription: grass\nrobot: husky\nduration_s: 60\nseed: 1\n"
      "world:\n  terrain: {kind: rough, rms_m: 0.02, shortest_wave_m: 0.6, friction: 0.8}\n"
      "  patches: [{box_m: [3, 0, 2, 2], friction: 0.15}]\n"
      "motion: {path: square, side_m: 10, laps: 2, speed_m_s: 0.8}\n"
      "actual: {wheel_radius_scale: [1.01, 0.99], imu_rotation_deg: [0, 2, 0]}\n",
      "sensors:\n  imu: {grade: vn100, rate_hz: 200, mode: increment, gyro: {scale: 1e-3}}\n"
      "  wheels: off\n  v: {type: body_velocity, frame: velocity_link, noise_m_per_s: [1, 1, 1]}\n"
      "faults:\n  - {sensor: imu, kind: dropout, at_s: 20, for_s: 0.5}\n"
      "  - {sensor: v, kind: time_jitter, at_s: 2, std_s: 0.01}\n",
      "sensors:\n  d: {type: depth, frame: base_link, noise_m: 0.1}\n"
      "  p: {type: pose, frame: base_link, orientation: true, noise_position_m: [1, 1, 2]}\n"
      "estimators:\n  it: {type: iterated_inekf, iterations: 3, history_s: 1, noise: matched,\n"
      "    gyro_filter: {source: ''}, standstill: {use: false}, initialisation: {kind: pose}}\n",
      "estimators:\n  riekf: {type: inekf, error: right, gate: {action: inflate}}\n"
      "  mekf: &m {type: mekf, noise: matched, initialisation: {kind: static}}\n  other: *m\n"
      "  tuned: {noise: {gyro_noise_density_rad_per_s_sqrt_hz: 6.1e-5}, sensors: [imu, wheels]}\n"
      "  mine: {type: process, command: [python3, \"my \\\"filter\\\".py\"]}\n"
      "score: {align: first_pose, rpe_m: [1, 10]}\n"
      "expect:\n  riekf: {ate_position_rmse_m: {max: 0.30}, consistency: {false_alarm: 1.0e-6}}\n"
      "  compare: [riekf.ate_position_rmse_m < 0.8 * mekf.ate_position_rmse_m]\n",
      "motion:\n  path: velocity_profile\n  profile:\n    - [0, 0.5, 0]\n    - [5, 0.5, 0.3]\n"
      "drive: {left_joints: [front_left_wheel, rear_left_wheel]}\n"
      "nominal: {wheels: {rolling_radius_m: 0.16}, noise: {wheel_forward_m_per_s: 0.1}}\n"
      "record: {truth: true, truth_rate_hz: 100}\ninitial: {sigma: {yaw_rad: 0.1}}\n"};
  return kSeeds;
}

/// Pieces that parsers stumble over.
const std::vector<std::string>& Tokens() {
  static const std::vector<std::string> kTokens{".nan",
                                                "-.inf",
                                                "1e999",
                                                "-1",
                                                "0",
                                                "1e-300",
                                                "~",
                                                "null",
                                                "off",
                                                "[]",
                                                "{}",
                                                "[",
                                                "{",
                                                "]",
                                                "}",
                                                ": ",
                                                "\n",
                                                "  ",
                                                "\t",
                                                "- ",
                                                "? ",
                                                "&m ",
                                                "*m",
                                                "!!int",
                                                "<<: ",
                                                "---\n",
                                                "...\n",
                                                "|\n",
                                                ">\n",
                                                "\"",
                                                "'",
                                                "\\",
                                                "#",
                                                "%",
                                                "@",
                                                "\xef\xbb\xbf",
                                                "\xff",
                                                "\x04",
                                                "husky",
                                                "imu",
                                                "kind",
                                                "type",
                                                "include: sc.yaml\n",
                                                "99999999999999999999",
                                                "0x10",
                                                "seed",
                                                "inekf",
                                                "robot_defaults: false\n",
                                                "\r\n",
                                                ",",
                                                "\xc3\xa9"};
  return kTokens;
}

class Mutator {
 public:
  explicit Mutator(unsigned seed) : engine_(seed) {}

  std::string Mutate() {
    std::string text = Seeds()[Below(Seeds().size())];
    const std::size_t times = Below(2) == 0 ? 1 : 1 + Below(4);
    for (std::size_t i = 0; i < times; ++i) MutateOnce(text);
    return text;
  }

 private:
  /// Not std::uniform_int_distribution: its draws differ between standard libraries.
  std::size_t Below(std::size_t n) { return n == 0 ? 0 : engine_() % n; }

  void MutateOnce(std::string& text) {
    const std::size_t at = Below(text.size());
    const std::size_t length = std::min(1 + Below(20), text.size() - at);
    switch (Below(8)) {
      case 0:
        if (!text.empty()) text[at] = static_cast<char>(text[at] ^ (1U << Below(8)));
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(at, length));
        break;
      case 3:
        text.insert(at, Tokens()[Below(Tokens().size())]);
        break;
      case 4:
        text.replace(at, length, Tokens()[Below(Tokens().size())]);
        break;
      case 5:
      case 6: {  // another number
        const std::size_t digit = text.find_first_of("0123456789", at);
        if (digit != text.npos) text[digit] = static_cast<char>('0' + Below(10));
        break;
      }
      default: {  // a piece of another scenario
        const std::string& other = Seeds()[Below(Seeds().size())];
        text.insert(at, other.substr(Below(other.size()), 40));
      }
    }
  }

  std::mt19937 engine_;
};

TEST(FuzzScenario, StartsFromGoodScenarios) {
  for (const std::string& text : Seeds())
    EXPECT_NO_THROW(ReadScenarioText(text, "sc.yaml")) << text;
}

TEST(FuzzScenario, OnlyInputErrorsComeOut) {
  Mutator mutator(20240607);
  const auto start = std::chrono::steady_clock::now();
  int refused = 0, read = 0;
  for (int i = 0; i < 4000; ++i) {
    // At least so many on any machine, then for two seconds.
    const auto spent = std::chrono::steady_clock::now() - start;
    if (i >= 400 && spent > std::chrono::seconds(2)) break;
    const std::string text = mutator.Mutate();
    SCOPED_TRACE(text);
    try {
      const Scenario scenario = ReadScenarioText(text, "sc.yaml");
      ++read;
      const std::string resolved = WriteScenario(scenario);
      ASSERT_EQ(WriteScenario(ReadScenarioText(resolved, "resolved.yaml")), resolved);
      LoadRobot(scenario);
    } catch (const InputError& error) {
      ++refused;
      ASSERT_NE(std::string(error.what()).find(": error: "), std::string::npos);
    } catch (const std::exception& error) {
      FAIL() << "not an InputError: " << error.what();
    }
  }
  // Both ends were reached: the mutations are neither harmless nor hopeless.
  EXPECT_GT(refused, 200);
  EXPECT_GT(read, 20);
}

TEST(FuzzScenario, OverridesToo) {
  Mutator mutator(7);
  int refused = 0;
  for (int i = 0; i < 200; ++i) {
    std::string text = mutator.Mutate().substr(0, 30);
    std::replace(text.begin(), text.end(), ':', '=');
    SCOPED_TRACE(text);
    try {
      ReadScenarioText("seed: 1\n", "sc.yaml", {text});
    } catch (const InputError&) {
      ++refused;
    } catch (const std::exception& error) {
      FAIL() << "not an InputError: " << error.what();
    }
  }
  EXPECT_GT(refused, 20);
}

}  // namespace
}  // namespace reckon::harness

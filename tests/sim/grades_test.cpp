#include <algorithm>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "reckon/sim/imu_grades.h"

namespace reckon::sim {
namespace {

const ImuGrade& Grade(const char* name) {
  const ImuGrade* grade = FindImuGrade(name);
  EXPECT_NE(grade, nullptr) << name;
  return *grade;
}

// The SI values that the data sheets' tables give beside their own units, to their printed digits.
TEST(ImuGrades, ConvertToTheTabulatedUnits) {
  EXPECT_NEAR(Grade("consumer").gyro.noise_density, 8.73e-5, 0.005e-5);
  EXPECT_NEAR(Grade("consumer").accel.noise_density, 3.92e-3, 0.005e-3);
  EXPECT_NEAR(Grade("vn100").gyro.noise_density, 6.109e-5, 0.0005e-5);
  EXPECT_NEAR(Grade("vn100").accel.noise_density, 1.373e-3, 0.0005e-3);
  EXPECT_NEAR(Grade("3dm_gx5_25").gyro.noise_density, 8.73e-5, 0.005e-5);
  EXPECT_NEAR(Grade("tactical").gyro.noise_density, 5.8e-7, 0.05e-7);
  EXPECT_NEAR(Grade("tactical").accel.noise_density, 4.2e-7, 0.05e-7);
  // ADIS16448: 0.0135 °/s/√Hz is an angle random walk of 0.66 °/√h for its simulators' 0.011; by
  // definition 60 · 0.0135 = 0.81 °/√h. The density is what is taken.
  EXPECT_NEAR(Grade("adis16448").gyro.noise_density, 0.81 * 2.909e-4, 1e-7);
  EXPECT_NEAR(Grade("gnss_ins_sim_low").gyro.noise_density, 0.75 * 2.909e-4, 1e-7);
}

// An Allan minimum of x is the peak 0.618 σ_B of a Gauss-Markov process: 7 °/h = 3.394e-5 rad/s.
TEST(ImuGrades, BiasInstabilityIsTheSigmaOfTheProcess) {
  EXPECT_NEAR(0.618 * Grade("vn100").gyro.bias_instability, 3.394e-5, 0.005e-5);
  EXPECT_NEAR(0.618 * Grade("vn100").accel.bias_instability, 0.04e-3 * 9.807, 1e-6);
  EXPECT_NEAR(Grade("tactical").gyro.bias_instability, 4.848e-7, 0.001e-7);  // σ itself: 0.1 °/h
  // Driven by a density: σ_B² = σ_bc² τ/2.
  const TriadErrors& rotors = Grade("adis16448_rotors").gyro;
  EXPECT_NEAR(rotors.bias_instability * rotors.bias_instability, 3.8785e-5 * 3.8785e-5 * 500.0,
              1e-15);
}

TEST(ImuGrades, PerfectHasNoErrorAtAll) {
  const ImuGrade& perfect = Grade("perfect");
  EXPECT_EQ(BlankFields(perfect).size(), 17U);  // nine of the gyroscope, eight of the accelerometer
}

TEST(ImuGrades, BlanksAreNamed) {
  const auto blank = BlankFields(Grade("consumer"));
  EXPECT_NE(std::find(blank.begin(), blank.end(), "gyro.bias_instability"), blank.end());
  EXPECT_EQ(std::find(blank.begin(), blank.end(), "gyro.noise_density"), blank.end());
  EXPECT_EQ(std::find(blank.begin(), blank.end(), "accel.g_sensitivity"), blank.end());
}

TEST(ImuGrades, NamesAreUniqueAndAliasesFindTheSameGrade) {
  std::set<std::string> names;
  for (const ImuGrade& grade : ImuGrades()) {
    EXPECT_TRUE(names.emplace(grade.name).second) << grade.name;
    if (!grade.alias.empty()) {
      EXPECT_TRUE(names.emplace(grade.alias).second) << grade.alias;
    }
    EXPECT_FALSE(grade.source.empty());
    EXPECT_EQ(FindImuGrade(grade.name), &grade);
  }
  EXPECT_EQ(FindImuGrade("mpu6050"), FindImuGrade("consumer"));
  EXPECT_EQ(FindImuGrade("no such grade"), nullptr);
  EXPECT_EQ(FindImuGrade(""), nullptr);
}

}  // namespace
}  // namespace reckon::sim

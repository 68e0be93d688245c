#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace reckon::harness::testing {

inline void WriteFile(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path) << text;
}

/// A log of a robot that stands: 0.1 s of an IMU at 100 Hz, a depth sensor 2 m below the body that
/// reads 7 m late by 20 ms, and truth.
inline void WriteStandingLog(const std::filesystem::path& folder, const std::string& more = "") {
  WriteFile(folder / "log.yaml", R"(
description: It stands
sensors:
  imu: {type: imu, file: imu.csv, rate_hz: 100}
  depth: {type: depth, file: depth.csv, rate_hz: 50, position_m: [0, 0, -2], latency_s: 0.02}
nominal: {noise: {depth_m: 0.1, gyro_noise_density_rad_per_s_sqrt_hz: 1.0e-3,
                  accel_noise_density_m_per_s2_sqrt_hz: 1.0e-2}}
truth: truth.csv
)" + more);
  std::string imu =
      "t_s,gyro_x_rad_s,gyro_y_rad_s,gyro_z_rad_s,accel_x_m_s2,accel_y_m_s2,accel_z_m_s2\n";
  std::string depth = "t_ns, depth_m\n";
  std::string truth = "t_s,p_x_m,p_y_m,p_z_m,q_w,q_x,q_y,q_z,v_x_m_s,v_y_m_s,v_z_m_s\n";
  for (int k = 0; k <= 10; ++k) {
    const std::string t = "100." + std::string(k < 10 ? "0" : "") + std::to_string(k);
    imu += t + ",0,0,0,0,0,9.81\n";
    truth += t + ",1,2,-5,1,0,0,0,0,0,0\n";
    if (k % 2 == 0) depth += std::to_string(100'000'000'000 + k * 10'000'000) + ", 7\n";
  }
  WriteFile(folder / "imu.csv", imu);
  WriteFile(folder / "depth.csv", "# a comment\n\n" + depth);
  WriteFile(folder / "truth.csv", truth);
}

}  // namespace reckon::harness::testing

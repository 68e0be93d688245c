#include "reckon/estimator/setup.h"

#include <array>

namespace reckon::estimator {
namespace {

constexpr std::array<NoiseField, 20> kFields{{
    {"gyro_noise_density_rad_per_s_sqrt_hz", &Noise::gyro_noise_density_rad_per_s_sqrt_hz},
    {"accel_noise_density_m_per_s2_sqrt_hz", &Noise::accel_noise_density_m_per_s2_sqrt_hz},
    {"gyro_bias_walk_rad_per_s2_sqrt_hz", &Noise::gyro_bias_walk_rad_per_s2_sqrt_hz},
    {"accel_bias_walk_m_per_s3_sqrt_hz", &Noise::accel_bias_walk_m_per_s3_sqrt_hz},
    {"wheel_forward_m_per_s", &Noise::wheel_forward_m_per_s},
    {"wheel_lateral_m_per_s", &Noise::wheel_lateral_m_per_s},
    {"wheel_vertical_m_per_s", &Noise::wheel_vertical_m_per_s},
    {"body_velocity_scale", &Noise::body_velocity_scale},
    {"pose_scale", &Noise::pose_scale},
    {"depth_m", &Noise::depth_m},
    {"joint_angle_rad", &Noise::joint_angle_rad},
    {"foot_position_m", &Noise::foot_position_m},
    {"foot_slip_m_per_s_sqrt_hz", &Noise::foot_slip_m_per_s_sqrt_hz},
    {"joint_rate_rad_per_s", &Noise::joint_rate_rad_per_s},
    {"leg_velocity_m_per_s", &Noise::leg_velocity_m_per_s},
    {"wheel_yaw_rate_rad_per_s", &Noise::wheel_yaw_rate_rad_per_s},
    {"standstill_m_per_s", &Noise::standstill_m_per_s},
    {"standstill_rad_per_s", &Noise::standstill_rad_per_s},
    {"floor_height_m", &Noise::floor_height_m},
    {"water_current_m_per_s", &Noise::water_current_m_per_s},
}};

}  // namespace

std::span<const NoiseField> NoiseFields() { return kFields; }

}  // namespace reckon::estimator

#include "reckon/estimator/second_rate.h"

#include "reckon/estimator/wheel_model.h"

namespace reckon::estimator {

SecondRate ReadSecondRate(const models::Measurement& m, const FilterBeliefs& beliefs) {
  SecondRate rate;
  if (const auto* imu = std::get_if<models::ImuSample>(&m.sample)) {
    rate.w = beliefs.X_IS[m.sensor].R * imu->gyro_rad_s;
    rate.variance = beliefs.noise.gyro / models::Seconds(imu->interval_ns);
    return rate;
  }
  const models::WheelDrive& wheels = *beliefs.setup.suite.wheels;
  rate.w.z() = WheelYawRate(*MeanRates(std::get<models::EncoderSample>(m.sample), wheels), wheels);
  const double sigma = beliefs.setup.noise.wheel_yaw_rate_rad_per_s;
  rate.variance = sigma * sigma;
  rate.first = 2;
  rate.from_imu = false;
  return rate;
}

}  // namespace reckon::estimator

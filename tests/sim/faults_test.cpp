#include "reckon/sim/faults.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "reckon/estimator/sample_checks.h"
#include "sim/statistics.h"

namespace reckon::sim {
namespace {

using models::BodyVelocitySample;
using models::EncoderSample;
using models::ImuSample;
using models::Measurement;
using models::TimeNs;

constexpr TimeNs kMs = 1'000'000;

/// IMU message number n of 100 Hz: gyro n, accel −n on every axis, 2 ms of latency.
Measurement ImuMessage(int n) {
  ImuSample sample;
  sample.gyro_rad_s.setConstant(n);
  sample.accel_m_s2.setConstant(-n);
  sample.interval_ns = 10 * kMs;
  return {0, (n + 1) * 10 * kMs, (n + 1) * 10 * kMs + 2 * kMs, sample};
}

const ImuSample& Imu(const Measurement& m) { return std::get<ImuSample>(m.sample); }

FaultConfig Fault(FaultKind kind, double magnitude = 0.0) {
  return {.sensor = "imu", .kind = kind, .at_s = 1.0, .for_s = 0.5, .magnitude = magnitude};
}

/// Three seconds of messages through the faults.
std::vector<Measurement> Pass(const std::vector<FaultConfig>& schedule, int count = 300,
                              std::uint64_t seed = 1) {
  FaultInjector faults("imu", schedule, seed);
  std::vector<Measurement> out;
  for (int n = 0; n < count; ++n) {
    Measurement message = ImuMessage(n);
    if (faults.Apply(message)) out.push_back(message);
  }
  return out;
}

/// Message n is valid at (n + 1)/100 s; those with 99 ≤ n < 149 lie in [1, 1.5) s.
bool InFault(int n) { return n >= 99 && n < 149; }

/// Checks that each message is `expected(n)` within the fault and untouched outside.
template <typename Expected>
void ExpectWithin(const FaultConfig& fault, const Expected& expected) {
  const auto out = Pass({fault});
  ASSERT_EQ(out.size(), 300U);
  for (int n = 0; n < 300; ++n) {
    Measurement m = ImuMessage(n);
    if (InFault(n)) expected(m, n);
    const Measurement& found = out[static_cast<std::size_t>(n)];
    EXPECT_EQ(found.valid_ns, m.valid_ns) << n;
    EXPECT_EQ(found.arrival_ns, m.arrival_ns) << n;
    EXPECT_EQ(Imu(found).gyro_rad_s, Imu(m).gyro_rad_s) << n;
    EXPECT_EQ(Imu(found).accel_m_s2, Imu(m).accel_m_s2) << n;
    EXPECT_EQ(Imu(found).gyro_saturated, Imu(m).gyro_saturated) << n;
    EXPECT_EQ(Imu(found).accel_saturated, Imu(m).accel_saturated) << n;
  }
}

ImuSample& Edit(Measurement& m) { return std::get<ImuSample>(m.sample); }

TEST(Faults, DropoutSendsNothing) {
  const auto out = Pass({Fault(FaultKind::kDropout)});
  ASSERT_EQ(out.size(), 250U);
  EXPECT_EQ(out[98].valid_ns, 990 * kMs);
  EXPECT_EQ(out[99].valid_ns, 1500 * kMs);
}

TEST(Faults, StuckRepeatsTheLastGoodSampleWithFreshStamps) {
  ExpectWithin(Fault(FaultKind::kStuck),
               [](Measurement& m, int) { m.sample = ImuMessage(98).sample; });
}

TEST(Faults, StuckFromTheStartRepeatsTheFirstSample) {
  FaultConfig fault = Fault(FaultKind::kStuck);
  fault.at_s = 0.0;
  const auto out = Pass({fault});
  EXPECT_EQ(Imu(out[30]).gyro_rad_s.x(), 0.0);
  EXPECT_EQ(Imu(out[60]).gyro_rad_s.x(), 60.0);
}

TEST(Faults, BiasStepAdds) {
  ExpectWithin(Fault(FaultKind::kBiasStep, 0.25), [](Measurement& m, int) {
    Edit(m).gyro_rad_s.array() += 0.25;
    Edit(m).accel_m_s2.array() += 0.25;
  });
}

TEST(Faults, ScaleStepMultiplies) {
  ExpectWithin(Fault(FaultKind::kScaleStep, 1.5), [](Measurement& m, int) {
    Edit(m).gyro_rad_s *= 1.5;
    Edit(m).accel_m_s2 *= 1.5;
  });
}

TEST(Faults, SaturationClipsAndFlags) {
  ExpectWithin(Fault(FaultKind::kSaturation, 120.0), [](Measurement& m, int n) {
    if (n <= 120) return;
    Edit(m).gyro_rad_s.setConstant(120.0);
    Edit(m).accel_m_s2.setConstant(-120.0);
    Edit(m).gyro_saturated = Edit(m).accel_saturated = true;
  });
}

TEST(Faults, ExtraDelayMovesArrivalsOnlyAndCanReorderThem) {
  ExpectWithin(Fault(FaultKind::kExtraDelay, 0.035),
               [](Measurement& m, int) { m.arrival_ns += 35 * kMs; });
  const auto out = Pass({Fault(FaultKind::kExtraDelay, 0.035)});
  EXPECT_GT(out[148].arrival_ns, out[149].arrival_ns);
}

TEST(Faults, NanBurstFillsEveryChannel) {
  const auto out = Pass({Fault(FaultKind::kNanBurst)});
  ASSERT_EQ(out.size(), 300U);
  for (int n = 0; n < 300; ++n) {
    const ImuSample& sample = Imu(out[static_cast<std::size_t>(n)]);
    EXPECT_EQ(sample.gyro_rad_s.array().isNaN().all(), InFault(n)) << n;
    EXPECT_EQ(sample.accel_m_s2.array().isNaN().all(), InFault(n)) << n;
    EXPECT_EQ(sample.interval_ns, 10 * kMs);
  }
}

TEST(Faults, TimeJitterMisreportsValidityAndKeepsItIncreasing) {
  FaultConfig fault = Fault(FaultKind::kTimeJitter, 0.001);
  fault.for_s = 1000.0;
  const auto out = Pass({fault}, 100'000);
  std::vector<double> error;
  for (int n = 99; n < 100'000; ++n) {
    const Measurement& m = out[static_cast<std::size_t>(n)];
    EXPECT_EQ(m.arrival_ns, std::max(ImuMessage(n).arrival_ns, m.valid_ns));
    error.push_back(models::Seconds(m.valid_ns - ImuMessage(n).valid_ns));
  }
  // Ten milliseconds between samples: 1 ms of jitter never touches the order.
  EXPECT_NEAR(testing_sim::Mean(error), 0.0, testing_sim::MeanBand(1e-3, error.size()));
  EXPECT_NEAR(testing_sim::Variance(error), 1e-6, testing_sim::VarianceBand(1e-3, error.size()));

  const auto wild = Pass({Fault(FaultKind::kTimeJitter, 0.1)});
  for (std::size_t n = 1; n < wild.size(); ++n) ASSERT_GT(wild[n].valid_ns, wild[n - 1].valid_ns);
  EXPECT_EQ(wild[50].valid_ns, ImuMessage(50).valid_ns);
  EXPECT_EQ(wild[299].valid_ns, ImuMessage(299).valid_ns);
}

TEST(Faults, JitteredMessagesOfASensorWithoutLatencyAreNoneOfTheFuture) {
  models::Suite suite;
  suite.sensors.push_back({"imu", models::SensorKind::kImu, {}, 10 * kMs});
  FaultInjector faults("imu", std::vector{Fault(FaultKind::kTimeJitter, 0.003)}, 1);
  int late = 0;
  for (int n = 0; n < 300; ++n) {
    Measurement m = ImuMessage(n);
    m.arrival_ns = m.valid_ns;
    ASSERT_TRUE(faults.Apply(m));
    EXPECT_LE(m.valid_ns, m.arrival_ns) << n;
    EXPECT_EQ(estimator::WhatIsWrong(m, suite), estimator::Refusal::kNone) << n;
    if (m.arrival_ns > ImuMessage(n).valid_ns) ++late;
  }
  // Half of the fifty that are jittered claim a later time: 25 ± 3.5 of a binomial, five sigma.
  EXPECT_NEAR(late, 25, 18);
}

TEST(Faults, StrikeTheChosenChannelsOfAnImu) {
  FaultConfig fault = Fault(FaultKind::kBiasStep, 0.25);
  fault.channels = FaultChannels::kGyro;
  ExpectWithin(fault, [](Measurement& m, int) { Edit(m).gyro_rad_s.array() += 0.25; });
  fault.channels = FaultChannels::kAccel;
  ExpectWithin(fault, [](Measurement& m, int) { Edit(m).accel_m_s2.array() += 0.25; });
  fault = Fault(FaultKind::kScaleStep, 1.5);
  fault.channels = FaultChannels::kAccel;
  ExpectWithin(fault, [](Measurement& m, int) { Edit(m).accel_m_s2 *= 1.5; });
}

TEST(Faults, SaturateTheChosenChannelsAndFlagThemAlone) {
  FaultConfig fault = Fault(FaultKind::kSaturation, 120.0);
  fault.channels = FaultChannels::kGyro;
  ExpectWithin(fault, [](Measurement& m, int n) {
    if (n <= 120) return;
    Edit(m).gyro_rad_s.setConstant(120.0);
    Edit(m).gyro_saturated = true;
  });
  fault.channels = FaultChannels::kAccel;
  ExpectWithin(fault, [](Measurement& m, int n) {
    if (n <= 120) return;
    Edit(m).accel_m_s2.setConstant(-120.0);
    Edit(m).accel_saturated = true;
  });
}

TEST(Faults, OutliersOfChosenChannelsAreThoseOfAllChannels) {
  FaultConfig fault = Fault(FaultKind::kOutlierBurst, 5.0);
  const auto all = Pass({fault});
  fault.channels = FaultChannels::kAccel;
  const auto accel = Pass({fault});
  int hit = 0;
  for (int n = 0; n < 300; ++n) {
    const auto i = static_cast<std::size_t>(n);
    EXPECT_EQ(Imu(accel[i]).gyro_rad_s, Imu(ImuMessage(n)).gyro_rad_s) << n;
    EXPECT_EQ(Imu(accel[i]).accel_m_s2, Imu(all[i]).accel_m_s2) << n;
    if (Imu(accel[i]).accel_m_s2 != Imu(ImuMessage(n)).accel_m_s2) ++hit;
  }
  EXPECT_GT(hit, 0);
}

TEST(Faults, StrikeTheChosenChannelsOfEncoders) {
  EncoderSample encoders;
  encoders.angle_rad.setConstant(4, 2.0);
  encoders.rate_rad_s.setConstant(4, 3.0);
  for (const bool angle : {true, false}) {
    FaultConfig fault = Fault(FaultKind::kBiasStep, 0.5);
    fault.channels = angle ? FaultChannels::kAngle : FaultChannels::kRate;
    FaultInjector faults("imu", std::vector{fault}, 1);
    Measurement m{0, 1100 * kMs, 1100 * kMs, encoders};
    ASSERT_TRUE(faults.Apply(m));
    const auto& found = std::get<EncoderSample>(m.sample);
    EXPECT_EQ(found.angle_rad, models::EncoderVector::Constant(4, angle ? 2.5 : 2.0));
    EXPECT_EQ(found.rate_rad_s, models::EncoderVector::Constant(4, angle ? 3.0 : 3.5));
  }
}

TEST(Faults, OutlierBurstHitsThreeSamplesInTen) {
  FaultConfig fault = Fault(FaultKind::kOutlierBurst, 5.0);
  fault.for_s = 1000.0;
  const int count = 100'000;
  const auto out = Pass({fault}, count);
  std::vector<double> size, size_accel;
  for (int n = 99; n < count; ++n) {
    const ImuSample& found = Imu(out[static_cast<std::size_t>(n)]);
    if (found.gyro_rad_s.x() == n) {
      EXPECT_EQ(found.accel_m_s2, Imu(ImuMessage(n)).accel_m_s2);
      continue;
    }
    size.push_back(found.gyro_rad_s.x() - n);
    size_accel.push_back(found.accel_m_s2.x() + n);
  }
  const double trials = count - 99;
  EXPECT_NEAR(static_cast<double>(size.size()), 0.3 * trials, 5.0 * std::sqrt(0.21 * trials));
  EXPECT_NEAR(testing_sim::Variance(size), 25.0, testing_sim::VarianceBand(5.0, size.size()));
  EXPECT_NEAR(testing_sim::Mean(size), 0.0, testing_sim::MeanBand(5.0, size.size()));
  EXPECT_LT(std::abs(testing_sim::Correlation(size, size_accel)),
            testing_sim::CorrelationBand(size.size()));
}

TEST(Faults, ActOnEncodersAndBodyVelocity) {
  EncoderSample encoders;
  encoders.angle_rad.setConstant(4, 2.0);
  encoders.rate_rad_s.setConstant(4, 3.0);
  BodyVelocitySample velocity;
  velocity.v_WS_S.setConstant(1.0);
  FaultInjector faults("imu", std::vector{Fault(FaultKind::kBiasStep, 0.5)}, 1);
  Measurement m{0, 1100 * kMs, 1100 * kMs, encoders};
  ASSERT_TRUE(faults.Apply(m));
  EXPECT_EQ(std::get<EncoderSample>(m.sample).angle_rad, models::EncoderVector::Constant(4, 2.5));
  EXPECT_EQ(std::get<EncoderSample>(m.sample).rate_rad_s, models::EncoderVector::Constant(4, 3.5));
  m = {0, 1200 * kMs, 1200 * kMs, velocity};
  ASSERT_TRUE(faults.Apply(m));
  EXPECT_EQ(std::get<BodyVelocitySample>(m.sample).v_WS_S, Eigen::Vector3d::Constant(1.5));
}

TEST(Faults, ActOnDepthAndOnThePositionOfAPose) {
  const auto after = [](FaultKind kind, double magnitude, const models::Sample& sample) {
    FaultInjector faults("imu", std::vector{Fault(kind, magnitude)}, 1);
    Measurement m{0, 1100 * kMs, 1100 * kMs, sample};
    EXPECT_TRUE(faults.Apply(m));
    return m.sample;
  };
  const auto depth = [&](FaultKind kind, double magnitude) {
    return std::get<models::DepthSample>(after(kind, magnitude, models::DepthSample{3.0})).depth_m;
  };
  EXPECT_EQ(depth(FaultKind::kBiasStep, 0.5), 3.5);
  EXPECT_EQ(depth(FaultKind::kScaleStep, 2.0), 6.0);
  EXPECT_EQ(depth(FaultKind::kSaturation, 1.0), 1.0);
  EXPECT_TRUE(std::isnan(depth(FaultKind::kNanBurst, 0.0)));
  models::PoseSample pose;
  pose.X_WS.p = {1.0, -2.0, 3.0};
  const auto position = [&](FaultKind kind, double magnitude) {
    const auto found = std::get<models::PoseSample>(after(kind, magnitude, pose));
    EXPECT_EQ(found.X_WS.R, pose.X_WS.R);
    EXPECT_EQ(found.position_sigma_m, pose.position_sigma_m);
    return found.X_WS.p;
  };
  EXPECT_EQ(position(FaultKind::kBiasStep, 0.5), Eigen::Vector3d(1.5, -1.5, 3.5));
  EXPECT_EQ(position(FaultKind::kSaturation, 1.5), Eigen::Vector3d(1.0, -1.5, 1.5));
  EXPECT_TRUE(position(FaultKind::kNanBurst, 0.0).array().isNaN().all());
  EXPECT_FALSE(HasChannels(DepthConfig{}, FaultChannels::kGyro));
  EXPECT_FALSE(HasChannels(PoseConfig{}, FaultChannels::kRate));
  EXPECT_TRUE(HasChannels(PoseConfig{}, FaultChannels::kAll));
}

TEST(Faults, OverlappingFaultsActInOrderOfTheSchedule) {
  const auto add_first =
      Pass({Fault(FaultKind::kBiasStep, 1.0), Fault(FaultKind::kScaleStep, 2.0)});
  EXPECT_EQ(Imu(add_first[110]).gyro_rad_s.x(), 2.0 * (110.0 + 1.0));
  const auto scale_first =
      Pass({Fault(FaultKind::kScaleStep, 2.0), Fault(FaultKind::kBiasStep, 1.0)});
  EXPECT_EQ(Imu(scale_first[110]).gyro_rad_s.x(), 2.0 * 110.0 + 1.0);
}

TEST(Faults, LeaveOtherSensorsAlone) {
  FaultConfig fault = Fault(FaultKind::kDropout);
  fault.sensor = "wheels";
  EXPECT_EQ(Pass({fault}).size(), 300U);
}

TEST(Faults, RepeatForASeedAndDifferForAnother) {
  const auto first = Pass({Fault(FaultKind::kOutlierBurst, 5.0)});
  const auto again = Pass({Fault(FaultKind::kOutlierBurst, 5.0)});
  const auto other = Pass({Fault(FaultKind::kOutlierBurst, 5.0)}, 300, 2);
  bool differs = false;
  for (std::size_t n = 0; n < 300; ++n) {
    EXPECT_EQ(Imu(first[n]).gyro_rad_s, Imu(again[n]).gyro_rad_s);
    differs = differs || Imu(first[n]).gyro_rad_s != Imu(other[n]).gyro_rad_s;
  }
  EXPECT_TRUE(differs);
}

TEST(Faults, RefuseWhatNoFaultCanHave) {
  const auto refusal = [](const FaultConfig& fault) -> std::string {
    try {
      FaultInjector("imu", std::vector{fault}, 1);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  FaultConfig fault = Fault(FaultKind::kDropout);
  fault.for_s = -1.0;
  EXPECT_EQ(
      refusal(fault),
      "fault dropout of sensor 'imu': for_s is -1, expected a number above 0 and at most 1e+06");
  fault = Fault(FaultKind::kDropout);
  fault.at_s = -1.0;
  EXPECT_NE(refusal(fault).find("at_s is -1"), std::string::npos);
  EXPECT_NE(refusal(Fault(FaultKind::kExtraDelay, -0.1)).find("magnitude"), std::string::npos);
  EXPECT_NE(refusal(Fault(FaultKind::kTimeJitter, 0.0)).find("magnitude"), std::string::npos);
  EXPECT_NE(refusal(Fault(FaultKind::kBiasStep, std::nan(""))).find("magnitude"),
            std::string::npos);
  EXPECT_EQ(refusal(Fault(FaultKind::kBiasStep, -0.1)), "");
}

}  // namespace
}  // namespace reckon::sim

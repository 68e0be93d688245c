#pragma once

#include "reckon/harness/describe_choices.h"
#include "reckon/harness/describe_timing.h"
#include "reckon/harness/describe_traits.h"

namespace reckon::harness {

template <class Archive>
void DescribeErrors(Archive& a, sim::ContactSensorConfig& e) {
  DescribeTiming(a, e.timing);
  a.Field("source", e.source, "Where it knows it from");
}

template <class Archive>
void DescribeErrors(Archive& a, sim::TorqueConfig& e) {
  DescribeTiming(a, e.timing);
  a.Field("source", e.source, "Where it knows it from");
  a.Field("noise_n_m", e.errors.noise, "Sigma a sample, white", Between(0, 1e3));
  a.Field("offset_n_m", e.errors.offset, "Sigma of each joint's offset drawn once",
          Between(0, 1e3));
  a.Field("scale", e.errors.scale, "Sigma of each joint's scale error drawn once", Between(0, 1));
  a.Field("range_n_m", e.errors.range, "Clips at plus and minus this; 0: no limit",
          Between(0, 1e5));
  a.Field("resolution_n_m", e.errors.resolution, "Of one bit; 0: not quantised", Between(0, 100));
}

template <class Archive>
void DescribeErrors(Archive& a, sim::FootForceConfig& e) {
  DescribeTiming(a, e.timing);
  a.Field("noise_n", e.errors.noise, "Sigma a sample, white", Between(0, 1e4));
  a.Field("offset_n", e.errors.offset, "Sigma of each foot's offset drawn once", Between(0, 1e4));
  a.Field("scale", e.errors.scale, "Sigma of each foot's scale error drawn once", Between(0, 1));
  a.Field("range_n", e.errors.range, "Clips at plus and minus this; 0: no limit", Between(0, 1e6));
  a.Field("resolution_n", e.errors.resolution, "Of one bit; 0: not quantised", Between(0, 1e3));
}

}  // namespace reckon::harness

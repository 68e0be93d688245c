#pragma once

#include "reckon/harness/describe_choices.h"
#include "reckon/harness/describe_traits.h"

namespace reckon::harness {

template <class Archive>
void DescribeTiming(Archive& a, sim::Timing& t) {
  a.Field("rate_hz", t.rate_hz, "Samples a second, an integer fraction of the physics rate",
          AboveUpTo(0, 1e5));
  a.Field("latency_s", t.latency_s, "From a sample's validity to its arrival", Between(0, 60));
  a.Field("stamp_error_s", t.stamp_error_s,
          "The sensor's clock is off: a sample claims to be valid this much after it was",
          Between(-60, 60));
}

}  // namespace reckon::harness

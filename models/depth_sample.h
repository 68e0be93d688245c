#pragma once

namespace reckon::models {

/// What a pressure sensor says of its own place: how far its origin lies below z = 0 of W [m],
/// positive downwards.
struct DepthSample {
  double depth_m = 0.0;
};

}  // namespace reckon::models

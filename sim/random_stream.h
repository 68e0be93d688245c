#pragma once

#include <cstdint>
#include <string_view>

namespace reckon::sim {

/// A named stream of random numbers, addressed and not stepped: a draw is a pure function of
/// (scenario seed, name, channel, index) through a counter-based generator (Philox 4x32-10 of
/// Random123, keyed by the seed and a hash of the name). Adding a stream or changing another's rate
/// changes no draw of this one. Does not allocate.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::string_view name);

  /// Standard normal draw number `index` of `channel`.
  double Normal(std::uint32_t channel, std::uint64_t index) const;

  /// Uniform draw in [0, 1), independent of the normal one at the same address.
  double Uniform(std::uint32_t channel, std::uint64_t index) const;

 private:
  std::uint64_t key_ = 0;
};

}  // namespace reckon::sim

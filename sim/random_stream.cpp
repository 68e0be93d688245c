#include "reckon/sim/random_stream.h"

#include <Random123/philox.h>
#include <Random123/boxmuller.hpp>

namespace reckon::sim {
namespace {

enum class Draw : std::uint32_t { kNormal, kUniform };

/// FNV-1a, 64 bits.
std::uint64_t Hash(std::string_view name) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return hash;
}

/// The finaliser of SplitMix64, a bijection: neighbouring seeds get keys that share no pattern.
std::uint64_t Scramble(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

struct Bits {
  std::uint64_t a, b;
};

Bits Philox(std::uint64_t key, std::uint32_t channel, std::uint64_t index, Draw draw) {
  using Generator = r123::Philox4x32;  // ten rounds
  const auto low = [](std::uint64_t x) { return static_cast<std::uint32_t>(x); };
  const auto high = [](std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32); };
  const Generator::ctr_type counter{
      {low(index), high(index), channel, static_cast<std::uint32_t>(draw)}};
  const auto words = Generator{}(counter, Generator::key_type{{low(key), high(key)}});
  return {words[0] | std::uint64_t{words[1]} << 32, words[2] | std::uint64_t{words[3]} << 32};
}

}  // namespace

RandomStream::RandomStream(std::uint64_t seed, std::string_view name)
    : key_(Scramble(seed) ^ Hash(name)) {}

double RandomStream::Normal(std::uint32_t channel, std::uint64_t index) const {
  const Bits bits = Philox(key_, channel, index, Draw::kNormal);
  return r123::boxmuller(bits.a, bits.b).x;
}

double RandomStream::Uniform(std::uint32_t channel, std::uint64_t index) const {
  const Bits bits = Philox(key_, channel, index, Draw::kUniform);
  return static_cast<double>(bits.a >> 11) * 0x1p-53;
}

}  // namespace reckon::sim

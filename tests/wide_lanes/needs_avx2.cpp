#include <gtest/gtest.h>

#include "reckon/estimator/lane.h"

static_assert(RECKON_AVX2_LANES == 1, "these tests are about the wide lanes");

namespace reckon {
namespace {

/// Skips all tests of this program where the processor would not know its instructions.
class NeedsAvx2 : public ::testing::Environment {
 public:
  void SetUp() override {
    if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) {
      GTEST_SKIP() << "this processor has no AVX2 or no FMA";
    }
  }
};

[[maybe_unused]] const auto* const kNeedsAvx2 = ::testing::AddGlobalTestEnvironment(new NeedsAvx2);

}  // namespace
}  // namespace reckon

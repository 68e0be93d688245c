#include "reckon/harness/nearest.h"

#include <gtest/gtest.h>

#include <vector>

namespace reckon::harness {
namespace {

TEST(Nearest, CountsEdits) {
  EXPECT_EQ(EditDistance("", "abc"), 3);
  EXPECT_EQ(EditDistance("abc", "abc"), 0);
  EXPECT_EQ(EditDistance("gyro_nosie", "gyro_noise"), 1);  // two neighbours swapped
  EXPECT_EQ(EditDistance("kitten", "sitting"), 3);         // the textbook's example
}

TEST(Nearest, FindsWhatWasMeant) {
  const std::vector<std::string> names{"rate_hz", "latency_s", "grade"};
  EXPECT_EQ(Nearest("rate", names), std::nullopt);  // three edits of seven letters: too far
  EXPECT_EQ(Nearest("rate_h", names), "rate_hz");
  EXPECT_EQ(Nearest("latencys", names), "latency_s");
  EXPECT_EQ(Nearest("colour", names), std::nullopt);
  EXPECT_EQ(DidYouMean("grad", names), "; did you mean 'grade'?");
  EXPECT_EQ(DidYouMean("colour", names), "");
}

TEST(Nearest, TakesTheFirstOfEquallyNear) {
  const std::vector<std::string> names{"ba", "ca"};
  EXPECT_EQ(Nearest("aa", names), "ba");
}

}  // namespace
}  // namespace reckon::harness

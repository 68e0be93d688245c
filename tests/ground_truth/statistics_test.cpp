#include "reckon/ground_truth/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace reckon::ground_truth {
namespace {

TEST(Statistics, OfFourNumbers) {
  const std::vector<double> errors{4.0, 1.0, 3.0, 2.0};
  const Statistics s = Summarise(errors);
  EXPECT_DOUBLE_EQ(s.mean, 2.5);
  EXPECT_DOUBLE_EQ(s.median, 2.5);  // between the middle two
  EXPECT_DOUBLE_EQ(s.min, 1.0);
  EXPECT_DOUBLE_EQ(s.max, 4.0);
  EXPECT_DOUBLE_EQ(s.sse, 30.0);
  EXPECT_DOUBLE_EQ(s.rmse, std::sqrt(7.5));
  EXPECT_DOUBLE_EQ(s.std, std::sqrt(1.25));  // by n, not by n − 1
}

TEST(Statistics, TheMedianOfAnOddNumberIsTheMiddleOne) {
  const std::vector<double> errors{9.0, 1.0, 2.0};
  EXPECT_DOUBLE_EQ(Summarise(errors).median, 2.0);
}

TEST(Statistics, AreNotNumbersWithoutErrorsOrWithOneThatIsNone) {
  EXPECT_TRUE(std::isnan(Summarise({}).rmse));
  const std::vector<double> errors{1.0, std::numeric_limits<double>::quiet_NaN()};
  const Statistics s = Summarise(errors);
  EXPECT_TRUE(std::isnan(s.rmse) && std::isnan(s.median) && std::isnan(s.max));
}

}  // namespace
}  // namespace reckon::ground_truth

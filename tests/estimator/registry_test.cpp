#include "reckon/estimator/registry.h"

#include <gtest/gtest.h>

#include <set>

#include "estimator/robot.h"

namespace reckon::estimator {
namespace {

TEST(Registry, FindsEachEntryByItsName) {
  std::set<std::string_view> names;
  for (const RegistryEntry& entry : Registry()) {
    EXPECT_EQ(FindEstimator(entry.name), &entry);
    EXPECT_FALSE(entry.description.empty());
    EXPECT_TRUE(names.insert(entry.name).second) << entry.name << " twice";
    EXPECT_NE(entry.make(testing_estimator::TestSetup()), nullptr);
  }
  EXPECT_EQ(names, (std::set<std::string_view>{"inekf", "iterated_inekf", "mekf", "odometry"}));
  EXPECT_EQ(FindEstimator("inekg"), nullptr);
}

TEST(NoiseFields, NameEachMemberOnce) {
  Noise noise;
  double value = 0.0;
  std::set<std::string_view> names;
  for (const NoiseField& field : NoiseFields()) {
    noise.*field.member = ++value;
    EXPECT_TRUE(names.insert(field.name).second) << field.name;
  }
  // Had two entries shared a member, one of the values would be missing.
  double sum = 0.0;
  for (const NoiseField& field : NoiseFields()) sum += noise.*field.member;
  EXPECT_EQ(sum, value * (value + 1) / 2);
  EXPECT_EQ(sizeof(Noise), NoiseFields().size() * sizeof(double)) << "a member has no entry";
}

TEST(Names, AreThereForEveryDecisionAndRefusal) {
  std::set<std::string_view> names;
  for (int i = 0; i <= static_cast<int>(Decision::kRefused); ++i) {
    EXPECT_TRUE(names.insert(Name(static_cast<Decision>(i))).second);
  }
  for (int i = 0; i < static_cast<int>(kRefusals); ++i) {
    EXPECT_TRUE(names.insert(Name(static_cast<Refusal>(i))).second);
  }
  EXPECT_EQ(names.count("unknown"), 0u);
}

}  // namespace
}  // namespace reckon::estimator

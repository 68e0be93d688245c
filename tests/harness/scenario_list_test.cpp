#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "reckon/harness/list_command.h"
#include "reckon/harness/yaml_error.h"
#include "reckon/sim/dvl_grades.h"
#include "reckon/sim/imu_grades.h"

namespace reckon::harness {
namespace {

TEST(ScenarioList, HoldsWhatAScenarioCanName) {
  const auto all = nlohmann::json::parse(ListJson());
  const auto has = [&all](const char* section, const char* name) {
    for (const auto& entry : all.at(section)) {
      if (entry.at("name") == name) return !entry.at("description").get<std::string>().empty();
    }
    return false;
  };
  EXPECT_TRUE(has("robots", "husky"));
  EXPECT_TRUE(has("estimators", "inekf"));
  EXPECT_TRUE(has("estimators", "process"));
  EXPECT_TRUE(has("sensors", "encoders"));
  EXPECT_TRUE(has("sensors", "dvl"));
  EXPECT_TRUE(has("grades", "a50"));
  EXPECT_TRUE(has("missions", "lawnmower"));
  EXPECT_TRUE(has("terrains", "kerbs"));
  EXPECT_TRUE(has("motions", "figure_eight"));
  EXPECT_TRUE(has("faults", "outlier_burst"));
  EXPECT_TRUE(has("metrics", "ate_position_rmse_m"));
  EXPECT_TRUE(has("scenarios", "scenarios/husky/square.yaml"));
  EXPECT_FALSE(has("robots", "huskie"));
}

TEST(ScenarioList, SaysWhichFieldsOfAGradeAreBlank) {
  const auto all = nlohmann::json::parse(ListJson());
  for (const auto& entry : all.at("grades")) {
    const auto name = entry.at("name").get<std::string>();
    const auto* grade = sim::FindImuGrade(name);
    ASSERT_TRUE(grade != nullptr || sim::FindDvlGrade(name) != nullptr);
    if (grade == nullptr) continue;
    EXPECT_EQ(entry.at("blank").get<std::vector<std::string>>(), sim::BlankFields(*grade));
  }
  EXPECT_NE(ListText("grades").find("blank, so zero: "), std::string::npos);
}

TEST(ScenarioList, PicksASection) {
  const std::string text = ListText("terrains");
  EXPECT_EQ(text.substr(0, 9), "terrains\n");
  EXPECT_EQ(text.find("motions"), std::string::npos);
  try {
    ListText("terains");
    FAIL() << "was listed";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean 'terrains'?"), std::string::npos);
  }
}

}  // namespace
}  // namespace reckon::harness

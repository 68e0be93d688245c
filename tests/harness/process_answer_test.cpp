#include "reckon/harness/process_answer.h"

#include <cmath>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace reckon::harness {
namespace {

using nlohmann::json;

constexpr AnswerContext kContext{.form = estimator::ErrorForm::kLeftInvariant,
                                 .sensors = 2,
                                 .sensor = 1,
                                 .valid_ns = 30,
                                 .earliest_ns = 20,
                                 .latest_ns = 40};

json GoodBelief() {
  return {{"t_ns", 30}, {"q_WB", {1, 0, 0, 0}}, {"p_WB", {1, 2, 3}}, {"v_WB", {4, 5, 6}}};
}

json With(const std::string& key, json value) {
  json belief = GoodBelief();
  belief[key] = std::move(value);
  return belief;
}

/// 15 × 15, all `diagonal` but for the entries (0, 1) and (1, 0).
json Covariance(double diagonal, double upper, double lower) {
  std::vector<double> P(225, 0.0);
  for (std::size_t i = 0; i < 15; ++i) P[16 * i] = diagonal;
  P[1] = upper;
  P[15] = lower;
  return P;
}

TEST(ProcessAnswer, EmptyObjectIsNoNewBelief) {
  const ProcessAnswer answer = ParseAnswer("{}", kContext);
  EXPECT_FALSE(answer.belief);
  EXPECT_TRUE(answer.report.corrections().empty());
  EXPECT_EQ(answer.report.refusal, estimator::Refusal::kNone);
}

TEST(ProcessAnswer, BeliefWithoutBiasesOrCovariance) {
  // A quarter turn to the left, its norm 1 + 5e-4: normalised.
  const double half = std::sqrt(0.5) * (1.0 + 5e-4);
  const auto belief = ParseAnswer(With("q_WB", {half, 0, 0, half}).dump(), kContext).belief;
  ASSERT_TRUE(belief);
  EXPECT_EQ(belief->t_ns, 30);
  Eigen::Matrix3d R_WB;
  R_WB << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  EXPECT_LT((belief->X_WB.R - R_WB).norm(), 1e-15);  // rounding
  EXPECT_EQ(belief->X_WB.p, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(belief->v_WB, Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(belief->form, estimator::ErrorForm::kLeftInvariant);
  EXPECT_FALSE(belief->has_biases);
  EXPECT_FALSE(belief->has_covariance);
}

TEST(ProcessAnswer, CovarianceFullOrUpperTriangle) {
  json triangle = json::array();
  for (int row = 0; row < 15; ++row) {
    for (int column = row; column < 15; ++column) {
      triangle.push_back(row == column ? 2.0 : (row == 0 && column == 1 ? 0.5 : 0.0));
    }
  }
  estimator::ErrorCovariance P = 2.0 * estimator::ErrorCovariance::Identity();
  P(0, 1) = P(1, 0) = 0.5;
  for (const json& numbers : {Covariance(2.0, 0.5, 0.5), triangle}) {
    const auto belief = ParseAnswer(With("covariance", numbers).dump(), kContext).belief;
    ASSERT_TRUE(belief && belief->has_covariance);
    EXPECT_EQ(belief->covariance, P);
  }
}

TEST(ProcessAnswer, ZeroAndSingularCovariancesAreAllowed) {
  // A bias that is not estimated has none; perfectly correlated states are the limit.
  EXPECT_TRUE(ParseAnswer(With("covariance", Covariance(0.0, 0.0, 0.0)).dump(), kContext).belief);
  EXPECT_TRUE(ParseAnswer(With("covariance", Covariance(2.0, 2.0, 2.0)).dump(), kContext).belief);
}

TEST(ProcessAnswer, CorrectionsCarryTheirNis) {
  const json line{{"corrections",
                   {{{"innovation", {3.0}}, {"covariance", {4.0}}, {"decision", "accepted"}},
                    {{"innovation", {1.0, 2.0}},
                     {"covariance", {2.0, 0.0, 0.0, 8.0}},
                     {"decision", "rejected"},
                     {"sensor", 0},
                     {"t_ns", 25}}}}};
  const estimator::Report report = ParseAnswer(line.dump(), kContext).report;
  ASSERT_EQ(report.corrections().size(), 2u);
  const estimator::Correction &one = report.corrections()[0], &two = report.corrections()[1];
  EXPECT_EQ(one.rows, 1);
  EXPECT_DOUBLE_EQ(one.nis, 9.0 / 4.0);  // z²/S
  EXPECT_EQ(one.sensor, 1);
  EXPECT_EQ(one.t_ns, 30);
  EXPECT_EQ(two.rows, 2);
  EXPECT_DOUBLE_EQ(two.nis, 1.0 / 2.0 + 4.0 / 8.0);
  EXPECT_EQ(two.decision, estimator::Decision::kRejected);
  EXPECT_EQ(two.sensor, 0);
  EXPECT_EQ(two.t_ns, 25);
}

TEST(ProcessAnswer, Ready) {
  EXPECT_EQ(ParseReady(R"({"ready": true, "error": "multiplicative"})"),
            estimator::ErrorForm::kMultiplicative);
  for (const char* line : {R"({"ready": true, "error": "left"})", R"({"ready": true})",
                           R"({"ready": false, "error": "multiplicative"})", "{}", "ready"}) {
    EXPECT_THROW(ParseReady(line), BadAnswer) << line;
  }
}

struct BadCase {
  std::string name, line, says;
  friend void PrintTo(const BadCase& bad, std::ostream* out) { *out << bad.name; }
};

class BadProcessAnswer : public testing::TestWithParam<BadCase> {};

TEST_P(BadProcessAnswer, IsRefusedWithWhatWasExpectedAndFound) {
  try {
    ParseAnswer(GetParam().line, kContext);
    FAIL() << "accepted: " << GetParam().line;
  } catch (const BadAnswer& error) {
    EXPECT_NE(std::string(error.what()).find(GetParam().says), std::string::npos) << error.what();
  }
}

json OneCorrection(json innovation, json covariance, json decision) {
  return {{"corrections",
           {{{"innovation", std::move(innovation)},
             {"covariance", std::move(covariance)},
             {"decision", std::move(decision)}}}}};
}

json Without(const std::string& key) {
  json belief = GoodBelief();
  belief.erase(key);
  return belief;
}

std::vector<BadCase> BadCases() {
  const std::string nan_line =
      R"({"t_ns": 30, "q_WB": [1, 0, 0, 0], "p_WB": [NaN, 0, 0], "v_WB": [0, 0, 0]})";
  const std::string huge_line =
      R"({"t_ns": 30, "q_WB": [1, 0, 0, 0], "p_WB": [1e999, 0, 0], "v_WB": [0, 0, 0]})";
  json short_covariance = Covariance(1, 0, 0);
  short_covariance.erase(0);
  return {
      {"Garbage", "hello", "one JSON object on one line"},
      {"Empty", "", "one JSON object on one line"},
      {"TwoObjects", "{} {}", "one JSON object on one line"},
      {"NotUtf8", "{\"\xff\": 1}", "one JSON object on one line"},
      {"List", "[]", "a JSON object"},
      {"Nan", nan_line, "NaN and Infinity are not JSON"},
      {"Overflow", huge_line, "one JSON object"},
      {"Null", With("v_WB", {0, nullptr, 0}).dump(), "'null' at index 1"},
      {"UnknownKey", With("velocity", {0, 0, 0}).dump(), "'velocity'"},
      {"MissingKey", Without("v_WB").dump(), "the key 'v_WB'"},
      {"TwoNumbers", With("p_WB", {1, 2}).dump(), "2 entries"},
      {"NotAList", With("p_WB", 1.0).dump(), "a list of 3 finite numbers"},
      {"FractionalStamp", With("t_ns", 30.5).dump(), "an integer"},
      {"OlderStamp", With("t_ns", 19).dump(), "'t_ns' between 20"},
      {"FutureStamp", With("t_ns", 41).dump(), "and 40"},
      {"LongQuaternion", With("q_WB", {1.1, 0, 0, 0}).dump(), "norm 1.1"},
      {"ZeroQuaternion", With("q_WB", {0, 0, 0, 0}).dump(), "norm 0.0"},
      {"OneBiasAlone", With("gyro_bias_rad_s", {0, 0, 0}).dump(), "'accel_bias_m_s2'"},
      {"BiasAlone", R"({"gyro_bias_rad_s": [0, 0, 0]})", "the key 't_ns'"},
      {"ShortCovariance", With("covariance", short_covariance).dump(), "224 entries"},
      {"Asymmetric", With("covariance", Covariance(2, 0.5, 0.4)).dump(), "symmetric"},
      {"NegativeVariance", With("covariance", Covariance(-1, 0, 0)).dump(), "-1.0 at (0, 0)"},
      {"Correlation", With("covariance", Covariance(2, 2.1, 2.1)).dump(), "beyond 1 at (1, 0)"},
      {"ZeroVarianceCorrelated", With("covariance", Covariance(0, 1, 1)).dump(), "beyond 1"},
      {"Decision", OneCorrection({1}, {1}, "ok").dump(), "accepted warned"},
      {"FourRows", OneCorrection({1, 1, 1, 1}, {1}, "accepted").dump(), "1 or 2 or 3"},
      {"RowsDisagree", OneCorrection({1, 1}, {1}, "accepted").dump(), "a list of 4"},
      {"SingularS", OneCorrection({1}, {0}, "accepted").dump(), "positive definite"},
      {"Refusal", R"({"refusal": "no"})", "not_finite"},
  };
}

INSTANTIATE_TEST_SUITE_P(All, BadProcessAnswer, testing::ValuesIn(BadCases()),
                         [](const auto& test) { return test.param.name; });

TEST(ProcessAnswer, IndefiniteWithEveryPairInOrder) {
  // Three coordinates, each pair with correlation −0.9: every 2 × 2 minor is positive, but the
  // smallest eigenvalue is 1 − 2·0.9 = −0.8.
  json numbers = Covariance(1.0, -0.9, -0.9);
  numbers[2] = numbers[30] = numbers[17] = numbers[31] = -0.9;
  EXPECT_THROW(ParseAnswer(With("covariance", numbers).dump(), kContext), BadAnswer);
  // With −0.4 it is 1 − 0.8 = 0.2: fine.
  numbers[1] = numbers[15] = numbers[2] = numbers[30] = numbers[17] = numbers[31] = -0.4;
  EXPECT_TRUE(ParseAnswer(With("covariance", numbers).dump(), kContext).belief);
}

TEST(ProcessAnswer, MoreCorrectionsThanAReportHoldsAreTooMany) {
  json line = OneCorrection({1}, {1}, "accepted");
  for (int i = 0; i < estimator::kMaxCorrections; ++i)
    line["corrections"].push_back(line["corrections"][0]);
  EXPECT_THROW(ParseAnswer(line.dump(), kContext), BadAnswer);
}

}  // namespace
}  // namespace reckon::harness

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "reckon/ground_truth/alignment.h"
#include "reckon/ground_truth/ate.h"
#include "reckon/ground_truth/rpe.h"
#include "reckon/ground_truth/statistics.h"
#include "reckon/ground_truth/tum.h"

// The numbers that evo 1.38.1 gave for two small trajectories, frozen in evo_fixture/.

namespace reckon::ground_truth {
namespace {

const std::string kFolder = RECKON_SOURCE_DIR "/tests/ground_truth/evo_fixture/";

/// evo itself agrees with a long double computation to 1e-13; the files hold nine digits.
constexpr double kRelative = 1e-10;

/// The paired trajectories; the estimate in the place of the reference when `swapped`.
Track FixtureTrack(bool swapped = false) {
  const auto truth = ReadTum(kFolder + (swapped ? "est.tum" : "truth.tum"));
  const auto estimate = ReadTum(kFolder + (swapped ? "truth.tum" : "est.tum"));
  Track track;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    Truth t;
    estimator::Estimate e;
    t.t_ns = e.t_ns = truth[i].t_ns;
    t.X_WB = truth[i].X_WB;
    e.X_WB = estimate[i].X_WB;
    track.Add(t, e);
  }
  return track;
}

nlohmann::json Fixture() {
  std::ifstream file(kFolder + "fixture.json");
  return nlohmann::json::parse(file);
}

TEST(EvoFixture, AbsoluteErrorsOfEveryAlignment) {
  const Track track = FixtureTrack();
  const auto evo = Fixture()["evo_rmse"]["ape"];
  const std::map<std::string, Alignment> alignments{{"none", Alignment::kNone},
                                                    {"se3", Alignment::kSe3},
                                                    {"sim3", Alignment::kSim3},
                                                    {"origin", Alignment::kFirstPose}};
  ASSERT_EQ(evo.size(), alignments.size());
  for (const auto& [name, alignment] : alignments) {
    SCOPED_TRACE(name);
    const auto errors = AbsoluteError(track.samples(), Align(alignment, track.samples()));
    ASSERT_EQ(errors.position_m.size(), evo[name]["n"].get<std::size_t>());
    const double trans = evo[name]["trans_m"], rot = evo[name]["rot_deg"];
    EXPECT_NEAR(Summarise(errors.position_m).rmse, trans, kRelative * trans);
    EXPECT_NEAR(Summarise(errors.orientation_deg).rmse, rot, kRelative * rot);
  }
}

TEST(EvoFixture, YawAndPositionOfTheFirstPose) {
  const Track track = FixtureTrack();
  const auto other = Fixture()["ours"]["ape"]["posyaw_first(no evo)"];
  const auto errors =
      AbsoluteError(track.samples(), Align(Alignment::kFirstYawPosition, track.samples()));
  const double trans = other["trans_m"], rot = other["rot_deg"];
  EXPECT_NEAR(Summarise(errors.position_m).rmse, trans, 0.01 * trans);
  EXPECT_NEAR(Summarise(errors.orientation_deg).rmse, rot, 0.01 * rot);
}

/// `10m all pairs_from_ref`: a length, a unit, a choice, and whose path is measured.
TEST(EvoFixture, RelativeErrorsOfEveryConfiguration) {
  const auto evo = Fixture()["evo_rmse"]["rpe"];
  const Track track = FixtureTrack(), swapped = FixtureTrack(true);
  ASSERT_EQ(evo.size(), 16U);
  for (const auto& [name, expected] : evo.items()) {
    SCOPED_TRACE(name);
    std::istringstream words(name);
    int length = 0;
    char unit = ' ';
    std::string which, whose;
    ASSERT_TRUE(words >> length >> unit >> which >> whose);
    const PairChoice choice = which == "all" ? PairChoice::kAll : PairChoice::kConsecutive;
    const Track& measured = whose == "pairs_from_est" ? swapped : track;
    const IndexPairs pairs = unit == 'f' ? PairsByFrames(track.samples().size(),
                                                         static_cast<std::size_t>(length), choice)
                                         : PairsByPath(measured.samples(), length, choice);
    ASSERT_EQ(pairs.size(), expected["n"].get<std::size_t>());
    const RelativeErrors errors = RelativeError(track.samples(), pairs);
    const double trans = expected["trans_m"], rot = expected["rot_deg"];
    EXPECT_NEAR(Summarise(errors.translation_m).rmse, trans, kRelative * trans);
    EXPECT_NEAR(Summarise(errors.rotation_deg).rmse, rot, kRelative * rot);
  }
}

}  // namespace
}  // namespace reckon::ground_truth

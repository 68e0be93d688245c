#include "reckon/ground_truth/tum.h"

#include <gtest/gtest.h>

#include "ground_truth/recorded_run.h"

namespace reckon::ground_truth {
namespace {

using testing::Bytes;
using testing::SomeRotation;
using testing::TemporaryFolder;

TEST(Tum, WritesEightPlainColumns) {
  const TemporaryFolder folder;
  TumWriter writer(folder / "a.tum");
  Eigen::Matrix3d quarter_turn;  // about z: q = (0, 0, √½, √½)
  quarter_turn << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  writer.Add(1'500'000'001, {Eigen::Matrix3d::Identity(), {1.0, -0.1, 0.0}});
  writer.Add(60'000'000'000, {quarter_turn, {0.0, 0.0, 1e-9}});
  writer.Close();
  EXPECT_EQ(Bytes(folder / "a.tum"),
            "1.500000001 1 -0.1 0 0 0 0 1\n"
            "60.000000000 0 0 1e-09 0 0 0.7071067811865475 0.7071067811865476\n");
}

TEST(Tum, ReadsBackWhatItWrote) {
  const TemporaryFolder folder;
  TumWriter writer(folder / "a.tum");
  for (int k = 0; k < 5000; ++k) {
    writer.Add(models::TimeNs{k} * 4'999'999,
               {SomeRotation(0.01 * k), {1.0 / (k + 1), k / 3.0, -1.0 * k}});
  }
  writer.Close();
  const auto poses = ReadTum(folder / "a.tum");
  ASSERT_EQ(poses.size(), 5000U);
  for (int k = 0; k < 5000; ++k) {
    const StampedPose& pose = poses[static_cast<std::size_t>(k)];
    EXPECT_EQ(pose.t_ns, models::TimeNs{k} * 4'999'999);
    EXPECT_EQ(pose.X_WB.p, Eigen::Vector3d(1.0 / (k + 1), k / 3.0, -1.0 * k));
    // Rotation matrix to quaternion and back: a few roundings.
    EXPECT_LT((pose.X_WB.R - SomeRotation(0.01 * k)).cwiseAbs().maxCoeff(), 2e-15);
  }
}

TEST(Tum, NamesTheLineThatIsWrong) {
  const TemporaryFolder folder;
  std::ofstream(folder / "a.tum") << "# t x y z\n0 0 0 0 0 0 0 1\n1 0 0 0 0 0 0\n";
  try {
    (void)ReadTum(folder / "a.tum");
    FAIL() << "read seven columns";
  } catch (const RecordingError& error) {
    EXPECT_NE(std::string(error.what()).find("a.tum:3: not eight numbers"), std::string::npos);
  }
  EXPECT_THROW((void)ReadTum(folder / "absent.tum"), RecordingError);
  EXPECT_THROW(TumWriter("/nowhere/at/all.tum"), RecordingError);
}

}  // namespace
}  // namespace reckon::ground_truth

#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>

#include "ground_truth/recorded_run.h"
#include "reckon/ground_truth/recording_reader.h"

// What a recording is worth when its writer dies or its disk fills up.

namespace reckon::ground_truth {
namespace {

using testing::ImuAt;
using testing::SmallPlan;
using testing::SomeEstimate;
using testing::SomeTruth;
using testing::TemporaryFolder;

/// Rows that a chunk of a stream holds.
std::size_t ChunkRows(std::size_t row_bytes) {
  return std::min(RunRecorder::kChunkRows, RunRecorder::kChunkBytes / row_bytes);
}

/// Records in a child process, which ends itself by SIGKILL after `rows` rows of each stream.
void RecordAndDie(const std::filesystem::path& path, int rows) {
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    RunRecorder recorder(path, SmallPlan());
    recorder.AddPrior(0, {});
    for (int k = 0; k < rows; ++k) {
      recorder.Add(SomeTruth(k));
      recorder.Add(ImuAt(k));
      recorder.Add(0, SomeEstimate(k));
    }
    kill(getpid(), SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
}

TEST(RecordingCrash, EveryFlushedRowSurvivesAKill) {
  const TemporaryFolder folder;
  constexpr int kRows = 5000;
  RecordAndDie(folder / "run.h5", kRows);
  const RecordingReader reader(folder / "run.h5");
  EXPECT_FALSE(reader.closed());
  EXPECT_TRUE(reader.ReadPrior(0));

  // 24 + 2 · 3 numbers and 8 bytes of stamp a row of truth.
  const std::size_t truth_chunk = ChunkRows(8 * (1 + 9 + 3 + 3 + 3 + 6 + 2 * 3));
  std::size_t truths = 0;
  for (auto cursor = reader.ReadTruth(); const auto truth = cursor.Next(); ++truths) {
    ASSERT_EQ(truth->X_WB.p, SomeTruth(static_cast<models::TimeNs>(truths)).X_WB.p);
  }
  EXPECT_EQ(truths, kRows / truth_chunk * truth_chunk);
  EXPECT_GT(truths, 0U);

  std::size_t measurements = 0;
  for (auto cursor = reader.ReadMeasurements(); const auto imu = cursor.Next(); ++measurements) {
    ASSERT_EQ(imu->valid_ns, static_cast<models::TimeNs>(measurements));
  }
  EXPECT_EQ(measurements, kRows / RunRecorder::kChunkRows * RunRecorder::kChunkRows);

  std::size_t estimates = 0;
  for (auto cursor = reader.ReadEstimates(0); const auto estimate = cursor.Next(); ++estimates) {
    const auto expected = SomeEstimate(static_cast<models::TimeNs>(estimates));
    ASSERT_EQ(estimate->X_WB.p, expected.X_WB.p);
    ASSERT_EQ(estimate->covariance, expected.covariance);
  }
  EXPECT_EQ(estimates, kRows / RunRecorder::kChunkRows * RunRecorder::kChunkRows);
}

TEST(RecordingCrash, CanBeReadWhileItIsWritten) {
  const TemporaryFolder folder;
  RunRecorder recorder(folder / "run.h5", SmallPlan());
  for (int k = 0; k < 2000; ++k) recorder.Add(SomeTruth(k));
  const pid_t child = fork();  // another process: this one holds the file open for writing
  ASSERT_GE(child, 0);
  if (child == 0) {
    const char* const program = "/proc/self/exe";
    setenv("RECKON_TEST_READ", (folder / "run.h5").c_str(), 1);
    execl(program, program, "--gtest_also_run_disabled_tests",
          "--gtest_filter=RecordingCrash.DISABLED_ReadsFileOfParent", nullptr);
    _exit(127);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

TEST(RecordingCrash, DISABLED_ReadsFileOfParent) {
  const char* const path = std::getenv("RECKON_TEST_READ");
  ASSERT_NE(path, nullptr);
  const RecordingReader reader(path);
  auto cursor = reader.ReadTruth();
  ASSERT_TRUE(cursor.Next());
  EXPECT_FALSE(reader.closed());
}

/// How a child process that records truth until its disk is full ended: 42 if the error was right.
int RecordUntil(const std::filesystem::path& path, const std::string& message) {
  try {
    RunRecorder recorder(path, SmallPlan());
    for (int k = 0; k < 100'000; ++k) recorder.Add(SomeTruth(k));
  } catch (const RecordingError& error) {
    if (error.what() == message) return 42;
    std::fprintf(stderr, "%s\n", error.what());
  }
  return 1;
}

TEST(RecordingCrash, AFileThatMayNotGrowIsAnErrorThatNamesPathAndReason) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "run.h5";
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    // The bound is lifted when it is met, else it would bind also what replaces the file.
    signal(SIGXFSZ, [](int) {
      rlimit limit{};
      getrlimit(RLIMIT_FSIZE, &limit);
      limit.rlim_cur = limit.rlim_max;
      setrlimit(RLIMIT_FSIZE, &limit);
    });
    rlimit limit{};
    getrlimit(RLIMIT_FSIZE, &limit);
    limit.rlim_cur = 4'000'000;
    setrlimit(RLIMIT_FSIZE, &limit);
    std::exit(RecordUntil(path, path.string() + ": can't write: File too large"));
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status)) << "ended by signal " << WTERMSIG(status);
  EXPECT_EQ(WEXITSTATUS(status), 42);
}

TEST(RecordingCrash, AFullDiskIsAnErrorAndLetsTheProcessEnd) {
  const TemporaryFolder folder;
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    // A small disk of its own, where the system lets us have one.
    const std::string disk = folder.path().string();
    if ((unshare(CLONE_NEWNS) != 0 && unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) ||
        mount("", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
        mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=4m") != 0) {
      _exit(77);
    }
    const std::string path = folder / "run.h5";
    // HDF5's own end of the process must neither hang nor crash.
    std::exit(RecordUntil(path, path + ": can't write: No space left on device"));
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status)) << "ended by signal " << WTERMSIG(status);
  if (WEXITSTATUS(status) == 77) GTEST_SKIP() << "may not mount a small disk";
  EXPECT_EQ(WEXITSTATUS(status), 42);
}

}  // namespace
}  // namespace reckon::ground_truth

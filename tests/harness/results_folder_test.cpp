#include "reckon/harness/results_folder.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "ground_truth/recorded_run.h"

namespace reckon::harness {
namespace {

namespace fs = std::filesystem;
using ground_truth::testing::Bytes;
using ground_truth::testing::TemporaryFolder;

/// A finished result, as far as its folder is asked.
void MakeResult(const fs::path& folder, const std::string& text) {
  fs::create_directories(folder);
  std::ofstream(folder / "run.json")
      << R"({"scenario": "a", "seed": 1, "text": ")" << text << "\"}";
}

TEST(ResultsFolder, KeepsTheOldResultIfTheNewOneCantTakeItsPlace) {
  const TemporaryFolder root;
  MakeResult(root / "result", "old");
  const std::string before = Bytes(root / "result/run.json");
  {
    ResultsFolder folder(root / "result", "a", 1, false);
    fs::remove_all(folder.File(""));  // somebody tidies up
    EXPECT_THROW(folder.Publish(), OutputError);
  }
  EXPECT_EQ(Bytes(root / "result/run.json"), before);
  EXPECT_EQ(std::distance(fs::directory_iterator(root.path()), {}), 1);
}

TEST(ResultsFolder, ReplacesTheOldResult) {
  const TemporaryFolder root;
  MakeResult(root / "result", "old");
  ResultsFolder folder(root / "result", "a", 1, false);
  folder.Write("run.json", "new");
  folder.Publish();
  EXPECT_EQ(Bytes(root / "result/run.json"), "new");
  EXPECT_EQ(std::distance(fs::directory_iterator(root.path()), {}), 1);
}

TEST(ResultsFolder, HonoursTheUmask) {
  for (const mode_t mask : {mode_t{027}, mode_t{077}, mode_t{002}}) {
    const TemporaryFolder root;
    const mode_t before = umask(mask);
    ResultsFolder folder(root / "result", "a", 1, false);
    folder.Write("run.json", "{}");
    folder.Publish();
    umask(before);
    const auto of = [](const fs::path& path) {
      return static_cast<mode_t>(fs::status(path).permissions());
    };
    EXPECT_EQ(of(root / "result"), 0777 & ~mask);
    EXPECT_EQ(of(root / "result/run.json"), 0666 & ~mask);
  }
}

}  // namespace
}  // namespace reckon::harness

#include "reckon/harness/csv_table.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ground_truth/recorded_run.h"
#include "harness/log_case.h"

namespace reckon::harness {
namespace {

using ground_truth::testing::TemporaryFolder;
using testing::WriteFile;

class Csv : public ::testing::Test {
 protected:
  CsvTable Table(const std::string& text) const {
    WriteFile(folder_ / "a.csv", text);
    return CsvTable(folder_ / "a.csv");
  }

  /// What `read` complains about, without the folder.
  template <class Read>
  std::string Complaint(const std::string& text, const Read& read) const {
    try {
      CsvTable table = Table(text);
      read(table);
    } catch (const InputError& error) {
      const std::string what = error.what();
      return what.substr(what.find("a.csv"));
    }
    return "";
  }

  TemporaryFolder folder_;
};

TEST_F(Csv, GivesNumbersByTheNamesOfTheirColumns) {
  CsvTable table = Table("# made by hand\n\nt_s, x ,y\n 1.5,-2e-3,+4\r\n\n2,,5\n");
  EXPECT_EQ(table.Need("y"), 2u);
  EXPECT_FALSE(table.Find("z"));
  ASSERT_TRUE(table.Next());
  EXPECT_EQ(table.Number(table.Need("x")), -2e-3);
  EXPECT_EQ(table.Number(table.Need("y")), 4.0);
  ASSERT_TRUE(table.Next());
  EXPECT_TRUE(std::isnan(table.Number(table.Need("x")))) << "empty: not a number";
  EXPECT_FALSE(table.Next());
}

TEST_F(Csv, TimesAreExact) {
  // As a double the epoch's second has 119 ns steps.
  CsvTable table = Table(
      "t_s,t_ns\n1732345678.123456789,1732345678123456789\n0.005,5000000\n"
      "3,3000000000\n5e-05,50000\n.25,250000000\n");
  int rows = 0;
  while (table.Next()) {
    if (rows == 4) break;  // a decimal point needs a digit before it
    EXPECT_EQ(table.Time(0, true), table.Time(1, false));
    ++rows;
  }
  EXPECT_EQ(rows, 4);
  EXPECT_THROW((void)table.Time(0, true), InputError);
}

TEST_F(Csv, SaysWhereWhatIsWrong) {
  const auto all = [](CsvTable& table) {
    while (table.Next()) (void)table.Number(1);
  };
  EXPECT_EQ(Complaint("a,b\n1,2\n3\n", all), "a.csv:3:1: error: expected 2 values, found 1");
  EXPECT_EQ(Complaint("a,b\n1,2\n3, x4\n", all),
            "a.csv:3:4: error: 'b': expected a number, found 'x4'");
  EXPECT_EQ(Complaint("a,b,a\n", all), "a.csv:1:1: error: the column 'a' stands twice");
  EXPECT_EQ(Complaint("", all), "a.csv: error: expected a header with the names of its columns");
  EXPECT_EQ(Complaint("t_s,gyro_x_rads\n", [](CsvTable& t) { (void)t.Need("gyro_x_rad_s"); }),
            "a.csv:1:1: error: there is no column 'gyro_x_rad_s'; did you mean 'gyro_x_rads'?");
  const auto time = [](CsvTable& table) {
    (void)table.Next();
    (void)table.Time(0, true);
  };
  for (const char* bad : {"-1", "1.2.3", "1.x", "", "abc", "9999999999999"}) {
    EXPECT_EQ(
        Complaint(std::string("t,b\n") + bad + ",1\n", time),
        std::string("a.csv:2:1: error: 't': expected seconds of at least 0, found '") + bad + "'");
  }
  EXPECT_THROW(CsvTable(folder_ / "none.csv"), InputError);
}

}  // namespace
}  // namespace reckon::harness

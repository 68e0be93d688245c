#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "reckon/ground_truth/truth.h"
#include "reckon/harness/csv_table.h"
#include "reckon/harness/log_file.h"
#include "reckon/models/measurement.h"

namespace reckon::harness {

/// The column of a table's stamps: `<name>_ns`, or else `<name>_s`.
struct TimeColumn {
  std::size_t place = 0;
  bool in_seconds = false;
  models::TimeNs Of(const CsvTable& table) const { return table.Time(place, in_seconds); }
};
std::optional<TimeColumn> FindTime(const CsvTable& table, const std::string& name);
TimeColumn NeedTime(const CsvTable& table, const std::string& name);

/// Places of three columns `<prefix>x<suffix>`, `y`, `z`.
using Columns3 = std::array<std::size_t, 3>;
Columns3 Need3(const CsvTable& table, const std::string& prefix, const std::string& suffix);
std::optional<Columns3> Find3(const CsvTable& table, const std::string& prefix,
                              const std::string& suffix);
Eigen::Vector3d Vector(const CsvTable& table, const Columns3& columns);

/// One sensor's file, row by row, in the files' own time.
class CsvStream {
 public:
  /// Reads the first row. Throws InputError.
  CsvStream(const std::filesystem::path& path, const LogSensor& sensor, models::SensorId id);

  /// The measurement of this row; nothing after the last.
  const std::optional<models::Measurement>& now() const { return now_; }

  /// Goes to the next row.
  void Advance();

 private:
  models::Sample ReadSample();
  models::Sample ReadImu();
  models::Sample ReadEncoders();
  models::Sample ReadVelocity() const;
  models::Sample ReadPose() const;
  template <class Vector>
  Vector ReadChannels() const;
  void FindColumns();
  models::TimeNs Interval() const;

  CsvTable table_;
  LogSensor sensor_;
  models::SensorId id_;
  TimeColumn time_;
  std::optional<TimeColumn> arrival_;
  std::optional<std::size_t> interval_;
  std::vector<std::size_t> columns_;                ///< of the sample, in the order of its kind
  std::vector<std::size_t> more_columns_;           ///< those that need not be there
  std::optional<std::size_t> valid_, over_ground_;  ///< of a velocity
  models::TimeNs last_ns_ = -1, now_ns_ = 0;
  models::EncoderVector last_angle_;
  std::optional<models::Measurement> now_;
};

/// The truth's file, row by row, in the files' own time.
class CsvTruth {
 public:
  explicit CsvTruth(const std::filesystem::path& path);
  const std::optional<ground_truth::Truth>& now() const { return now_; }
  void Advance();

 private:
  CsvTable table_;
  TimeColumn time_;
  Columns3 position_, velocity_;
  std::array<std::size_t, 4> quaternion_;
  std::optional<Columns3> gyro_bias_, accel_bias_;
  std::optional<ground_truth::Truth> now_;
};

}  // namespace reckon::harness

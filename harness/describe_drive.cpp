#include "reckon/harness/describe_drive.h"

namespace reckon::harness {

Rows6 RowsOf(const sim::Matrix6& matrix) {
  Rows6 rows;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) rows[i][j] = matrix(i, j);
  }
  return rows;
}

sim::Matrix6 MatrixOf(const Rows6& rows) {
  sim::Matrix6 matrix;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) matrix(i, j) = rows[i][j];
  }
  return matrix;
}

sim::DriveConfig DefaultDrive(sim::DriveKind kind) {
  switch (kind) {
    case sim::DriveKind::kSkidSteer:
      return sim::SkidSteerConfig{};
    case sim::DriveKind::kUnderwater:
      return sim::UnderwaterConfig{};
    case sim::DriveKind::kLegged:
      return sim::LeggedConfig{};
  }
  return sim::SkidSteerConfig{};
}

}  // namespace reckon::harness

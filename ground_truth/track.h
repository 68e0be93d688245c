#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "reckon/estimator/estimate.h"
#include "reckon/estimator/report.h"
#include "reckon/ground_truth/nees.h"
#include "reckon/ground_truth/truth.h"
#include "reckon/models/measurement.h"
#include "reckon/models/pose.h"

namespace reckon::ground_truth {

/// Which feet stand, in truth and by the estimator: a bit a foot.
struct FeetBelief {
  std::uint8_t stands = 0, believed = 0;
  bool said = false;  ///< whether the estimator says which do

  bool Stands(int foot) const { return ((stands >> foot) & 1) != 0; }
  bool IsBelieved(int foot) const { return ((believed >> foot) & 1) != 0; }
};

/// Truth and estimate of the body at one instant.
struct TrackSample {
  models::TimeNs t_ns = 0;
  models::Pose X_WB_true, X_WB;
  Eigen::Vector3d v_WB_true = Eigen::Vector3d::Zero(), v_WB = Eigen::Vector3d::Zero();
  Eigen::Vector3d gyro_bias_error_rad_s = Eigen::Vector3d::Zero();  ///< estimate − truth
  Eigen::Vector3d accel_bias_error_m_s2 = Eigen::Vector3d::Zero();  ///< estimate − truth
  Nees nees;
  FeetBelief feet;
};

/// One correction, as far as it is scored.
struct TrackCorrection {
  models::TimeNs t_ns = 0;
  models::SensorId sensor = 0;
  estimator::Decision decision = estimator::Decision::kAccepted;
  estimator::Refusal reason = estimator::Refusal::kNone;
  int rows = 0;
  int ordinal = 0;  ///< its place among the corrections that one measurement caused
  double nis = 0.0;
  Eigen::Vector3d whitened = Eigen::Vector3d::Zero();  ///< L⁻¹ z with S = L Lᵀ
};

/// A measurement refused as a whole.
struct TrackRefusal {
  models::TimeNs t_ns = 0;
  models::SensorId sensor = 0;
  estimator::Refusal reason = estimator::Refusal::kNone;
};

/// All that scoring needs of one estimator in one run: truth beside estimate at every estimate's
/// stamp, with the NEES at once, and what became of the measurements. Grows with the run.
class Track {
 public:
  /// `truth` must be of the estimate's instant.
  void Add(const Truth& truth, const estimator::Estimate& estimate);

  /// What an estimator reported of one measurement. Measurements that it has no use for are not
  /// refusals.
  void Add(const models::Measurement& measurement, const estimator::Report& report);
  void Add(const estimator::Correction& correction);
  void AddRefusal(models::SensorId sensor, models::TimeNs valid_ns, estimator::Refusal reason);

  /// An estimate without truth at its stamp: it can't be scored, and no score of the run is whole.
  void AddUnpaired() { ++unpaired_; }
  std::size_t unpaired() const { return unpaired_; }

  const std::vector<TrackSample>& samples() const { return samples_; }
  const std::vector<TrackCorrection>& corrections() const { return corrections_; }
  const std::vector<TrackRefusal>& refusals() const { return refusals_; }
  /// Whether there are biases, estimated and true, to compare.
  bool has_biases() const { return has_biases_; }

  /// Forgets what lies before `start_ns`.
  void DropBefore(models::TimeNs start_ns);

 private:
  std::vector<TrackSample> samples_;
  std::vector<TrackCorrection> corrections_;
  std::vector<TrackRefusal> refusals_;
  std::size_t unpaired_ = 0;
  bool has_biases_ = false;
};

}  // namespace reckon::ground_truth

#include "reckon/ground_truth/track.h"

#include <Eigen/Cholesky>
#include <cassert>

namespace reckon::ground_truth {
namespace {

/// L⁻¹ z of the rows that count, S = L Lᵀ.
Eigen::Vector3d Whiten(const estimator::Correction& correction) {
  Eigen::Matrix3d S = Eigen::Matrix3d::Identity();
  const int n = correction.rows;
  S.topLeftCorner(n, n) = correction.covariance.topLeftCorner(n, n);
  Eigen::Vector3d whitened = Eigen::Vector3d::Zero();
  whitened.head(n) = correction.innovation.head(n);
  const Eigen::LLT<Eigen::Matrix3d> llt(S);
  llt.matrixL().solveInPlace(whitened);
  return whitened;
}

FeetBelief FeetOf(const Truth& truth, const estimator::Estimate& estimate) {
  FeetBelief feet;
  feet.said = estimate.contact.size() > 0 && estimate.contact.size() == truth.feet.count;
  if (!feet.said) return feet;
  for (int i = 0; i < truth.feet.count; ++i) {
    const int bit = 1 << i;
    const bool stands = truth.feet.foot[static_cast<std::size_t>(i)].contact;
    if (stands) feet.stands = static_cast<std::uint8_t>(feet.stands | bit);
    if (estimate.contact[i] > 0.5) feet.believed = static_cast<std::uint8_t>(feet.believed | bit);
  }
  return feet;
}

}  // namespace

void Track::Add(const Truth& truth, const estimator::Estimate& estimate) {
  assert(truth.t_ns == estimate.t_ns);
  samples_.push_back({estimate.t_ns, truth.X_WB, estimate.X_WB, truth.v_WB, estimate.v_WB,
                      estimate.gyro_bias_rad_s - truth.gyro_bias_rad_s,
                      estimate.accel_bias_m_s2 - truth.accel_bias_m_s2,
                      ComputeNees(truth, estimate), FeetOf(truth, estimate)});
  has_biases_ = has_biases_ || (estimate.has_biases && truth.has_biases);
}

void Track::Add(const models::Measurement& measurement, const estimator::Report& report) {
  for (const estimator::Correction& correction : report.corrections()) Add(correction);
  AddRefusal(measurement.sensor, measurement.valid_ns, report.refusal);
}

void Track::Add(const estimator::Correction& correction) {
  const bool same = !corrections_.empty() && corrections_.back().t_ns == correction.t_ns &&
                    corrections_.back().sensor == correction.sensor;
  const int ordinal = same ? corrections_.back().ordinal + 1 : 0;
  corrections_.push_back({correction.t_ns, correction.sensor, correction.decision,
                          correction.reason, correction.rows, ordinal, correction.nis,
                          Whiten(correction)});
}

void Track::AddRefusal(models::SensorId sensor, models::TimeNs valid_ns,
                       estimator::Refusal reason) {
  if (reason == estimator::Refusal::kNone || reason == estimator::Refusal::kUnused) return;
  refusals_.push_back({valid_ns, sensor, reason});
}

void Track::DropBefore(models::TimeNs start_ns) {
  const auto early = [start_ns](const auto& row) { return row.t_ns < start_ns; };
  std::erase_if(samples_, early);
  std::erase_if(corrections_, early);
  std::erase_if(refusals_, early);
}

}  // namespace reckon::ground_truth

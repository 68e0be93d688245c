#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include <Eigen/Core>

#include "reckon/models/measurement.h"

namespace reckon::estimator {

/// What became of a measurement or of one of its corrections.
enum class Decision : std::uint8_t {
  kAccepted,
  kWarned,    ///< outside the gate, applied all the same (gate: warn)
  kInflated,  ///< outside the gate, applied with its noise scaled until it lies on the gate's edge
  kRejected,  ///< outside the gate, not applied
  kRefused,   ///< never came to the gate: see the reason
  kWidened,   ///< outside the gate like most before it, not applied: the belief is widened instead
};

/// Why a measurement was refused.
enum class Refusal : std::uint8_t {
  kNone,
  kNotFinite,
  kNotInitialised,
  kMoving,      ///< static initialisation saw motion and starts over
  kBackwards,   ///< an IMU sample that is not newer than the state
  kLate,        ///< older than the filter can still use
  kFromFuture,  ///< valid after it arrived, or too far ahead of the IMU
  kGap,         ///< its interval is too long to integrate
  kInvalid,     ///< malformed: wrong size, non-positive interval, indefinite covariance
  kUnused,      ///< this estimator has no use for this sensor
  kDuplicate,   ///< the sensor has sent a sample of this stamp before
  kNoLock,      ///< the sensor says itself that it has lost what it measures
};

/// How many reasons there are.
inline constexpr std::size_t kRefusals = static_cast<std::size_t>(Refusal::kNoLock) + 1;

/// Whether a correction of this decision moves the state.
inline bool IsApplied(Decision decision) {
  return decision == Decision::kAccepted || decision == Decision::kWarned ||
         decision == Decision::kInflated;
}

std::string_view Name(Decision decision);
std::string_view Name(Refusal refusal);

inline constexpr int kMaxRows = 3;
inline constexpr int kMaxCorrections = 16;

/// One correction as it was computed: innovation z, its covariance S and NIS = zᵀS⁻¹z, before any
/// gate changed it. Only the first `rows` entries count. The axes are those in which the filter
/// forms the innovation (the body's for velocities); NIS does not depend on them.
struct Correction {
  models::TimeNs t_ns = 0;  ///< when the measurement was true: its valid stamp
  models::SensorId sensor = 0;
  Decision decision = Decision::kAccepted;
  Refusal reason = Refusal::kNone;
  int rows = 0;
  Eigen::Vector3d innovation = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double nis = 0.0;
};

/// What one call of `Estimator::Process` did: fixed capacity, so that no step allocates.
class [[nodiscard]] Report {
 public:
  /// A view into this report: a temporary one gives none, since a loop over it would outlive it.
  std::span<const Correction> corrections() const& { return {corrections_.data(), size_}; }
  std::span<const Correction> corrections() const&& = delete;
  /// Adds `correction`; more than `kMaxCorrections` is a bug.
  void Add(const Correction& correction);

  Refusal refusal = Refusal::kNone;  ///< the measurement as a whole, an IMU sample included
  bool propagated = false;           ///< the state's time moved
  models::TimeNs bridged_ns = 0;     ///< time without IMU samples that was bridged
  bool reanchored = false;           ///< after a gap too long to bridge the filter started again

 private:
  std::array<Correction, kMaxCorrections> corrections_;
  std::size_t size_ = 0;
};

}  // namespace reckon::estimator

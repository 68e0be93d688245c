#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "reckon/ground_truth/alignment.h"
#include "reckon/ground_truth/ate.h"
#include "reckon/ground_truth/body_errors.h"
#include "reckon/ground_truth/contact_scores.h"
#include "reckon/ground_truth/drift.h"
#include "reckon/ground_truth/metrics.h"
#include "reckon/ground_truth/nis.h"
#include "reckon/ground_truth/recording_columns.h"
#include "reckon/ground_truth/rpe.h"
#include "reckon/ground_truth/statistics.h"

namespace reckon::ground_truth {
namespace {

using Samples = std::span<const TrackSample>;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// How a quantity's unit is written in a metric's name and for a reader; squared for the sse.
struct Unit {
  std::string suffix, squared_suffix, text, squared_text;
};

const Unit kMetres{"_m", "_m2", "m", "m^2"};
const Unit kDegrees{"_deg", "_deg2", "deg", "deg^2"};
const Unit kMetresPerSecond{"_m_s", "_m2_s2", "m/s", "m^2/s^2"};
const Unit kMetresUnnamed{"", "", "m", "m^2"};

/// `<prefix>_rmse<unit>`, …: the seven statistics.
void AddStatistics(Metrics& metrics, const std::string& prefix, const Unit& unit,
                   std::span<const double> errors, const std::string& meaning,
                   bool applies = true) {
  const Statistics s = Summarise(errors);
  const std::array<std::pair<const char*, double>, 6> plain{{{"rmse", s.rmse},
                                                             {"mean", s.mean},
                                                             {"median", s.median},
                                                             {"std", s.std},
                                                             {"min", s.min},
                                                             {"max", s.max}}};
  for (const auto& [name, value] : plain) {
    metrics.Add({prefix + "_" + name + unit.suffix, value, applies, unit.text,
                 std::string(name) + " of " + meaning});
  }
  metrics.Add({prefix + "_sse" + unit.squared_suffix, s.sse, applies, unit.squared_text,
               "sum of squares of " + meaning});
}

void AddAbsolute(Metrics& metrics, Samples samples, Alignment align) {
  const AbsoluteErrors errors = AbsoluteError(samples, Align(align, samples));
  AddStatistics(metrics, "ate_position", kMetres, errors.position_m,
                "the position error after alignment");
  AddStatistics(metrics, "ate_orientation", kDegrees, errors.orientation_deg,
                "the angle of the orientation error after alignment");
  AddStatistics(metrics, "ate_velocity", kMetresPerSecond, errors.velocity_m_s,
                "the velocity error after alignment");
}

void AddBody(Metrics& metrics, Samples samples) {
  const BodyErrors errors = BodyError(samples);
  AddStatistics(metrics, "tilt_error", kDegrees, errors.tilt_deg,
                "the angle between true and estimated vertical, never aligned");
  AddStatistics(metrics, "heading_error", kDegrees, errors.heading_deg,
                "the orientation error's twist about the vertical, never aligned");
  AddStatistics(metrics, "body_velocity_error", kMetresPerSecond, errors.velocity_m_s,
                "the velocity error in body axes, never aligned");
}

/// A length in a metric's name: `1`, `0p5`.
std::string LengthName(double length) {
  std::string name = fmt::format("{}", length);
  std::replace(name.begin(), name.end(), '.', 'p');
  return name;
}

/// The relative errors over `pairs`, named `<prefix>_translation_…` and `<prefix>_rotation_…`.
void AddSegments(Metrics& metrics, Samples samples, const IndexPairs& pairs,
                 const std::string& prefix, const Unit& translation_unit, const std::string& over) {
  const RelativeErrors errors = RelativeError(samples, pairs);
  AddStatistics(metrics, prefix + "_translation", translation_unit, errors.translation_m,
                "the relative position error" + over, !pairs.empty());
  AddStatistics(metrics, prefix + "_rotation", kDegrees, errors.rotation_deg,
                "the relative rotation error" + over, !pairs.empty());
}

void AddRelative(Metrics& metrics, Samples samples, const ScoreOptions& options) {
  for (const double length : options.rpe_m) {
    AddSegments(metrics, samples, PairsByPath(samples, length, PairChoice::kAll),
                "rpe_" + LengthName(length) + "m", kMetresUnnamed,
                fmt::format(" over each {} m of true path", length));
  }
  for (const double length : options.rpe_s) {
    AddSegments(metrics, samples, PairsByTime(samples, length, PairChoice::kAll),
                "rpe_" + LengthName(length) + "s", kMetres, fmt::format(" over each {} s", length));
  }
}

void AddDrift(Metrics& metrics, const Track& track) {
  const Samples samples = track.samples();
  const Drift drift = DriftOf(samples);
  const std::string start = "after yaw and position of the first pose are aligned";
  metrics.Add({"final_drift_m", drift.final_m, true, "m", "position error at the end, " + start});
  metrics.Add(
      {"final_drift_deg", drift.final_deg, true, "deg", "orientation error at the end, " + start});
  const bool standing = !(drift.path_m >= kStandingPathM);
  metrics.Add({"final_drift_percent", drift.percent, !standing, "%",
               "final drift over true path; none for a standing run"});
  metrics.Add({"drift_m_per_min", drift.m_per_min, true, "m/min", "final drift over duration"});
  metrics.Add({"drift_deg_per_min", drift.deg_per_min, true, "deg/min",
               "final orientation drift over duration"});
  metrics.Add({"path_length_m", drift.path_m, true, "m", "accumulated true path"});
  metrics.Add(
      {"duration_s", drift.duration_s, true, "s", "from the first scored estimate to the last"});
  metrics.Add({"estimate_count", static_cast<double>(samples.size()), true, "count",
               "estimates that are scored"});
  metrics.Add({"unpaired_estimate_count", static_cast<double>(track.unpaired()), true, "count",
               "estimates without truth at their stamps: not 0, no score of this run is whole"});
}

double MeanNees(Samples samples, std::size_t block) {
  double sum = 0.0;
  for (const TrackSample& sample : samples) sum += sample.nees.value[block];
  return samples.empty() ? kNone : sum / static_cast<double>(samples.size());
}

void AddNees(Metrics& metrics, const Track& track) {
  const Samples samples = track.samples();
  for (std::size_t block = 0; block < kNeesBlocks; ++block) {
    const int dof = NeesDof(static_cast<int>(block));
    const bool applies = std::any_of(samples.begin(), samples.end(), [block](const auto& sample) {
      return sample.nees.estimated[block];
    });
    metrics.Add({fmt::format("nees_{}_mean", NeesBlockName(static_cast<int>(block))),
                 MeanNees(samples, block), applies, "1",
                 fmt::format("time-mean of the normalised error squared; {} is honest", dof)});
  }
  const auto indefinite = std::count_if(samples.begin(), samples.end(),
                                        [](const auto& sample) { return sample.nees.indefinite; });
  metrics.Add({"indefinite_covariance_count", static_cast<double>(indefinite), true, "count",
               "estimates whose covariance is not positive definite"});
}

void AddBiases(Metrics& metrics, const Track& track) {
  std::vector<double> gyro, accel;
  for (const TrackSample& sample : track.samples()) {
    gyro.push_back(sample.gyro_bias_error_rad_s.norm());
    accel.push_back(sample.accel_bias_error_m_s2.norm());
  }
  const auto add = [&](const std::string& name, const std::string& unit, const std::string& text,
                       const std::vector<double>& errors, const std::string& what) {
    const bool applies = track.has_biases();
    metrics.Add({name + "_rmse_" + unit, applies ? Summarise(errors).rmse : kNone, applies, text,
                 "rmse of the " + what + " bias error"});
    metrics.Add({name + "_final_" + unit, applies ? errors.back() : kNone, applies, text,
                 what + " bias error at the end"});
  };
  add("gyro_bias_error", "rad_s", "rad/s", gyro, "gyroscope");
  add("accel_bias_error", "m_s2", "m/s^2", accel, "accelerometer");
}

void AddSensor(Metrics& metrics, const Track& track, models::SensorId id, const std::string& name) {
  const NisStatistics nis = NisOf(track.corrections(), id);
  const bool applies = nis.corrections > 0;
  metrics.Add({"nis_" + name + "_mean", nis.mean, applies, "1",
               "time-mean of the normalised innovation squared, rejected ones included"});
  metrics.Add({"nis_" + name + "_dof", nis.dof, applies, "1", "what that mean is if honest"});
  metrics.Add({"nis_" + name + "_lag1", nis.lag1, applies, "1",
               "correlation of successive innovations; white is within 5/sqrt(count)"});
  const DecisionCounts counts = CountDecisions(track, id);
  for (std::size_t i = 0; i < kDecisions; ++i) {
    if (static_cast<estimator::Decision>(i) == estimator::Decision::kRefused) continue;
    const std::string decision(DecisionNames()[i]);
    metrics.Add({decision + "_" + name + "_count", static_cast<double>(counts.decisions[i]), true,
                 "count", "corrections that were " + decision});
  }
  for (std::size_t i = 0; i < kRefusals; ++i) {
    const auto refusal = static_cast<estimator::Refusal>(i);
    if (refusal == estimator::Refusal::kNone || refusal == estimator::Refusal::kUnused) continue;
    const std::string reason(RefusalNames()[i]);
    metrics.Add({"refused_" + name + "_" + reason + "_count",
                 static_cast<double>(counts.refusals[i]), true, "count",
                 "measurements refused: " + reason});
  }
}

void AddContacts(Metrics& metrics, const Track& track, const std::vector<std::string>& feet) {
  const Samples samples = track.samples();
  const bool applies = std::any_of(samples.begin(), samples.end(),
                                   [](const TrackSample& sample) { return sample.feet.said; });
  const ContactScores scores = ScoreContacts(samples, static_cast<int>(feet.size()));
  const auto add = [&](const std::string& name, double share, const std::string& meaning) {
    const bool counts = applies && std::isfinite(share);
    metrics.Add({"contact_" + name + "_percent", 100.0 * share, counts, "%", meaning});
  };
  add("accuracy", scores.accuracy, "contacts believed rightly, over instants and feet");
  add("accuracy_all", scores.all_accuracy, "instants at which all feet are believed rightly");
  for (std::size_t i = 0; i < feet.size(); ++i) {
    add("accuracy_" + feet[i], scores.foot_accuracy[i], "contacts of that foot believed rightly");
  }
  add("false_positive", scores.false_positive_rate, "swinging feet that are believed to stand");
  add("false_negative", scores.false_negative_rate, "standing feet that are believed to swing");
  metrics.Add({"contact_touchdown_delay_s", scores.touchdown_delay_s,
               applies && scores.touchdowns > 0, "s", "mean, from touchdown to its belief"});
  metrics.Add({"contact_liftoff_delay_s", scores.liftoff_delay_s, applies && scores.liftoffs > 0,
               "s", "mean, from lift-off to its belief"});
  metrics.Add({"contact_missed_count",
               static_cast<double>(scores.missed_touchdowns + scores.missed_liftoffs), applies,
               "count", "touchdowns and lift-offs that the belief never saw"});
}

}  // namespace

Metrics Score(const Track& track, const std::vector<std::string>& sensors,
              const ScoreOptions& options, const std::vector<std::string>& feet) {
  Metrics metrics;
  AddAbsolute(metrics, track.samples(), options.align);
  AddBody(metrics, track.samples());
  AddRelative(metrics, track.samples(), options);
  AddDrift(metrics, track);
  AddNees(metrics, track);
  AddBiases(metrics, track);
  for (std::size_t id = 0; id < sensors.size(); ++id) {
    AddSensor(metrics, track, static_cast<models::SensorId>(id), sensors[id]);
  }
  if (!feet.empty()) AddContacts(metrics, track, feet);
  return metrics;
}

Metrics MetricCatalogue(const std::vector<std::string>& sensors, const ScoreOptions& options,
                        const std::vector<std::string>& feet) {
  return Score(Track(), sensors, options, feet);
}

}  // namespace reckon::ground_truth

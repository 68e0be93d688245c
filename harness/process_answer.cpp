#include "reckon/harness/process_answer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

namespace reckon::harness {
namespace {

using estimator::ErrorForm;
using Json = nlohmann::ordered_json;

constexpr double kQuaternionTolerance = 1e-3;
constexpr double kSymmetryTolerance = 1e-6;    // of √(P_ii P_jj)
constexpr double kIndefiniteTolerance = 1e-8;  // of the correlation matrix's eigenvalues

constexpr std::array<ErrorFormName, 3> kForms{{
    {ErrorForm::kRightInvariant, "right_invariant",
     "theta = Log(R_hat R'), xi_v = J(theta)^-1 (v_hat - R_hat R' v), likewise p; axes of W"},
    {ErrorForm::kLeftInvariant, "left_invariant",
     "theta = Log(R' R_hat), xi_v = J(theta)^-1 R' (v_hat - v), likewise p; axes of B"},
    {ErrorForm::kMultiplicative, "multiplicative",
     "theta = Log(R' R_hat) in axes of B; v_hat - v and p_hat - p in axes of W"},
}};

std::string Shortened(std::string_view text) {
  constexpr std::size_t kLength = 160;
  return "'" + std::string(text.substr(0, kLength)) + (text.size() > kLength ? "…'" : "'");
}

[[noreturn]] void Refuse(std::string_view expected, std::string_view found) {
  throw BadAnswer("expected " + std::string(expected) + ", found " + std::string(found));
}

std::string Text(const Json& value) {
  return Shortened(value.dump(-1, ' ', false, Json::error_handler_t::replace));
}

Json ParseObject(std::string_view line) {
  Json object;
  try {
    object = Json::parse(line);
  } catch (const Json::exception&) {
    Refuse("one JSON object on one line (NaN and Infinity are not JSON)", Shortened(line));
  }
  if (!object.is_object()) Refuse("a JSON object", Shortened(line));
  return object;
}

void CheckKeys(const Json& object, std::initializer_list<std::string_view> known) {
  for (const auto& [key, value] : object.items()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    std::string expected = "only the keys";
    for (const std::string_view name : known) expected += " " + std::string(name);
    Refuse(expected, Shortened(key));
  }
}

const Json& Member(const Json& object, const std::string& key) {
  const auto found = object.find(key);
  if (found == object.end()) Refuse("the key '" + key + "'", Text(object));
  return *found;
}

std::vector<double> NumberList(const Json& object, const std::string& key,
                               std::initializer_list<std::size_t> sizes) {
  const Json& list = Member(object, key);
  std::string expected = "'" + key + "' to be a list of ";
  for (const std::size_t size : sizes) {
    expected += (size == *sizes.begin() ? "" : " or ") + std::to_string(size);
  }
  expected += " finite numbers";
  if (!list.is_array()) Refuse(expected, Text(list));
  if (std::find(sizes.begin(), sizes.end(), list.size()) == sizes.end()) {
    Refuse(expected, std::to_string(list.size()) + " entries: " + Text(list));
  }
  std::vector<double> numbers;
  numbers.reserve(list.size());
  for (const Json& entry : list) {
    if (!entry.is_number() || !std::isfinite(entry.get<double>())) {
      Refuse(expected, Text(entry) + " at index " + std::to_string(numbers.size()));
    }
    numbers.push_back(entry.get<double>());
  }
  return numbers;
}

Eigen::Vector3d Vector(const Json& object, const std::string& key) {
  const std::vector<double> numbers = NumberList(object, key, {3});
  return {numbers[0], numbers[1], numbers[2]};
}

Eigen::Matrix3d Rotation(const Json& object, const std::string& key) {
  const std::vector<double> q = NumberList(object, key, {4});
  const Eigen::Quaterniond q_WB(q[0], q[1], q[2], q[3]);
  if (!(std::abs(q_WB.norm() - 1.0) <= kQuaternionTolerance)) {
    Refuse("'" + key + "' = [w, x, y, z] with norm 1 within 1e-3",
           "norm " + Json(q_WB.norm()).dump() + ": " + Text(Member(object, key)));
  }
  return q_WB.normalized().toRotationMatrix();
}

std::int64_t Integer(const Json& object, const std::string& key) {
  const Json& value = Member(object, key);
  if (!value.is_number_integer()) Refuse("'" + key + "' to be an integer", Text(value));
  return value.get<std::int64_t>();
}

/// Row-major: all n² entries, or the upper triangle row by row.
Eigen::MatrixXd SymmetricMatrix(const std::vector<double>& numbers, Eigen::Index size) {
  const bool full = static_cast<Eigen::Index>(numbers.size()) == size * size;
  Eigen::MatrixXd P(size, size);
  auto next = numbers.begin();
  for (Eigen::Index row = 0; row < size; ++row) {
    for (Eigen::Index column = full ? 0 : row; column < size; ++column) {
      P(row, column) = *next++;
      if (!full) P(column, row) = P(row, column);
    }
  }
  return P;
}

std::string Entry(Eigen::Index row, Eigen::Index column) {
  return "(" + std::to_string(row) + ", " + std::to_string(column) + ")";
}

/// Refuses what is not symmetric and positive semidefinite, relative to its own diagonal (units
/// differ from block to block); returns it exactly symmetric.
Eigen::MatrixXd CheckedCovariance(const Eigen::MatrixXd& P, const std::string& key) {
  const Eigen::Index size = P.rows();
  Eigen::MatrixXd correlation = Eigen::MatrixXd::Identity(size, size);
  for (Eigen::Index row = 0; row < size; ++row) {
    if (P(row, row) < 0.0) {
      Refuse("'" + key + "' with a diagonal >= 0",
             Json(P(row, row)).dump() + " at " + Entry(row, row));
    }
    for (Eigen::Index column = 0; column < row; ++column) {
      const double scale = std::sqrt(P(row, row)) * std::sqrt(P(column, column));
      const double mean = 0.5 * (P(row, column) + P(column, row));
      if (!(std::abs(P(row, column) - P(column, row)) <= kSymmetryTolerance * scale)) {
        Refuse("'" + key + "' to be symmetric",
               Json(P(row, column)).dump() + " at " + Entry(row, column) + " and " +
                   Json(P(column, row)).dump() + " at " + Entry(column, row));
      }
      if (!(std::abs(mean) <= scale * (1.0 + kIndefiniteTolerance))) {
        Refuse("'" + key + "' to be positive semidefinite",
               "a correlation beyond 1 at " + Entry(row, column));
      }
      correlation(row, column) = correlation(column, row) = scale > 0.0 ? mean / scale : 0.0;
    }
  }
  correlation.diagonal().array() += kIndefiniteTolerance;
  if (correlation.llt().info() != Eigen::Success) {
    Refuse("'" + key + "' to be positive semidefinite", "a negative eigenvalue");
  }
  return 0.5 * (P + P.transpose());
}

estimator::Estimate ParseBelief(const Json& object, const AnswerContext& context) {
  estimator::Estimate belief;
  belief.t_ns = Integer(object, "t_ns");
  if (belief.t_ns < context.earliest_ns || belief.t_ns > context.latest_ns) {
    Refuse("'t_ns' between " + std::to_string(context.earliest_ns) + " (the previous belief) and " +
               std::to_string(context.latest_ns) + " (the newest stamp that was sent)",
           std::to_string(belief.t_ns));
  }
  belief.X_WB = {Rotation(object, "q_WB"), Vector(object, "p_WB")};
  belief.v_WB = Vector(object, "v_WB");
  belief.form = context.form;
  belief.has_biases = object.contains("gyro_bias_rad_s") || object.contains("accel_bias_m_s2");
  if (belief.has_biases) {
    belief.gyro_bias_rad_s = Vector(object, "gyro_bias_rad_s");
    belief.accel_bias_m_s2 = Vector(object, "accel_bias_m_s2");
  }
  belief.has_covariance = object.contains("covariance");
  if (belief.has_covariance) {
    const auto numbers = NumberList(object, "covariance", {225, 120});
    belief.covariance =
        CheckedCovariance(SymmetricMatrix(numbers, estimator::kErrorSize), "covariance");
  }
  return belief;
}

/// The value called `value` in `names`, whose order is the enumeration's.
template <typename Enum, std::size_t size>
Enum Named(const Json& value, const std::string& key,
           const std::array<std::string_view, size>& names) {
  std::string expected = "'" + key + "' to be one of";
  for (std::size_t i = 0; i < size; ++i) {
    if (value == names[i]) return static_cast<Enum>(i);
    expected += " " + std::string(names[i]);
  }
  Refuse(expected, Text(value));
}

constexpr std::array<std::string_view, 6> kDecisions{"accepted", "warned",  "inflated",
                                                     "rejected", "refused", "widened"};
constexpr std::array<std::string_view, estimator::kRefusals> kRefusals{
    "none",        "not_finite", "not_initialised", "moving", "backwards", "late",
    "from_future", "gap",        "invalid",         "unused", "duplicate", "no_lock"};
static_assert(static_cast<std::size_t>(estimator::Decision::kWidened) + 1 == kDecisions.size());

estimator::Correction ParseCorrection(const Json& object, const AnswerContext& context) {
  if (!object.is_object()) Refuse("'corrections' to be a list of objects", Text(object));
  CheckKeys(object, {"sensor", "t_ns", "innovation", "covariance", "decision"});
  estimator::Correction correction;
  correction.t_ns = object.contains("t_ns") ? Integer(object, "t_ns") : context.valid_ns;
  correction.sensor = context.sensor;
  if (object.contains("sensor")) {
    const std::int64_t sensor = Integer(object, "sensor");
    if (sensor < 0 || static_cast<std::size_t>(sensor) >= context.sensors) {
      Refuse("'sensor' to be an id of 'hello'", Text(object));
    }
    correction.sensor = static_cast<models::SensorId>(sensor);
  }
  correction.decision =
      Named<estimator::Decision>(Member(object, "decision"), "decision", kDecisions);
  const auto z = NumberList(object, "innovation", {1, 2, 3});
  const auto rows = static_cast<Eigen::Index>(z.size());
  const auto S_numbers = NumberList(object, "covariance", {z.size() * z.size()});
  const Eigen::MatrixXd S =
      CheckedCovariance(SymmetricMatrix(S_numbers, rows), "corrections.covariance");
  const Eigen::LLT<Eigen::MatrixXd> factor(S);
  if (factor.info() != Eigen::Success) {
    Refuse("'corrections.covariance' to be positive definite", Text(object));
  }
  correction.rows = static_cast<int>(rows);
  correction.innovation.head(rows) = Eigen::Map<const Eigen::VectorXd>(z.data(), rows);
  correction.covariance.topLeftCorner(rows, rows) = S;
  correction.nis = factor.matrixL().solve(correction.innovation.head(rows)).squaredNorm();
  return correction;
}

}  // namespace

std::span<const ErrorFormName> ErrorFormNames() { return kForms; }

estimator::ErrorForm ParseReady(std::string_view line) {
  const Json object = ParseObject(line);
  CheckKeys(object, {"ready", "error"});
  if (Member(object, "ready") != true) Refuse("'ready' to be true", Text(object));
  const Json& error = Member(object, "error");
  std::string expected = "'error' to be one of";
  for (const ErrorFormName& form : kForms) {
    if (error == form.name) return form.form;
    expected += " " + std::string(form.name);
  }
  Refuse(expected, Text(error));
}

ProcessAnswer ParseAnswer(std::string_view line, const AnswerContext& context) {
  const Json object = ParseObject(line);
  CheckKeys(object, {"t_ns", "q_WB", "p_WB", "v_WB", "gyro_bias_rad_s", "accel_bias_m_s2",
                     "covariance", "corrections", "refusal"});
  ProcessAnswer answer;
  if (const auto refusal = object.find("refusal"); refusal != object.end()) {
    answer.report.refusal = Named<estimator::Refusal>(*refusal, "refusal", kRefusals);
  }
  if (const auto corrections = object.find("corrections"); corrections != object.end()) {
    if (!corrections->is_array() || corrections->size() > estimator::kMaxCorrections) {
      Refuse("'corrections' to be a list of at most " + std::to_string(estimator::kMaxCorrections),
             Text(*corrections));
    }
    for (const Json& entry : *corrections) {
      answer.report.Add(ParseCorrection(entry, context));
    }
  }
  constexpr std::array kBeliefKeys{
      "t_ns", "q_WB", "p_WB", "v_WB", "gyro_bias_rad_s", "accel_bias_m_s2", "covariance"};
  if (std::any_of(kBeliefKeys.begin(), kBeliefKeys.end(),
                  [&object](const char* key) { return object.contains(key); })) {
    answer.belief = ParseBelief(object, context);
  }
  return answer;
}

}  // namespace reckon::harness

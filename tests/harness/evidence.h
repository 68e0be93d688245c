#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "harness/seeds.h"
#include "reckon/ground_truth/consistency.h"

namespace reckon::harness {

/// What many runs say of one estimator: NEES per block (a row a seed, a column a time), and the
/// innovations of its sensors.
class Evidence {
 public:
  static constexpr int kTimes = 10;

  explicit Evidence(int seeds = 0) {
    for (auto& nees : nees_) nees.resize(seeds, kTimes);
  }

  void Add(const ground_truth::Track& track, int seed) {
    for (int block = 0; block < ground_truth::kNeesBlocks; ++block) {
      nees_[static_cast<std::size_t>(block)].row(seed - 1) = NeesAtTimes(track, block, kTimes);
    }
    std::map<models::SensorId, const ground_truth::TrackCorrection*> last;
    for (const auto& correction : track.corrections()) {
      nis_ += correction.nis;
      rows_ += correction.rows;
      if (const auto* before = last[correction.sensor]) {
        lag_ += correction.whitened.dot(before->whitened);
        lag_rows_ += correction.rows;
      }
      last[correction.sensor] = &correction;
    }
  }

  double nis_a_row() const { return nis_ / rows_; }

  /// What is dishonest about the estimator; empty if nothing is. The false alarm is split evenly
  /// over all blocks and times, the mean NIS and its whiteness.
  std::vector<std::string> Complaints(double false_alarm) const {
    const double each = false_alarm / (ground_truth::kNeesBlocks + 2);
    std::vector<std::string> complaints;
    for (int block = 0; block < ground_truth::kNeesBlocks; ++block) {
      const auto anees = ground_truth::AneesOf(nees_[static_cast<std::size_t>(block)],
                                               ground_truth::NeesDof(block), each);
      if (anees.holds()) continue;
      std::ostringstream text;
      text << "ANEES " << ground_truth::NeesBlockName(block) << " " << anees.mean.transpose()
           << " outside " << anees.bounds.lower << " … " << anees.bounds.upper;
      complaints.push_back(text.str());
    }
    const auto bounds = ground_truth::ChiSquareMeanBounds(1.0, rows_, each);
    if (!bounds.Contains(nis_a_row())) {
      std::ostringstream text;
      text << "mean NIS a row " << nis_a_row() << " outside " << bounds.lower << " … "
           << bounds.upper;
      complaints.push_back(text.str());
    }
    const double lag = lag_ / lag_rows_;
    if (std::abs(lag) > 5.0 / std::sqrt(lag_rows_)) {
      complaints.push_back("innovations are not white: lag-1 correlation " + std::to_string(lag));
    }
    return complaints;
  }

 private:
  std::array<Eigen::MatrixXd, ground_truth::kNeesBlocks> nees_;
  double nis_ = 0.0, rows_ = 0.0;
  double lag_ = 0.0, lag_rows_ = 0.0;  ///< Σ whitened_k · whitened_{k+1} of each sensor
};

/// Runs `seeds` seeds and gathers what they say of each estimator.
inline std::map<std::string, Evidence> EvidenceOf(const Scenario& scenario, int seeds) {
  std::map<std::string, Evidence> evidence;
  for (const auto& [name, estimator] : scenario.estimators) evidence.emplace(name, seeds);
  ForSeeds(scenario, seeds, [&](int seed, const auto& tracks) {
    for (const auto& [name, track] : tracks) evidence.at(name).Add(track, seed);
  });
  return evidence;
}

/// One line an item, indented.
inline std::string Lines(const std::vector<std::string>& items) {
  std::string text;
  for (const auto& item : items) text += "\n    " + item;
  return text;
}

/// Those that are called `honest` have no complaint against them, and each of the others has one.
inline void ExpectHonest(const std::set<std::string>& honest,
                         const std::map<std::string, Evidence>& evidence, double false_alarm) {
  for (const auto& [name, found] : evidence) {
    const auto complaints = found.Complaints(false_alarm);
    EXPECT_EQ(complaints.empty(), honest.contains(name)) << name << Lines(complaints);
    std::cout << name << ": mean NIS a row " << found.nis_a_row() << ", " << complaints.size()
              << " complaints" << Lines(complaints) << "\n";
  }
}

}  // namespace reckon::harness

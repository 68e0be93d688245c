#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "reckon/estimator/estimator.h"

namespace reckon::estimator {

/// One kind of estimator: its name in a scenario, a sentence, and how it is made.
struct RegistryEntry {
  std::string_view name;
  std::string_view description;
  std::unique_ptr<Estimator> (*make)(const Setup&);
};

/// All estimators that are built in: one table, one line each.
std::span<const RegistryEntry> Registry();

/// The entry called `name`; null if there is none.
const RegistryEntry* FindEstimator(std::string_view name);

}  // namespace reckon::estimator

#pragma once

#include <string>

namespace reckon::harness {

/// What a scenario can name: robots, estimators, sensors, grades (and which fields their sources
/// leave blank), terrains, motions, faults, metrics and the scenarios at hand; one line each.
/// `what` picks one section; empty: all. Throws InputError for a section that doesn't exist.
std::string ListText(const std::string& what = {});

/// All sections as JSON: {"robots": [{"name": …, "description": …}, …], …}.
std::string ListJson(const std::string& what = {});

}  // namespace reckon::harness

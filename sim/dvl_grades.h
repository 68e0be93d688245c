#pragma once

#include <span>
#include <string_view>

#include "reckon/sim/sensor_config.h"

namespace reckon::sim {

/// A named set of a Doppler log's numbers: those of a data sheet, or of a simulator's model of it.
/// What the source leaves open is that of the ideal one. A tolerance of ± x becomes σ = x / 2.
struct DvlGrade {
  std::string_view name;
  DvlConfig config;
  std::string_view source;
};

/// All grades, in the order in which a list shows them.
std::span<const DvlGrade> DvlGrades();

/// The grade of that name; null if there is none.
const DvlGrade* FindDvlGrade(std::string_view name);

}  // namespace reckon::sim

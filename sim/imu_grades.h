#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/sim/sensor_config.h"

namespace reckon::sim {

/// A named set of an inertial unit's errors: numbers of a data sheet, or of a simulator's model of
/// it.
///
/// What the source leaves open is zero (see `BlankFields`). Conversions, the same for all grades:
/// - a bias instability quoted as the minimum of the Allan deviation (most data sheets) becomes the
///   Gauss-Markov σ_B = 1.62 · value, since that process peaks at 0.618 σ_B; where the source
///   quotes the σ of the process itself, or the density that drives it (σ_B = density √(τ/2)),
///   `source` says so;
/// - a part's tolerance of ± x becomes σ = x / 3.
struct ImuGrade {
  std::string_view name;
  std::string_view alias;  ///< a second name, or empty
  TriadErrors gyro, accel;
  std::string_view source;
};

/// All grades, in the order in which a list shows them.
std::span<const ImuGrade> ImuGrades();

/// The grade of that name or alias; null if there is none.
const ImuGrade* FindImuGrade(std::string_view name);

/// The errors that a grade leaves at zero because its source gives no number, as "gyro.scale".
std::vector<std::string> BlankFields(const ImuGrade& grade);

}  // namespace reckon::sim

#include "reckon/sim/range.h"

#include <sstream>
#include <stdexcept>

namespace reckon::sim {

void RequireIn(const Range& range, double value, const std::string& section,
               const std::string& key) {
  if (range.Holds(value)) return;
  std::ostringstream text;
  text << section << ": " << key << " is " << value << ", expected "
       << (range.above_min ? "a number above " : "a number of at least ") << range.min
       << " and at most " << range.max;
  throw std::invalid_argument(text.str());
}

}  // namespace reckon::sim

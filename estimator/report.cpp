#include "reckon/estimator/report.h"

#include <cassert>

namespace reckon::estimator {

std::string_view Name(Decision decision) {
  switch (decision) {
    case Decision::kAccepted:
      return "accepted";
    case Decision::kWarned:
      return "warned";
    case Decision::kInflated:
      return "inflated";
    case Decision::kRejected:
      return "rejected";
    case Decision::kRefused:
      return "refused";
    case Decision::kWidened:
      return "widened";
  }
  return "unknown";
}

std::string_view Name(Refusal refusal) {
  switch (refusal) {
    case Refusal::kNone:
      return "none";
    case Refusal::kNotFinite:
      return "not_finite";
    case Refusal::kNotInitialised:
      return "not_initialised";
    case Refusal::kMoving:
      return "moving";
    case Refusal::kBackwards:
      return "backwards";
    case Refusal::kLate:
      return "late";
    case Refusal::kFromFuture:
      return "from_future";
    case Refusal::kGap:
      return "gap";
    case Refusal::kInvalid:
      return "invalid";
    case Refusal::kUnused:
      return "unused";
    case Refusal::kDuplicate:
      return "duplicate";
    case Refusal::kNoLock:
      return "no_lock";
  }
  return "unknown";
}

void Report::Add(const Correction& correction) {
  assert(size_ < corrections_.size());
  if (size_ < corrections_.size()) corrections_[size_++] = correction;
}

}  // namespace reckon::estimator

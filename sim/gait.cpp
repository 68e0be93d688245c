#include "reckon/sim/gait.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace reckon::sim {
namespace {

constexpr double kLostContact = 0.03;  // s without force before a stance is taken for lost
constexpr double kNearLift = 0.8;      // of the stance: then it may be unloaded on purpose
constexpr double kAboutToLift = 0.02;  // of a stride
constexpr double kLongestWait = 0.2;   // s
constexpr int kTouches = 2;            // ticks

Gait OwnGait(GaitKind kind) {
  switch (kind) {
    case GaitKind::kWalk:
      return {0.8, 0.78, {0.0, 0.5, 0.75, 0.25}};
    case GaitKind::kPace:
      return {0.45, 0.58, {0.0, 0.5, 0.0, 0.5}};
    case GaitKind::kPronk:
      return {0.45, 0.58, {0.0, 0.0, 0.0, 0.0}};
    case GaitKind::kBound:
      return {0.45, 0.58, {0.0, 0.0, 0.5, 0.5}};
    case GaitKind::kTrot:
      break;
  }
  return {0.45, 0.58, {0.0, 0.5, 0.5, 0.0}};
}

}  // namespace

Gait NamedGait(const GaitConfig& config, int feet, double time_scale) {
  Gait gait = OwnGait(config.kind);
  gait.period_s = config.period_s.value_or(gait.period_s * time_scale);
  gait.duty = config.duty.value_or(gait.duty);
  if (config.offsets) gait.offsets = *config.offsets;
  RequireIn(GaitConfig::kPeriod, gait.period_s, "control/gait", "period_s");
  RequireIn(GaitConfig::kDuty, gait.duty, "control/gait", "duty");
  for (const double offset : gait.offsets) {
    RequireIn(GaitConfig::kOffset, offset, "control/gait", "offsets");
  }
  if (static_cast<int>(gait.offsets.size()) != feet) {
    throw std::invalid_argument("control/gait: offsets has " + std::to_string(gait.offsets.size()) +
                                " entries, expected one a foot, " + std::to_string(feet));
  }
  return gait;
}

GaitClock::GaitClock(const Gait& gait, int feet) : gait_(gait), feet_(feet) {}

void GaitClock::Start() {
  walking_ = true;
  t_s_ = waited_s_ = 0.0;
  legs_.fill({});
}

void GaitClock::Stop() {
  walking_ = false;
  legs_.fill({});
}

double GaitClock::swing(int leg) const {
  return std::clamp((legs_[leg].phase - gait_.duty) / (1.0 - gait_.duty), 0.0, 1.0);
}

bool GaitClock::MustWait() const {
  bool late = false, lifts = false;
  for (int i = 0; i < feet_; ++i) {
    late |= legs_[i].state == LegPhase::kLate;
    const double left = gait_.duty - legs_[i].phase;
    lifts |= legs_[i].state == LegPhase::kStance && left > 0.0 && left < kAboutToLift;
  }
  return late && lifts;
}

void GaitClock::Update(double dt_s, const Contacts& contact) {
  for (int i = 0; i < feet_; ++i) legs_[i].lifted = false;
  if (!walking_) return;
  const bool any_late = std::any_of(legs_.begin(), legs_.begin() + feet_,
                                    [](const Leg& leg) { return leg.state == LegPhase::kLate; });
  if (!any_late) waited_s_ = 0.0;
  if (MustWait() && waited_s_ < kLongestWait) {
    waited_s_ += dt_s;
  } else {
    t_s_ += dt_s;
  }
  for (int i = 0; i < feet_; ++i) {
    const double stride = t_s_ / gait_.period_s + gait_.offsets[i];
    legs_[i].phase = stride - std::floor(stride);
    UpdateLeg(legs_[i], contact[i], dt_s);
  }
}

void GaitClock::UpdateLeg(Leg& leg, bool contact, double dt_s) const {
  const bool scheduled = leg.phase < gait_.duty;
  if (!scheduled && leg.was_scheduled) {
    leg.state = LegPhase::kSwing;
    leg.was_scheduled = leg.early = false;
    leg.touches = 0;
    leg.lifted = true;
    return;
  }
  leg.was_scheduled = scheduled;
  if (leg.state == LegPhase::kSwing && !scheduled) {
    const double s = (leg.phase - gait_.duty) / (1.0 - gait_.duty);
    leg.touches = contact && s > 0.5 ? leg.touches + 1 : 0;
    if (leg.touches < kTouches) return;
    leg.state = LegPhase::kStance;
    leg.early = true;
    return;
  }
  if (!scheduled) return;
  if (leg.state != LegPhase::kStance) {
    leg.late_s = leg.state == LegPhase::kLate ? leg.late_s + dt_s : 0.0;
    leg.state = contact ? LegPhase::kStance : LegPhase::kLate;
    leg.lost_s = 0.0;
    return;
  }
  leg.early = false;
  leg.lost_s = contact ? 0.0 : leg.lost_s + dt_s;
  if (leg.lost_s <= kLostContact || leg.phase >= kNearLift * gait_.duty) return;
  leg.state = LegPhase::kLate;
  leg.late_s = 0.0;
}

}  // namespace reckon::sim

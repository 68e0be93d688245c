#pragma once

#include <array>
#include <vector>

#include "reckon/models/contact_sample.h"
#include "reckon/sim/legged_config.h"

namespace reckon::sim {

/// When which foot is down: foot i stands while its phase, frac(t/T + offset_i), is below `duty`.
struct Gait {
  double period_s = 0.45, duty = 0.58;
  std::vector<double> offsets;

  double stance_s() const { return duty * period_s; }
  double swing_s() const { return (1.0 - duty) * period_s; }
};

/// The gait that `config` names, for `feet` feet (front right, front left, rear right, rear left).
/// Its own period is that of a robot 0.29 m high; it grows with `time_scale`. Throws
/// std::invalid_argument for a period or duty out of range, or offsets that are not one a foot.
Gait NamedGait(const GaitConfig& config, int feet, double time_scale);

enum class LegPhase {
  kStance,
  kSwing,
  kLate,  ///< it should stand, and has not found the ground
};

/// The clock of a gait, and what each leg does by it and by what it feels.
///
/// A leg that swings stands early when it has been in contact for two ticks of the second half of
/// its swing; one that should stand and does not searches downwards (late). While one is late the
/// clock waits, for 0.2 s at most, before another may lift: without this a robot falls down steps.
class GaitClock {
 public:
  using Contacts = std::array<bool, models::kMaxFeet>;

  GaitClock(const Gait& gait, int feet);

  /// Starts a stride with every foot down.
  void Start();
  /// All feet stand from now on.
  void Stop();

  /// One tick of `dt_s`. Does not allocate.
  void Update(double dt_s, const Contacts& contact);

  bool walking() const { return walking_; }
  LegPhase state(int leg) const { return legs_[leg].state; }
  bool lifted(int leg) const { return legs_[leg].lifted; }  ///< in this tick
  bool early(int leg) const { return legs_[leg].early; }    ///< stands before its time
  double late_s(int leg) const { return legs_[leg].late_s; }

  /// Of the swing, 0 to 1, and of the stride.
  double swing(int leg) const;
  double phase(int leg) const { return legs_[leg].phase; }

  /// Whether the schedule alone has the foot down.
  bool scheduled(int leg) const { return !walking_ || legs_[leg].phase < gait_.duty; }
  const Gait& gait() const { return gait_; }

 private:
  struct Leg {
    LegPhase state = LegPhase::kStance;
    double phase = 0.0, late_s = 0.0, lost_s = 0.0;
    int touches = 0;  ///< ticks of contact in a row while it swings
    bool early = false, lifted = false, was_scheduled = true;
  };

  bool MustWait() const;
  void UpdateLeg(Leg& leg, bool contact, double dt_s) const;

  Gait gait_;
  int feet_;
  std::array<Leg, models::kMaxFeet> legs_;
  bool walking_ = false;
  double t_s_ = 0.0, waited_s_ = 0.0;
};

}  // namespace reckon::sim

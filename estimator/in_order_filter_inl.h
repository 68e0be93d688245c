#pragma once

#include "reckon/estimator/correction_judge.h"
#include "reckon/estimator/height_model.h"
#include "reckon/estimator/in_order_filter.h"
#include "reckon/estimator/iterated_correction.h"
#include "reckon/estimator/kalman.h"
#include "reckon/estimator/left_invariant_ekf.h"
#include "reckon/estimator/multiplicative_ekf.h"
#include "reckon/estimator/right_invariant_ekf.h"

// How an InOrderFilter judges and takes in one correction: for its own sources alone.
namespace reckon::estimator {

template <class Core>
template <int kRows, class Taken>
std::optional<Correction> InOrderFilter<Core>::IfItFits(models::TimeNs t_ns,
                                                        models::SensorId sensor,
                                                        const Linearisation<kRows>& own,
                                                        SlotSet seen, const Taken& use,
                                                        Report* report) {
  KalmanCorrection<kRows> kalman(core_.P(), own);
  Correction correction = Described(kalman, own, core_.x().R);
  correction.t_ns = t_ns;
  correction.sensor = sensor;
  Judge(beliefs_->gate, core_, seen, correction);
  Blame(correction);
  if (report != nullptr) report->Add(correction);
  if (!IsApplied(correction.decision)) return std::nullopt;
  kalman.AddLasting();
  if (correction.decision == Decision::kInflated) kalman.Inflate(beliefs_->gate.Limit(kRows));
  use(kalman, correction.decision);
  return correction;
}

template <class Core>
template <class Model>
std::optional<Correction> InOrderFilter<Core>::Apply(models::TimeNs t_ns, models::SensorId sensor,
                                                     const Model& model, Report* report) {
  const auto linearised = model(core_.x());
  constexpr int kRows = std::decay_t<decltype(linearised)>::Vector::RowsAtCompileTime;
  const auto use = [&](const KalmanCorrection<kRows>& kalman, Decision decision) {
    const int iterations = beliefs_->setup.iterations;
    if constexpr (Core::kForm == ErrorForm::kRightInvariant) {
      if (iterations > 1 && decision != Decision::kInflated) {
        return CorrectIterated<kRows>(core_, model, iterations);
      }
    }
    core_.Retract(kalman.Gain());
    kalman.UpdateCovariance(core_.P());
  };
  return IfItFits(t_ns, sensor, Core::Convert(linearised, core_.x()), linearised.slots(), use,
                  report);
}

template <class Core>
template <class Point>
void InOrderFilter<Core>::UseFloor(const models::Measurement& m, Slot slot, const Point& point,
                                   Report* report) {
  const Setup& setup = beliefs_->setup;
  const auto model = [&](const NavigationState& x) {
    return LinearisedHeight(setup.floor.height_m, setup.noise.floor_height_m, slot, point(x));
  };
  Apply(m.valid_ns, m.sensor, model, report);
}

}  // namespace reckon::estimator

// Energy balance of a motion: stored energy, input, dissipation, and the missing energy.
//
// Missing energy is taken relative to the stored energy and to the energy that flows through: a steady machine turns
// over its energy many times, and errors accumulate. The error is therefore also evaluated by turnovers, which are
// intervals of the motion in which as much energy flows through as has ever been stored: `largest_error` is the largest
// error of one turnover. Otherwise the flow of a long run would hide any error.
#pragma once

#include <algorithm>
#include <cmath>

#include "mechanism/model/archive.hpp"
#include "mechanism/model/component.hpp"

namespace bielle::mechanism {

/// Powers are integrated by the trapezoidal rule, which has the order of the time integration itself.
class EnergyBalance {
 public:
  void start(double time, const Energy& energy) {
    time_ = time;
    last_ = energy;
    start_ = stored(energy);
    gravity_start_ = energy.gravity;
    totals_ = energy;
    totals_.input = totals_.dissipation = 0;
    largest_ = 0;
    flow_ = turnover_ = {};
    largest_turnover_ = largest_error_ = error_before_ = scheme_loss_ = 0;
    note_largest();
  }
  /// @param scheme_loss  energy removed by the scheme's own damping since the start [J]; it is not counted as an error
  void advance(double time, const Energy& energy, double scheme_loss = 0) {
    const double half = 0.5 * (time - time_);
    const double input = totals_.input + half * (energy.input + last_.input);
    const double dissipation = totals_.dissipation + half * (energy.dissipation + last_.dissipation);
    totals_ = energy;
    totals_.input = input;
    totals_.dissipation = dissipation;
    flow(half * (std::abs(energy.input) + std::abs(last_.input)),
         half * (std::abs(energy.dissipation) + std::abs(last_.dissipation)));
    time_ = time;
    last_ = energy;
    scheme_loss_ = scheme_loss;
    note_largest();
  }
  /// Adds a discontinuity at the time of the last `advance`: energy lost in impulses and in released parts is
  /// dissipated, energy that appears with an activated part is supplied, and powers continue from their values after
  /// it.
  /// @param work  work of drives and supports whose rate jumps [J]
  void jump(const Energy& before, const Energy& after, double work) {
    const double lost = stored(before) - stored(after) + work, supplied = work + std::max(0.0, -lost);
    const double input = totals_.input + supplied;
    const double dissipation = totals_.dissipation + std::max(0.0, lost);
    totals_ = last_ = after;
    totals_.input = input;
    totals_.dissipation = dissipation;
    flow(std::abs(supplied), std::max(0.0, lost));
    note_largest();
  }
  /// Present stored energies, input and dissipation since the start [J].
  const Energy& totals() const { return totals_; }
  /// E - E_start - input + dissipation [J]: zero for exact integration; negative if the scheme removed energy.
  double balance() const { return stored(totals_) - start_ - totals_.input + totals_.dissipation; }
  double energy_at_start() const { return start_; }
  double largest() const { return largest_; }  ///< largest stored energy, gravity relative to its start [J]
  /// Returns the energy that has flowed through: the larger of input and dissipation, as sums of absolute values [J].
  double through() const { return flow_.larger(); }
  /// Returns the largest error of a turnover [J], and the energy that flowed through in the largest one [J].
  double largest_error() const { return std::max(largest_error_, std::abs(error() - error_before_)); }
  double largest_turnover() const { return std::max(largest_turnover_, turnover_.larger()); }
  void exchange(Archive& archive) {
    for (double* value :
         {&time_, &start_, &gravity_start_, &largest_, &flow_.input, &flow_.dissipation, &turnover_.input,
          &turnover_.dissipation, &largest_turnover_, &largest_error_, &error_before_, &scheme_loss_})
      archive(*value);
    for (Energy* energy : {&last_, &totals_})
      for (double* value : {&energy->kinetic, &energy->elastic, &energy->gravity, &energy->dissipation, &energy->input})
        archive(*value);
  }

 private:
  struct Flow {
    double input = 0, dissipation = 0;  ///< sums of absolute values [J]
    double larger() const { return std::max(input, dissipation); }
  };
  static double stored(const Energy& e) { return e.kinetic + e.elastic + e.gravity; }
  void note_largest() {
    largest_ = std::max({largest_, totals_.kinetic, totals_.elastic, std::abs(totals_.gravity - gravity_start_)});
    if (turnover_.larger() < largest_) return;
    largest_error_ = largest_error();
    largest_turnover_ = largest_turnover();
    error_before_ = error();
    turnover_ = {};
  }
  double error() const { return balance() + scheme_loss_; }
  void flow(double input, double dissipation) {
    for (Flow* flow : {&flow_, &turnover_}) {
      flow->input += input;
      flow->dissipation += dissipation;
    }
  }
  double time_ = 0, start_ = 0, gravity_start_ = 0, largest_ = 0;
  Flow flow_, turnover_;         ///< flow since the start, and since the last turnover
  double largest_turnover_ = 0;  ///< largest flow of a turnover [J]
  double largest_error_ = 0;     ///< largest error of a completed turnover [J]
  double error_before_ = 0;      ///< error at the start of the last turnover [J]
  double scheme_loss_ = 0;       ///< energy removed by the scheme since the start [J]
  Energy last_, totals_;
};

}  // namespace bielle::mechanism

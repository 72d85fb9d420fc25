// Keeps the books of energy along a motion: what is stored, what went in, what was dissipated, what is missing.
#pragma once

#include <algorithm>
#include <cmath>

#include "mechanism/model/archive.hpp"
#include "mechanism/model/component.hpp"

namespace bielle::mechanism {

/// Powers are integrated by the trapezoidal rule, of the order of the time integration itself.
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
    note_largest();
  }
  void advance(double time, const Energy& energy) {
    const double half = 0.5 * (time - time_);
    const double input = totals_.input + half * (energy.input + last_.input);
    const double dissipation = totals_.dissipation + half * (energy.dissipation + last_.dissipation);
    totals_ = energy;
    totals_.input = input;
    totals_.dissipation = dissipation;
    time_ = time;
    last_ = energy;
    note_largest();
  }
  /// A discontinuity at the time of the last `advance`: energy lost in impulses is dissipated, powers continue from
  /// those after it. @param work  of drives and supports whose rate jumps [J]
  void jump(const Energy& before, const Energy& after, double work) {
    const double input = totals_.input + work;
    const double dissipation = totals_.dissipation + stored(before) - stored(after) + work;
    totals_ = last_ = after;
    totals_.input = input;
    totals_.dissipation = dissipation;
    note_largest();
  }
  /// Stored energies now, input and dissipation since the start [J].
  const Energy& totals() const { return totals_; }
  /// E - E_start - input + dissipation: zero for exact integration; negative: the scheme took energy out [J].
  double balance() const { return stored(totals_) - start_ - totals_.input + totals_.dissipation; }
  double energy_at_start() const { return start_; }
  double largest() const { return largest_; }
  void exchange(Archive& archive) {
    for (double* value : {&time_, &start_, &gravity_start_, &largest_}) archive(*value);
    for (Energy* energy : {&last_, &totals_})
      for (double* value : {&energy->kinetic, &energy->elastic, &energy->gravity, &energy->dissipation, &energy->input})
        archive(*value);
  }

 private:
  static double stored(const Energy& e) { return e.kinetic + e.elastic + e.gravity; }
  void note_largest() {
    largest_ = std::max({largest_, totals_.kinetic, totals_.elastic, std::abs(totals_.gravity - gravity_start_)});
  }
  double time_ = 0, start_ = 0, gravity_start_ = 0, largest_ = 0;
  Energy last_, totals_;
};

}  // namespace bielle::mechanism

// Time spans that are too short for a step of the scheme: the remainder after an event near a time of the grid or near
// another event.
//
// A step of size s computes accelerations from positions: da = dDq (1 - alpha_m)/((1 - alpha_f) beta s^2). Positions
// have rounding errors of eps X, where X is their distance from the origin plus the model's own extent, and constraints
// are only satisfied to this accuracy: accelerations, and with them reactions, have an error of
//     eps X (1 - alpha_m)/((1 - alpha_f) beta s^2).
// They have six accurate digits, relative to the largest acceleration A of the model, its weight included, as long as
//     s >= s_0 = sqrt(10^6 eps X (1 - alpha_m)/((1 - alpha_f) beta A)).
// (With X = 1 m, A = 10 m/s^2 and h = 1 ms, s_0 = 9e-6 s = 0.009 h.) Below s_0 the accelerations themselves change
// positions by no more than s^2 A/2 < 10^6 eps X: a Taylor series of second order,
//     Dq = s v + s^2 a/2,   v + s a,   y + s ydot,
// from velocities and accelerations that satisfy their constraints, is then sufficiently accurate: the ratio of its
// error s^3 j/6 to that of a step, about h^3 j/12, is 2 (s/h)^3. Accelerations, multipliers and rates at its end are
// solved for at its positions and velocities (consistent_accelerations.hpp), without a division by s, and the scheme is
// restarted there, as after a discontinuity. Therefore spans are short only below min(s_0, h/100); without any
// acceleration, s_0 is infinite.
//
// Longer steps that are much shorter than those before them have another error. The velocities across the constraints
// are accurate to O(h^3) of the previous steps h, and Dq has to compensate for this error within s: accelerations and
// reactions have an error of O(h^3)/(beta s), 7 % for a pendulum that rotates by 0.03 rad per step and s = h/200.
// Accelerations and multipliers are solved for at the end of such a step as well (`settle`); the next step is restarted
// in any case.
//
// The series is explicit. It would move stiff parts (a pressure of little volume, a mode of a body, a guide of 10^9
// N/m) too far if they are not at rest relative to their drive, and if the span is longer than their time constant. The
// accelerations at the end show this: along an unknown that moves at the circular frequency omega they differ from
// those at the beginning by omega^2 Dq; a load that changes within the span shows in them as well. If for any unknown
//     s^2 |a_end - a_begin| > 10^-3 |Dq|,   that is (omega s)^2 > 10^-3,
// above the rounding of positions, or if first-order unknowns or amplitudes would move by more than 10^-6 of their
// size, positions, velocities and first-order unknowns at the end are those of an implicit step, and only the
// accelerations are solved for. Spans below 10^-6 h are shorter than any relevant time constant, and always use the
// series.
#pragma once

#include "mechanism/solvers/constraints/kkt_matrix.hpp"
#include "mechanism/solvers/dynamics/scheme_step.hpp"

namespace bielle::mechanism {

class ShortSpan {
 public:
  ShortSpan(const System& system, const Environment& environment) : system_(system), environment_(environment) {}

  /// Returns s_0 at a state [s]; infinite without any acceleration.
  double longest(const State& state, const Scheme& scheme) const;
  /// Sets the step's trial to the state after a span, by the series.
  /// @param end     its end time, just before a kink there [s]
  /// @param offset  time by which the beginning is separated from a kink there [s]
  /// @param small   whether the span is shorter than any time constant
  /// @returns whether the series is valid; otherwise the trial is undefined
  /// @throws ComputationError if there are no consistent accelerations
  bool leap(SchemeStep& step, KktMatrix& saddle, double span, double end, double offset, bool small) const;
  /// Solves for the accelerations of a trial whose positions and velocities are known.
  void settle(SchemeStep& step, KktMatrix& saddle) const;

 private:
  bool moves_little(const State& begin, double span) const;
  bool is_slow(const State& begin, const State& after, const VectorX& dq, double span) const;

  const System& system_;
  const Environment& environment_;
};

}  // namespace bielle::mechanism

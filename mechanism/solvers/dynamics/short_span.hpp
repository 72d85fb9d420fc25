// Spans of time that are too short for a step of the scheme: what an event just behind a time of the grid, just before
// it or just before another event leaves.
//
// A step of size s finds accelerations from positions: da = dDq (1 - alpha_m)/((1 - alpha_f) beta s^2). Positions are
// rounded by eps X, X their distance from the origin and the model's own extent, and constraints hold no better than
// that: accelerations, and with them reactions, are wrong by
//     eps X (1 - alpha_m)/((1 - alpha_f) beta s^2).
// They carry six digits, relative to the largest acceleration A of the model, its weight included, as long as
//     s >= s_0 = sqrt(10^6 eps X (1 - alpha_m)/((1 - alpha_f) beta A)).
// (With X = 1 m, A = 10 m/s^2 and h = 1 ms, s_0 = 9e-6 s = 0.009 h.) Below s_0 the accelerations themselves move
// positions by no more than s^2 A/2 < 10^6 eps X: a Taylor series of second order,
//     Dq = s v + s^2 a/2,   v + s a,   y + s ydot,
// from velocities and accelerations that satisfy their constraints, is then as good as can be: its error s^3 j/6
// relative to that of a step, of some h^3 j/12, is 2 (s/h)^3. Accelerations, multipliers and rates at its end are
// solved for at its positions and velocities (consistent_accelerations.hpp), nothing is divided by s, and the scheme
// begins anew there, as it does at a discontinuity. Spans are hence short below min(s_0, h/100) only; where nothing
// accelerates, s_0 is without end.
//
// Longer steps that are much shorter than those before them carry an error of another kind. The velocities across the
// constraints are right to O(h^3) of the steps h before, and Dq has to make up for it within s: accelerations and
// reactions are off by O(h^3)/(beta s), 7 % for a pendulum that turns by 0.03 rad per step and s = h/200. Accelerations
// and multipliers are solved for at the end of such a step as well (`settle`); the next step begins anew in any case.
//
// The series is explicit. What is stiff (a pressure of little volume, a mode of a body, a guide of 10^9 N/m) and not at
// rest relative to its drive would be carried too far by a span that is longer than its time constant. The
// accelerations at the end tell: along an unknown that moves at the circular frequency omega they differ from those at
// the begin by omega^2 Dq, and a load that changes within the span shows in them as well. If along any unknown
//     s^2 |a_end - a_begin| > 10^-3 |Dq|,   that is (omega s)^2 > 10^-3,
// above the rounding of positions, or if first-order unknowns or amplitudes would move by more than 10^-6 of their
// size, positions, velocities and first-order unknowns at the end are those of an implicit step, and only the
// accelerations are solved for. Spans below 10^-6 h are shorter than any time constant that matters, and go by the
// series.
#pragma once

#include "mechanism/solvers/constraints/mass_saddle.hpp"
#include "mechanism/solvers/dynamics/scheme_step.hpp"

namespace bielle::mechanism {

class ShortSpan {
 public:
  ShortSpan(const System& system, const Environment& environment) : system_(system), environment_(environment) {}

  /// s_0 at a state [s]; infinite where nothing accelerates.
  double longest(const State& state, const Scheme& scheme) const;
  /// Makes the step's trial the state after a span, by the series.
  /// @param end     its time, just before a kink there [s]
  /// @param offset  by which the time of the begin is told apart from a kink there [s]
  /// @param small   whether the span is shorter than any time constant
  /// @returns whether the series may be used; the trial is undefined otherwise
  /// @throws ComputationError where there are no consistent accelerations
  bool leap(SchemeStep& step, MassSaddle& saddle, double span, double end, double offset, bool small) const;
  /// Solves for the accelerations of a trial whose positions and velocities are known.
  void settle(SchemeStep& step, MassSaddle& saddle) const;

 private:
  bool moves_little(const State& begin, double span) const;
  bool is_slow(const State& begin, const State& after, const VectorX& dq, double span) const;

  const System& system_;
  const Environment& environment_;
};

}  // namespace bielle::mechanism

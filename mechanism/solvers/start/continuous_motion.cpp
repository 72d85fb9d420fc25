#include "mechanism/solvers/start/continuous_motion.hpp"

#include <algorithm>
#include <cmath>

#include "mechanism/solvers/newton/model_length.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {

State predicted(const System& system, const State& state, double time) {
  const double h = time - state.time;
  VectorX v(system.dofs()), a(system.dofs());
  system.get_rates(state, v, a);
  State next = state;
  next.time = time;
  system.displace(next, state, h * v + 0.5 * h * h * a);
  system.set_rates(next, v + h * a, a);
  return next;
}

bool ContinuousMotion::fits(const State& from, const State& to) {
  // Largest error, relative to the change of the rates; the trapezoidal rule has an error of h^2 w^2/12.
  constexpr double most = 0.6;
  constexpr double invisible = 1e-9;  // motion of a step, relative to the extent
  // Error relative to the largest rate so far: a drive at rest moves only by rounding.
  constexpr double standstill = 1e-6;
  VectorX v(system_.dofs()), a(system_.dofs()), v_to(system_.dofs()), a_to(system_.dofs());
  system_.get_rates(from, v, a);
  system_.get_rates(to, v_to, a_to);
  const double h = to.time - from.time, length = std::max(model_extent(to), 1e-30);
  double change = 0, gap = 0, speed = 0;
  for (int i = 0; i < system_.dofs(); ++i) {
    const double size = system_.kind(i) == Kind::translation ? 1 / length : 1, dv = v_to[i] - v[i];
    const double by_a = 0.5 * h * (a[i] + a_to[i]);
    change = std::max(change, size * std::max(std::abs(dv), std::abs(by_a)));
    gap = std::max(gap, size * std::abs(dv - by_a));
    speed = std::max(speed, size * std::max(std::abs(v[i]), std::abs(v_to[i])));
  }
  fastest_ = std::max(fastest_, speed);
  if (gap * h <= invisible || gap <= standstill * fastest_) return true;
  return gap <= most * change || gap <= most * speed;
}

State ContinuousMotion::advance(const State& from, double time, bool jumps) { return advance(from, time, jumps, 0); }

State ContinuousMotion::advance(const State& from, double time, bool jumps, int depth) {
  constexpr int deepest = 10;
  constexpr int deepest_passage = 16;  // for a singular position, at two positions for each halving
  State next = position_(from, time);
  if (fits(from, next)) {
    if (depth >= deepest_passage || same_side_(from, next)) return next;
    try {
      return advance_in_halves(from, time, jumps, depth);
    } catch (const ComputationError&) {
      return next;  // so near to a singular position rounding decides, and the longer step is more reliable
    }
  }
  if (jumps && depth >= deepest) return next;
  if (depth >= deepest)
    throw ComputationError(
        "velocities and accelerations do not fit to those just before, however short the step: either a drive jumps, "
        "or "
        "a dead centre is met, where the mechanism may go on in two ways: take other steps, or drive another joint");
  return advance_in_halves(from, time, jumps, depth);
}

State ContinuousMotion::advance_in_halves(const State& from, double time, bool jumps, int depth) {
  const State middle = advance(from, from.time + 0.5 * (time - from.time), false, depth + 1);
  return advance(middle, time, jumps, depth + 1);
}

}  // namespace bielle::mechanism

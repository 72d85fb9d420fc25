#include "mechanism/solvers/statics/path_watch.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

#include "mechanism/solvers/start/start_report.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

constexpr double accurate = 1e-6;  // relative accuracy of a turning point
constexpr int most_steps = 1000;
constexpr std::size_t kept = 3;  // number of points of the continuation

}  // namespace

PathWatch::Verdict PathWatch::look(const Point& from, Point& to) {
  Verdict verdict;
  if (told_by_ends(from, to)) return verdict;
  verdict.followed = true;
  verdict.sign_changed = equilibrium_.sign_changed();
  Point below = from;
  if (follow(below, to.factor, finest, &to.state)) {
    verdict.moved = !measure_.small(motions_between(below.state, to.state));
    if (verdict.moved) to = below;
    return verdict;
  }
  close_in(below, to.factor);
  Point above = to;
  if (follow(above, below.factor)) {
    if (measure_.small(motions_between(below.state, above.state))) return verdict;  // the path has only a kink there
    verdict.landing = above;
  }
  verdict.jump = jump_between(below, above);
  verdict.below = below;
  return verdict;
}

bool PathWatch::told_by_ends(const Point& from, const Point& to) {
  const NodeMotions found = motions_between(from.state, to.state);
  if (measure_.small(found)) return true;
  if (equilibrium_.sign_changed()) return false;
  const double motion = to.state.motion_factor - from.state.motion_factor;
  const VectorX end = equilibrium_.response(to.factor, to.state, to.factor - from.factor);
  return measure_.bend(motions_along(system_, from.state, equilibrium_.first_response(), motion),
                       motions_along(system_, to.state, end, motion), found) <= 1;
}

/// Finds the equilibrium near a point of the continuation. @returns whether there is one
bool PathWatch::arrive(Point& point, const Point& reached, const Continuation& there) {
  State state = displaced(system_, reached.state, reached.state.motion_factor, there.correction);
  const State expected = state;
  try {
    if (equilibrium_.find(reached.factor, state, &reached.state) < 0) return false;
  } catch (const ComputationError&) {
    return false;
  }
  const NodeMotions rest = motions_along(system_, reached.state, there.correction, 0);
  if (measure_.unsettled(rest, motions_between(expected, state)) > 1) return false;
  point = {reached.factor, state};
  return true;
}

bool PathWatch::follow(Point& point, double factor, double least, const State* expected) {
  const double whole = factor - point.factor;
  if (whole == 0) return true;
  double step = whole / 4;
  bool refused = false;
  // The last points are kept: near the turning point the continuation may go slightly too far.
  std::deque<Point> points{point};
  std::deque<Continuation> rates(1);
  try {
    equilibrium_.respond(point.factor, point.state, nullptr, rates[0]);
    // An analysis may start from a state that is not yet in equilibrium.
    if (!measure_.small(motions_along(system_, point.state, rates[0].correction, 0))) {
      if (equilibrium_.find(point.factor, point.state) < 0) return false;
      points[0] = point;
      equilibrium_.respond(point.factor, point.state, nullptr, rates[0]);
    }
  } catch (const ComputationError&) {
    return false;
  }
  for (int k = 0; k < most_steps && points.back().factor != factor && std::abs(step) >= least * std::abs(whole); ++k) {
    const Point& here = points.back();
    const double end = std::abs(factor - here.factor) <= 1.001 * std::abs(step) ? factor : here.factor + step;
    Point trial{end, here.state};
    Continuation there;
    const double bend = advance(here, rates.back(), trial, there);
    // After a rejected step, steps grow slowly again.
    const double most = refused ? 1.3 : 2.5;
    refused = bend > 1;
    step = (end - here.factor) * (refused ? std::clamp(0.7 / bend, 0.2, 0.5) : std::clamp(0.7 / bend, 0.5, most));
    if (bend > 1) continue;
    points.push_back(std::move(trial));
    rates.push_back(std::move(there));
    if (points.size() > kept) {
      points.pop_front();
      rates.pop_front();
    }
  }
  const bool came = points.back().factor == factor;
  if (came && expected) {
    const State end =
        displaced(system_, points.back().state, points.back().state.motion_factor, rates.back().correction);
    if (measure_.small(motions_between(end, *expected))) {
      point = {factor, *expected};
      return true;
    }
  }
  for (; !points.empty() && points.back().factor != point.factor; points.pop_back(), rates.pop_back())
    if (arrive(point, points.back(), rates.back())) return came && point.factor == factor;
  return false;
}

/// Makes a step of the continuation. @returns the difference from the description by its ends, relative to the
/// permitted one
double PathWatch::advance(const Point& here, const Continuation& at_begin, Point& trial, Continuation& at_end) {
  constexpr int corrections = 3;  // until the remainder is small
  const double change = trial.factor - here.factor, motion = ramp_.motion(trial.factor) - here.state.motion_factor;
  try {
    const NodeMotions begin = motions_along(system_, here.state, change * at_begin.rate, motion);
    NodeMotions found = begin;
    State before = here.state;
    trial.state =
        displaced(system_, here.state, ramp_.motion(trial.factor), at_begin.correction + change * at_begin.rate);
    for (int k = 1;; ++k) {
      equilibrium_.respond(trial.factor, trial.state, &before, at_end);
      const NodeMotions correction = motions_along(system_, trial.state, at_end.correction, 0);
      for (std::size_t i = 0; i < found.size(); ++i) {
        found[i].displacement += correction[i].displacement;
        found[i].turn += correction[i].turn;
      }
      const double bend =
          measure_.bend(begin, motions_along(system_, trial.state, change * at_end.rate, motion), found);
      const double unsettled = measure_.unsettled(correction, motions_along(system_, trial.state, at_end.second, 0));
      if (bend > 1 || unsettled <= 1 || k == corrections) return std::max(bend, unsettled);
      before = trial.state;
      trial.state = displaced(system_, before, before.motion_factor, at_end.correction);
    }
  } catch (const ComputationError&) {
    return INFINITY;  // a component cannot be evaluated at the trial, or the equations are singular
  }
}

/// Moves the last equilibrium before a turning point of the path close to it. @param beyond  past the turning point
void PathWatch::close_in(Point& below, double beyond) {
  const double least = accurate * std::abs(beyond - below.factor);
  // Usually it is already close: short distances are tried first.
  for (double reach = least; std::abs(beyond - below.factor) > least; reach *= 8) {
    const double gap = beyond - below.factor;
    Point middle{below.factor + std::copysign(std::min(reach, 0.5 * std::abs(gap)), gap), below.state};
    if (equilibrium_.find(middle.factor, middle.state) >= 0 && told_by_ends(below, middle))
      below = middle;
    else if (!follow(below, middle.factor, 1e-5))
      beyond = middle.factor;
  }
}

LoadJump PathWatch::jump_between(const Point& below, const Point& above) const {
  LoadJump jump;
  jump.factor = below.factor;
  note_farthest(system_, below.state, above.state, jump.distance, jump.node);
  return jump;
}

}  // namespace bielle::mechanism

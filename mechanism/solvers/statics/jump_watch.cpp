#include "mechanism/solvers/statics/jump_watch.hpp"

#include <cmath>
#include <string>

#include "mechanism/solvers/newton/model_length.hpp"
#include "mechanism/solvers/start/start_report.hpp"

namespace bielle::mechanism {

std::optional<LoadJump> JumpWatch::look(Point from, Point to) {
  constexpr double far = 0.02, unexpected = 4;  // of the mechanism's size, of the linear response
  constexpr double accurate = 1e-6;             // of the increment
  const double moved = distance(from.state, to.state), whole = std::abs(to.factor - from.factor);
  if (moved < far * model_extent(from.state) || moved < unexpected * equilibrium_.promised()) return {};
  while (std::abs(to.factor - from.factor) > accurate * whole) {
    const double middle = 0.5 * (from.factor + to.factor);
    Point between{middle, from.state};
    // Close to the limit point Newton's method may fail from below, and does not from above.
    if (equilibrium_.find(middle, between.state) < 0) {
      between.state = to.state;
      if (equilibrium_.find(middle, between.state) < 0) break;
    }
    const bool upper = distance(from.state, between.state) < distance(between.state, to.state);
    (upper ? from : to) = between;
    if (distance(from.state, to.state) < 0.5 * moved) return {};
  }
  LoadJump jump;
  jump.factor = from.factor;
  jump.distance = distance(from.state, to.state, &jump.node);
  return jump;
}

double JumpWatch::distance(const State& from, const State& to, std::string* node) const {
  double moved = 0;
  std::string farthest;
  note_farthest(system_, from, to, moved, farthest);
  if (node) *node = farthest;
  return moved;
}

}  // namespace bielle::mechanism

#include "mechanism/joints/cables/rope_wrap.hpp"

#include <cmath>

#include "mechanism/measures/turns.hpp"

namespace bielle::mechanism {
namespace {

/// Returns whether the rope would touch the pulley in the drawn position if it could slide.
bool touches_as_drawn(const RopePath& before, const RopePath& after) {
  const std::size_t p = before.nodes.size() - 2;
  const RopeCourses around({before.pulleys[p], after.pulleys[0], after.pulleys[1]});
  const std::vector<Frame> at = {before.drawn[p] * before.pulleys[p].on_node, after.drawn[0] * after.pulleys[0].on_node,
                                 after.drawn[1] * after.pulleys[1].on_node};
  return RopeCourses::touches(around.as_drawn(at, {0, 0, 0})[1]);
}

double wrap_as_drawn(const RopeSection& before, const RopeSection& after) {
  const double turn = after.drawn_end(RopeSection::first_end) - before.drawn_end(RopeSection::last_end);
  const double wrap = after.path().pulleys.front().radius < 0 ? -turn : turn;
  if (!touches_as_drawn(before.path(), after.path())) return unwrap_angle(wrap, 0);
  const double less_than_a_turn = unwrap_angle(wrap, M_PI);
  return less_than_a_turn > 2 * M_PI - just_touching ? 0 : less_than_a_turn;  // 0 if the rope just touches
}

}  // namespace

RopeWrap::RopeWrap(const RopeSection& before, const RopeSection& after, int turns)
    : pulley_(after.path().names.front()),
      radius_(after.path().pulleys.front().radius),
      drawn_(wrap_as_drawn(before, after) + 2 * M_PI * turns) {}

}  // namespace bielle::mechanism

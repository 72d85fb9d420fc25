#include "mechanism/measures/turn_measure.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "mechanism/math/so3.hpp"
#include "mechanism/measures/pair_measure.hpp"
#include "mechanism/measures/turns.hpp"
#include "mechanism/model/description.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {

void TurnMeasure::declare_subjects(Declaration& declaration) const {
  declaration.nodes = {pair_.first, pair_.second};
  // The rate does not depend on the number of turns.
  // NaN: no step has been accepted yet.
  if (!rate_) declaration.memory = {0, 0, std::numeric_limits<double>::quiet_NaN()};
}

void TurnMeasure::check_tilt(double sine, double cosine) const {
  // The vector of sine and cosine has the length 2 (q_0^2 + (q . e)^2), and rounding errors of 1e-16. Below this length
  // the errors dominate.
  if (std::hypot(sine, cosine) > 1e-12) return;
  throw ComputationError(fmt::format(
      "measure '{}': the node is tilted by half a turn, where a turn about the axis is not defined; measure "
      "it relative to a node that tilts with it",
      name()));
}

CoordinateRate TurnMeasure::principal(const LocalState& state) const {
  const NodeState &first = state.node(0), &second = state.node(1);
  const Matrix3 R_12 = first.R.transpose() * second.R;
  const Matrix3 C = A_.transpose() * R_12 * B_;
  const Vector3 omega = A_.transpose() * (R_12 * second.Omega - first.Omega);
  const Matrix3 C_rate = skew(omega) * C;
  const double s = C(2, 1) - C(1, 2), c = C(1, 1) + C(2, 2);
  check_tilt(s, c);
  const double s_rate = C_rate(2, 1) - C_rate(1, 2), c_rate = C_rate(1, 1) + C_rate(2, 2);
  return {std::atan2(s, c), (c * s_rate - s * c_rate) / (s * s + c * c)};
}

double TurnMeasure::counted(const CoordinateRate& principal, const LocalState& state) const {
  const auto memory = state.memory();
  return counted_angle(principal, {memory[0], memory[1]}, memory[2], state);
}

double TurnMeasure::value(const LocalState& state) const {
  const CoordinateRate turn = principal(state);
  return rate_ ? turn.rate : counted(turn, state);
}

double TurnMeasure::calc(const LocalState& state, MeasureGradient& gradient) const {
  const NodeState &first = state.node(0), &second = state.node(1);
  const auto alignment = [&](int a, int b) { return measure_alignment(first, second, A_.col(a), B_.col(b)); };
  const PairMeasure sine = alignment(2, 1) - alignment(1, 2), cosine = alignment(1, 1) + alignment(2, 2);
  check_tilt(sine.value, cosine.value);
  const PairMeasure turn = atan2(sine, cosine);
  const Vector12 v = pair_rate(first, second);
  gradient.prepare(state.slots().size());
  if (rate_) {
    gradient.position() = turn.second.transpose() * v;
    gradient.rate() = turn.gradient;
    return turn.rate(v);
  }
  gradient.position() = turn.gradient;
  return counted({turn.value, turn.rate(v)}, state);
}

void TurnMeasure::accept(const LocalState& state, Eigen::Ref<VectorX> memory) const {
  const CoordinateRate turn = principal(state);
  memory << counted(turn, state), turn.rate, state.time();
}

void TurnMeasure::describe(const LocalState& /*state*/, Description& description) const {
  const std::string second = description.node(pair_.second);
  const std::string nodes = pair_.first == 0 ? second : second + " relative to " + description.node(pair_.first);
  description.add(fmt::format("{} of node {} about {} [{}]{}", rate_ ? "rate of the turn" : "turn", nodes,
                              format_vector(A_.col(0)), units(), rate_ ? "" : ", counted over turns"));
}

}  // namespace bielle::mechanism

// Properties of a formula that do not depend on its arguments: its constant parts and its break points.
#include <fmt/format.h>

#include "reduce/common/formula/formula_tree.hpp"

namespace bielle {

void FormulaTree::check_transition(double t0, double t1) {
  if (!(t0 < t1))
    throw FormulaError(fmt::format("a step, ramp or pulse must end after its start, but runs from {} to {}", t0, t1));
}

void FormulaTree::set_root(int root) {
  root_ = root;
  fold(root);
}

bool FormulaTree::depends_on(int index, int argument) const {
  if (index < 0) return false;
  const Term& t = term(index);
  if (t.operation == Operation::argument) return argument == any_argument || t.index == argument;
  for (const int operand : t.operand)
    if (depends_on(operand, argument)) return true;
  return false;
}

void FormulaTree::fold(int index) {
  Term& t = terms_[static_cast<std::size_t>(index)];
  if (t.operation == Operation::constant || t.operation == Operation::argument) return;
  if (t.operation == Operation::select) {
    fold(t.operand[0]);
    if (depends_on_arguments(t.operand[0])) {
      for (const std::size_t branch : {1U, 2U}) {
        try {
          fold(t.operand[branch]);
        } catch (const FormulaError&) {
          // A branch that is never taken may have no value.
        }
      }
      return;
    }
    const Term& condition = term(t.operand[0]);
    const int taken = condition.number != 0 ? t.operand[1] : t.operand[2];
    fold(taken);
    t = term(taken);
    return;
  }
  const bool second_may_be_skipped = t.operation == Operation::logical_and || t.operation == Operation::logical_or;
  for (std::size_t k = 0; k < (second_may_be_skipped ? 1U : 3U); ++k)
    if (t.operand[k] >= 0) fold(t.operand[k]);
  if (!depends_on_arguments(index)) {
    const double number = constant_value(index);
    t = {Operation::constant, {-1, -1, -1}, number, 0};
    return;
  }
  const auto constant = [&](std::size_t k) { return term(t.operand[k]).operation == Operation::constant; };
  const auto number = [&](std::size_t k) { return term(t.operand[k]).number; };
  if ((t.operation == Operation::divide || t.operation == Operation::modulo) && constant(1) && number(1) == 0)
    throw FormulaError("division by zero");
  const bool transition =
      t.operation == Operation::step || t.operation == Operation::ramp || t.operation == Operation::pulse;
  if (transition && constant(1) && constant(2)) check_transition(number(1), number(2));
}

FormulaTree::Linear FormulaTree::linear_in(int index, int argument) const {
  const Term& t = term(index);
  const auto operand = [&](std::size_t k) { return linear_in(t.operand[k], argument); };
  const Linear no{false, 0, 0};
  switch (t.operation) {
    case Operation::constant:
      return {true, 0, t.number};
    case Operation::argument:
      return t.index == argument ? Linear{true, 1, 0} : no;
    case Operation::negate: {
      const Linear a = operand(0);
      return {a.valid, -a.slope, -a.offset};
    }
    case Operation::add:
    case Operation::subtract: {
      const Linear a = operand(0), b = operand(1);
      const double sign = t.operation == Operation::add ? 1 : -1;
      return {a.valid && b.valid, a.slope + sign * b.slope, a.offset + sign * b.offset};
    }
    case Operation::multiply: {
      const Linear a = operand(0), b = operand(1);
      if (!a.valid || !b.valid || (a.slope != 0 && b.slope != 0)) return no;
      return {true, a.slope * b.offset + a.offset * b.slope, a.offset * b.offset};
    }
    case Operation::divide: {
      const Linear a = operand(0), b = operand(1);
      if (!a.valid || !b.valid || b.slope != 0 || b.offset == 0) return no;
      return {true, a.slope / b.offset, a.offset / b.offset};
    }
    default:
      return no;
  }
}

void FormulaTree::add_break_points(int index, int argument, std::vector<double>& points) const {
  const Term& t = term(index);
  const auto where_zero = [&](Linear g) {
    if (g.valid && g.slope != 0) points.push_back(g.offset == 0 ? 0 : -g.offset / g.slope);
  };
  const auto where_equal = [&](std::size_t i, std::size_t k) {
    const Linear a = linear_in(t.operand[i], argument), b = linear_in(t.operand[k], argument);
    where_zero({a.valid && b.valid, a.slope - b.slope, a.offset - b.offset});
  };
  switch (t.operation) {
    case Operation::abs:
    case Operation::sign:
    case Operation::logical_not:
    case Operation::select:
      where_zero(linear_in(t.operand[0], argument));
      break;
    case Operation::logical_and:
    case Operation::logical_or:
      where_zero(linear_in(t.operand[0], argument));
      where_zero(linear_in(t.operand[1], argument));
      break;
    case Operation::minimum:
    case Operation::maximum:
    case Operation::less:
    case Operation::less_or_equal:
    case Operation::greater:
    case Operation::greater_or_equal:
    case Operation::equal:
    case Operation::not_equal:
      where_equal(0, 1);
      break;
    case Operation::step:
    case Operation::ramp:
    case Operation::pulse:
      where_equal(0, 1);
      where_equal(0, 2);
      break;
    case Operation::interpolate: {
      const Linear g = linear_in(t.operand[0], argument);
      const Interpolation& function = *functions_[static_cast<std::size_t>(t.index)];
      if (function.kind() == Interpolation::Kind::linear)
        for (const double x : function.points()) where_zero({g.valid, g.slope, g.offset - x});
      break;
    }
    case Operation::on_surface: {
      const Linear gx = linear_in(t.operand[0], argument), gy = linear_in(t.operand[1], argument);
      const Surface& function = *surfaces_[static_cast<std::size_t>(t.index)];
      if (function.kind() != Interpolation::Kind::linear) break;
      for (const double x : function.x_points()) where_zero({gx.valid, gx.slope, gx.offset - x});
      for (const double y : function.y_points()) where_zero({gy.valid, gy.slope, gy.offset - y});
      break;
    }
    default:
      break;
  }
  for (const int operand : t.operand)
    if (operand >= 0) add_break_points(operand, argument, points);
}

}  // namespace bielle

#include "mechanism/laws/force_law.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "mechanism/measures/nested.hpp"
#include "mechanism/measures/read_measure.hpp"

namespace bielle::mechanism {
namespace {

constexpr std::size_t time_variable = 2;

/// Gauss-Legendre with five points: exact for polynomials up to degree nine.
template <class Function>
double gauss5(const Function& N, double from, double to) {
  static constexpr std::array<double, 3> point{0, 0.5384693101056831, 0.9061798459386640};
  static constexpr std::array<double, 3> weight{0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k)
    for (int sign : {-1, 1}) {
      if (k == 0 && sign < 0) continue;
      sum += weight[k] * N(middle + sign * half * point[k]);
    }
  return half * sum;
}

/// Halves the interval until the sum of both halves agrees with the whole, because formulas may have kinks.
template <class Function>
double integral(const Function& N, double from, double to, double whole, int depth) {
  const double middle = 0.5 * (from + to);
  const double left = gauss5(N, from, middle), right = gauss5(N, middle, to);
  if (depth == 0 || std::abs(left + right - whole) <= 1e-12 * (std::abs(left) + std::abs(right))) return left + right;
  return integral(N, from, middle, left, depth - 1) + integral(N, middle, to, right, depth - 1);
}

const KeyTable& table_keys() {
  using namespace keys;
  static const KeyTable table{
      "a law of force",
      "A force that was measured.",
      {{"table", file("table of two columns"), required,
        "Values of the coordinate, or of its rate for a damper, and of the force, with straight lines between them."}}};
  return table;
}

}  // namespace

void ForceLaw::add(StateFormula formula) {
  if (formula.reads_state() || formula.uses(time_variable)) actuator_ = true;
  formulas_.push_back(std::move(formula));
}

bool ForceLaw::has_damping() const {
  return damping_ != 0 || std::any_of(formulas_.begin(), formulas_.end(), [](const StateFormula& formula) {
           return formula.uses(1) || formula.reads_state();
         });
}

bool ForceLaw::reads_state() const {
  return std::any_of(formulas_.begin(), formulas_.end(), [](const StateFormula& each) { return each.reads_state(); });
}

bool ForceLaw::holds_time() const {
  return std::any_of(formulas_.begin(), formulas_.end(),
                     [](const StateFormula& each) { return each.holds_time(time_variable); });
}

bool ForceLaw::reads_reactions() const {
  return std::any_of(formulas_.begin(), formulas_.end(),
                     [](const StateFormula& each) { return each.reads_reactions(); });
}

double ForceLaw::force(const LocalState& state, double x, double v) const {
  double N = preload_ + stiffness_ * x + damping_ * v;
  const std::array<double, 3> variables{x, v, state.time()};
  for (const StateFormula& formula : formulas_) N += formula.value(state, variables);
  return N;
}

LawForce ForceLaw::calc(const LocalState& state, double x, double v, bool split) const {
  LawForce law{preload_ + stiffness_ * x + damping_ * v, stiffness_, damping_, preload_ + stiffness_ * x, stiffness_};
  if (formulas_.empty()) return law;
  Nested<FormulaGradient, ForceLaw> nested;  // a formula may read the force of another law
  FormulaGradient& gradient = *nested;
  const auto each = [&](double rate, const auto& take) {
    const std::array<double, 3> variables{x, rate, state.time()};
    for (const StateFormula& formula : formulas_) {
      formula.calc(state, variables, gradient);
      take();
    }
  };
  each(v, [&] {
    law.N += gradient.value;
    law.N_x += gradient.by_variable[0];
    law.N_v += gradient.by_variable[1];
  });
  if (!split) return law;
  if (actuator_) {  // the force of an actuator is defined by its power
    law.N_elastic = law.N_elastic_x = 0;
    return law;
  }
  each(0, [&] {
    law.N_elastic += gradient.value;
    law.N_elastic_x += gradient.by_variable[0];
  });
  return law;
}

void ForceLaw::add_measures(const LocalState& state, double x, double v, const Eigen::Ref<const VectorX>& direction,
                            int row, LocalTangent& tangent) const {
  const std::array<double, 3> variables{x, v, state.time()};
  Nested<FormulaGradient, ForceLaw> nested;
  FormulaGradient& gradient = *nested;
  for (const StateFormula& formula : formulas_) {
    if (!formula.reads_state()) continue;
    formula.calc(state, variables, gradient);
    if (tangent.wants_K)
      tangent.K.dense().middleRows(row, direction.size()) += direction * gradient.by_state.position().transpose();
    if (tangent.wants_C)
      tangent.C.dense().middleRows(row, direction.size()) += direction * gradient.by_state.rate().transpose();
  }
}

double ForceLaw::elastic_energy(const LocalState& state, double x) const {
  double energy = preload_ * x + 0.5 * stiffness_ * x * x;
  if (formulas_.empty()) return energy;
  const auto N = [&](double at) {
    const std::array<double, 3> variables{at, 0, state.time()};
    double sum = 0;
    for (const StateFormula& formula : formulas_) sum += formula.value(state, variables);
    return sum;
  };
  constexpr int deepest = 30;
  return energy + integral(N, 0, x, gauss5(N, 0, x), deepest);
}

std::vector<std::string> ForceLaw::describe(bool turning) const {
  const char *length = turning ? "rad" : "m", *force = turning ? "N m" : "N", *name = turning ? "torque" : "force";
  std::vector<std::string> facts;
  if (stiffness_ != 0) facts.push_back(fmt::format("stiffness {:.6g} {}/{}", stiffness_, force, length));
  if (damping_ != 0) facts.push_back(fmt::format("damping {:.6g} {} s/{}", damping_, force, length));
  if (preload_ != 0) facts.push_back(fmt::format("preload {:.6g} {}", preload_, force));
  for (const StateFormula& formula : formulas_) facts.push_back(fmt::format("{} {} [{}]", name, formula.text(), force));
  return facts;
}

void ForceLaw::add_break_points(std::vector<double>& times) const {
  for (const StateFormula& formula : formulas_) formula.add_break_points(time_variable, times);
}

KeyForms forms_of_law(const std::string& unit, const LawVariables& variables) {
  using namespace keys;
  return {state_formula(unit, {variables.coordinate, variables.rate, "t"}).non_negative(), nested(table_keys)};
}

void read_law(const YamlValue& value, const LawVariables& variables, bool of_rate, Model& model, References& references,
              ForceLaw& law) {
  const std::vector<std::string> names = {variables.coordinate, variables.rate, "t"};
  if (value.is_map()) {
    const YamlValue file = value.keyed(table_keys()).at("table");
    const std::string path = std::filesystem::absolute(file.file_path()).string();
    try {
      const Expression table(fmt::format("table('{}', {})", path, of_rate ? variables.rate : variables.coordinate),
                             names);
      law.add(StateFormula(table, names.size(), {}));
    } catch (const InputError& error) {
      file.fail(error.what());
    }
    return;
  }
  StateFormula formula = read_state_formula(value, names, model, references);
  if (!formula.is_constant()) {
    law.add(std::move(formula));
    return;
  }
  const double number = value.number();
  law.add(of_rate ? 0 : number, of_rate ? number : 0);
}

}  // namespace bielle::mechanism

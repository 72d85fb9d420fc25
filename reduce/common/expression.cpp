#include "reduce/common/expression.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/common/formula_parser.hpp"

namespace bielle {

/// Immutable, hence shared by all copies.
struct Expression::Implementation {
  FormulaTree tree;
  std::string text;
  std::vector<std::string> variables;

  [[noreturn]] void fail(const std::string& message, std::span<const double> values) const {
    std::string arguments;
    for (std::size_t i = 0; i < variables.size() && i < values.size(); ++i)
      arguments += fmt::format("{}{} = {}", i == 0 ? "" : ", ", variables[i], values[i]);
    throw ComputationError(
        fmt::format("formula '{}'{}{}: {}", text, arguments.empty() ? "" : " at ", arguments, message));
  }
};

Expression::Expression() {
  static const Expression zero(0.0);
  implementation_ = zero.implementation_;
}

Expression::Expression(double constant) {
  Implementation made;
  made.text = fmt::format("{}", constant);
  made.tree.set_root(made.tree.add_constant(constant));
  implementation_ = std::make_shared<const Implementation>(std::move(made));
}

Expression::Expression(const std::string& text, const std::vector<std::string>& variables, const Parameters& constants,
                       const std::string& folder) {
  try {
    implementation_ = std::make_shared<const Implementation>(
        Implementation{parse_formula(text, variables, constants, folder), text, variables});
  } catch (const InputError& error) {
    throw InputError(fmt::format("in '{}': {}", text, error.what()));
  } catch (const ComputationError& error) {  // a table asked outside its range by constants
    throw InputError(fmt::format("in '{}': {}", text, error.what()));
  }
}

double Expression::operator()(std::span<const double> values) const {
  try {
    return implementation_->tree.value(values);
  } catch (const FormulaError& error) {
    implementation_->fail(error.what(), values);
  } catch (const ComputationError& error) {
    implementation_->fail(error.what(), values);
  }
}

double Expression::derivative(std::span<const double> values, std::size_t argument, int order) const {
  try {
    const Jet jet = implementation_->tree.jet(values, argument);
    const double result = order == 1 ? jet.first : jet.second;
    if (std::isfinite(result)) return result;
  } catch (const FormulaError& error) {
    implementation_->fail(error.what(), values);
  } catch (const ComputationError& error) {
    implementation_->fail(error.what(), values);
  }
  implementation_->fail(fmt::format("there is no finite {} derivative", order == 1 ? "first" : "second"), values);
}

bool Expression::is_constant() const { return implementation_->tree.is_constant(); }

const std::string& Expression::text() const { return implementation_->text; }

std::vector<double> Expression::break_points(std::size_t argument) const {
  std::vector<double> points;
  implementation_->tree.add_break_points(static_cast<int>(argument), points);
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

}  // namespace bielle

#include "reduce/common/formula/expression.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/common/formula/formula_parser.hpp"
#include "reduce/common/formula/formula_references.hpp"
#include "reduce/common/shortened.hpp"

namespace bielle {

/// The content is immutable, hence shared by all copies.
struct Expression::Implementation {
  FormulaTree tree;
  std::string text;                    ///< text of the user
  std::vector<std::string> variables;  ///< names in the user's text
  std::string place = {};              ///< in a file; empty where it is not known

  [[noreturn]] void fail(const std::string& message, std::span<const double> values) const {
    std::string arguments;
    for (std::size_t i = 0; i < variables.size() && i < values.size(); ++i)
      arguments += fmt::format("{}{} = {}", i == 0 ? "" : ", ", variables[i], values[i]);
    throw ComputationError(fmt::format("{}{}formula '{}'{}{}: {}", place, place.empty() ? "" : ": ", shortened(text),
                                       arguments.empty() ? "" : " at ", arguments, message));
  }
  [[noreturn]] void fail_without_derivative(int order, std::span<const double> values) const {
    fail(fmt::format("there is no finite {} derivative", order == 1 ? "first" : "second"), values);
  }

  void check_size(double value, std::span<const double> values) const {
    if (std::abs(value) > most)
      fail(fmt::format("{:.3g} is larger than anything can be computed with", value),
           tree.is_constant() ? std::span<const double>() : values);
  }

  template <class Evaluate>
  auto evaluated(std::span<const double> values, Evaluate&& evaluate) const {
    try {
      return evaluate(tree);
    } catch (const FormulaError& error) {
      fail(error.what(), values);
    } catch (const ComputationError& error) {
      fail(error.what(), values);
    }
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
                       const std::string& folder)
    : Expression(FormulaText{text, text, {}}, variables, constants, folder) {}

Expression::Expression(const FormulaText& text, const std::vector<std::string>& variables, const Parameters& constants,
                       const std::string& folder, const std::string& place) {
  std::vector<std::string> names = variables, shown = variables;
  for (const FormulaReference& reference : text.references) {
    names.push_back(reference.identifier);
    shown.push_back(reference.text);
  }
  try {
    implementation_ = std::make_shared<const Implementation>(
        Implementation{parse_formula(text.replaced, names, shown, constants, folder), text.written, shown, place});
  } catch (const InputError& error) {
    throw InputError(fmt::format("in '{}': {}", shortened(text.written), error.what()));
  } catch (const ComputationError& error) {  // constant arguments are outside the range of a table
    throw InputError(fmt::format("in '{}': {}", shortened(text.written), error.what()));
  }
}

double Expression::operator()(std::span<const double> values) const {
  const double value = implementation_->evaluated(values, [&](const FormulaTree& tree) { return tree.value(values); });
  implementation_->check_size(value, values);
  return value;
}

double Expression::derivative(std::span<const double> values, std::size_t argument, int order) const {
  const Jet jet =
      implementation_->evaluated(values, [&](const FormulaTree& tree) { return tree.jet(values, argument); });
  const double result = order == 1 ? jet.gradient[0] : jet.second(0, 0);
  if (!std::isfinite(result)) implementation_->fail_without_derivative(order, values);
  return result;
}

double Expression::value_and_gradient(std::span<const double> values, std::span<double> gradient) const {
  const double value = implementation_->evaluated(
      values, [&](const FormulaTree& tree) { return tree.value_and_gradient(values, gradient); });
  for (const double slope : gradient)
    if (!std::isfinite(slope)) implementation_->fail_without_derivative(1, values);
  implementation_->check_size(value, values);
  return value;
}

bool Expression::uses(std::size_t argument) const { return implementation_->tree.uses(static_cast<int>(argument)); }

bool Expression::is_constant() const { return implementation_->tree.is_constant(); }

const std::string& Expression::text() const { return implementation_->text; }

const FormulaTree& Expression::tree() const { return implementation_->tree; }

std::vector<double> Expression::break_points(std::size_t argument) const {
  std::vector<double> points;
  implementation_->tree.add_break_points(static_cast<int>(argument), points);
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

}  // namespace bielle

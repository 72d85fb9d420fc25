#include "reduce/common/formula/units.hpp"

#include <cmath>
#include <map>
#include <sstream>

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/common/formula/formula_tree.hpp"

namespace bielle {

namespace {

struct Units {
  enum class Kind { unknown, free, known };
  Kind kind = Kind::unknown;
  std::map<std::string, int> exponents;  ///< exponents of the symbols; none is 0

  bool operator==(const Units&) const = default;
};

const Units unknown{}, free_of_units{Units::Kind::free, {}}, pure_number{Units::Kind::known, {}};

/// Returns a b^exponent.
Units product(const Units& a, const Units& b, int exponent) {
  if (a == unknown || b == unknown) return unknown;
  Units result{a.kind == b.kind ? a.kind : Units::Kind::known, a.exponents};
  for (const auto& [symbol, n] : b.exponents) result.exponents[symbol] += exponent * n;
  std::erase_if(result.exponents, [](const auto& entry) { return entry.second == 0; });
  return result;
}

/// Returns the units of a sum.
Units common(const Units& a, const Units& b) {
  if (a == free_of_units) return b;
  return b == free_of_units || a == b ? a : unknown;
}

Units power(const Units& a, double n) {
  constexpr double largest = 100;
  Units result{a.kind, {}};
  for (const auto& [symbol, exponent] : a.exponents) {
    const double scaled = n * exponent;
    if (scaled != std::round(scaled) || std::abs(scaled) > largest) return unknown;
    if (scaled != 0) result.exponents[symbol] = static_cast<int>(scaled);
  }
  return result;
}

// -- text

/// Reads symbols with exponents, "kg m^2", each to the power `sign`.
Units read_product(const std::string& text, int sign) {
  Units result = pure_number;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::size_t end = word.find('^');
    const std::string symbol = word.substr(0, end), exponent = end == std::string::npos ? "1" : word.substr(end + 1);
    if (symbol.empty() || symbol.find_first_of("/()0123456789") != std::string::npos) return unknown;
    if (exponent.size() != 1 || exponent < "1" || exponent > "9") return unknown;
    result = product(result, {Units::Kind::known, {{symbol, exponent[0] - '0'}}}, sign);
  }
  return result;
}

/// Reads "N m", "m^2/s^2", "N/(m s)", "1/s", "-".
Units read_units(const std::string& text) {
  if (text == "-") return pure_number;
  const std::size_t slash = text.find('/');
  const std::string above = text.substr(0, slash);
  const Units numerator = above == "1" ? pure_number : read_product(above, 1);
  if (slash == std::string::npos) return numerator == pure_number ? unknown : numerator;
  std::string below = text.substr(slash + 1);
  if (below.starts_with('(') && below.ends_with(')'))
    below = below.substr(1, below.size() - 2);
  else if (below.find(' ') != std::string::npos)
    return unknown;  // "N/m s" may mean two things
  return below.empty() || above.empty() ? unknown : product(numerator, read_product(below, -1), 1);
}

std::string text_of(const Units& units) {
  if (units.kind != Units::Kind::known) return "";
  std::string above, below;
  int divisors = 0;
  for (const auto& [symbol, exponent] : units.exponents) {
    std::string& side = exponent > 0 ? above : below;
    if (exponent < 0) ++divisors;
    side += side.empty() ? "" : " ";
    side += std::abs(exponent) == 1 ? symbol : fmt::format("{}^{}", symbol, std::abs(exponent));
  }
  if (below.empty()) return above.empty() ? "-" : above;
  return fmt::format("{}/{}", above.empty() ? "1" : above, divisors > 1 ? "(" + below + ")" : below);
}

// -- formulas

class Inference {
 public:
  Inference(const FormulaTree& tree, const std::vector<std::string>& variable_units) : tree_(tree) {
    for (const std::string& units : variable_units) arguments_.push_back(read_units(units));
  }

  Units of(int index) const {
    if (!tree_.depends_on_arguments(index)) return free_of_units;
    const FormulaTree::Term& term = tree_.term(index);
    const auto operand = [&](std::size_t k) { return of(term.operand[k]); };
    switch (term.operation) {
      case Operation::argument: {
        const auto argument = static_cast<std::size_t>(term.index);
        return argument < arguments_.size() ? arguments_[argument] : unknown;
      }
      case Operation::negate:
      case Operation::abs:
      case Operation::floor:
      case Operation::ceil:
      case Operation::round:
        return operand(0);
      case Operation::add:
      case Operation::subtract:
      case Operation::modulo:
      case Operation::minimum:
      case Operation::maximum:
        return common(operand(0), operand(1));
      case Operation::select:
        return common(operand(1), operand(2));
      case Operation::multiply:
        return product(operand(0), operand(1), 1);
      case Operation::divide:
        return product(operand(0), operand(1), -1);
      case Operation::power:
        return power_of(operand(0), term.operand[1]);
      case Operation::sqrt:
        return power(operand(0), 0.5);
      case Operation::interpolate:
      case Operation::on_surface:
        return unknown;
      default:
        return pure_number;
    }
  }

 private:
  Units power_of(const Units& base, int exponent) const {
    if (tree_.depends_on_arguments(exponent)) return unknown;
    try {
      return power(base, tree_.constant_value(exponent));
    } catch (const FormulaError&) {  // in a branch that may never be taken
      return unknown;
    } catch (const ComputationError&) {
      return unknown;
    }
  }

  const FormulaTree& tree_;
  std::vector<Units> arguments_;
};

}  // namespace

std::string units_of(const Expression& formula, const std::vector<std::string>& variable_units) {
  return text_of(Inference(formula.tree(), variable_units).of(formula.tree().root()));
}

}  // namespace bielle

#include "mechanism/elements/beam/formula_vector.hpp"

namespace bielle::mechanism {

FormulaVector read_formula_vector(const YamlValue& value, const std::string& expected) {
  if (!value.is_sequence() || value.size() != 3) value.fail("expected " + expected);
  FormulaVector vector;
  for (std::size_t k = 0; k < 3; ++k) vector[k] = value.at(k).expression();
  return vector;
}

std::string format_vector(const FormulaVector& vector) {
  return "(" + vector[0].text() + ", " + vector[1].text() + ", " + vector[2].text() + ")";
}

void add_break_points(const FormulaVector& vector, std::size_t argument, std::vector<double>& points) {
  for (const Expression& component : vector) {
    const std::vector<double> own = component.break_points(argument);
    points.insert(points.end(), own.begin(), own.end());
  }
}

}  // namespace bielle::mechanism

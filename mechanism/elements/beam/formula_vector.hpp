// A load with three components, each a formula.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "reduce/common/formula/expression.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Components along three axes; initially zero.
using FormulaVector = std::array<Expression, 3>;

/// @param value  three formulas of the variables of their form @param expected  description of them, for the message
FormulaVector read_formula_vector(const YamlValue& value, const std::string& expected);

/// Returns "(0, sin(t), 2)", as the user wrote it.
std::string format_vector(const FormulaVector& vector);

/// Adds the values of an argument at which any component jumps or has a kink.
void add_break_points(const FormulaVector& vector, std::size_t argument, std::vector<double>& points);

}  // namespace bielle::mechanism

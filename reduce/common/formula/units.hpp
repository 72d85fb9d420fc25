// Units of formulas, for headings and axes: `force*velocity` of "N" and "m/s" is in "N m/s".
//
//     sums, min, max, mod, branches of if    the units of their terms, which must be equal
//     - abs floor ceil round                 the units of the operand
//     products, quotients, whole powers      exponents add; "m/m" is "-"; roots where all exponents stay whole
//     comparisons, step, ramp, pulse, other functions   "-" (angles of atan2 and its kind as well)
//
// Constants are free: a term in a sum has the units of the others, and a factor changes none. A parameter is a constant
// as well, and its units are nowhere written, so that `k*x` of "m" is called "m" even where k is a stiffness. Symbols
// are not converted into each other: "N m" is not "J". What has no rule (x^y, a table) has unknown units.
#pragma once

#include <string>
#include <vector>

#include "reduce/common/formula/expression.hpp"

namespace bielle {

/// Units of a formula's value, as "N m", "m^2/s^2", "N/(m s)", "1/s"; "-" of a pure number; empty where they are
/// unknown.
/// @param variable_units  one for each variable, written in the same way; empty where unknown
std::string units_of(const Expression& formula, const std::vector<std::string>& variable_units);

}  // namespace bielle

// Units of formulas, for headings and axes: `force*velocity` of "N" and "m/s" is in "N m/s".
//
//     sums, min, max, mod, branches of if    the units of their terms, which must be equal
//     - abs floor ceil round                 the units of the operand
//     products, quotients, whole powers      exponents add; "m/m" is "-"; roots where all exponents stay whole
//     comparisons, step, ramp, pulse, other functions   "-" (angles of atan2 and its kind as well)
//
// Constants have no fixed units: a constant term of a sum has the units of the others, and a constant factor does not
// change them. A parameter is a constant as well, and its units are not declared, so that `k*x` of "m" has "m" even if
// k is a stiffness. Symbols are not converted into each other: "N m" is not "J". Operations without a rule (x^y, a
// table) have unknown units.
#pragma once

#include <string>
#include <vector>

#include "reduce/common/formula/expression.hpp"

namespace bielle {

/// Units of a formula's value, such as "N m", "m^2/s^2", "N/(m s)", "1/s"; "-" for a pure number; empty if they are
/// unknown.
/// @param variable_units  units of each variable, in the same notation; empty if unknown
std::string units_of(const Expression& formula, const std::vector<std::string>& variable_units);

}  // namespace bielle

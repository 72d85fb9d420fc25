// Reader of the key `newton` of analyses: options for solving the equations of a step.
#pragma once

#include "mechanism/solvers/newton/convergence.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Reads `newton: {tolerance, iterations, line_search, tangent}` of an analysis; defaults apply if it is missing.
/// @param dynamic  whether the key `tangent` is allowed. @throws InputError
NewtonOptions read_newton(const YamlValue& analysis, bool dynamic);

}  // namespace bielle::mechanism

// The key `newton` of analyses: how the equations of a step are solved.
#pragma once

#include "mechanism/solvers/newton/convergence.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// `newton: {tolerance, iterations, line_search, tangent}` of an analysis, or the defaults where it has none.
/// @param dynamic  there is a `tangent`. @throws InputError
NewtonOptions read_newton(const YamlValue& analysis, bool dynamic);

}  // namespace bielle::mechanism

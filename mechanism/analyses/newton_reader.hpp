// Reader of the key `newton` of analyses: options for solving the equations of a step.
#pragma once

#include "mechanism/solvers/newton/convergence.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Return the key `newton` of a static analysis, and that of a dynamic one, which also has `tangent`.
Key newton_key();
Key dynamic_newton_key();

/// Reads the key `newton` of an analysis; defaults apply if it is missing. @throws InputError
NewtonOptions read_newton(const YamlValue& analysis);

}  // namespace bielle::mechanism

// Functions of formulas whose operands are no numbers: names of nodes, `distance(a, b)`; a formula of measures whose
// past is needed, `delay(main.angle, 0.02)`.
#pragma once

#include <string>
#include <vector>

namespace bielle::mechanism {

inline const std::vector<std::string>& functions_of_names() {
  static const std::vector<std::string> functions = {"distance", "angle"};
  return functions;
}

inline const std::vector<std::string>& functions_of_formulas() {
  static const std::vector<std::string> functions = {"delay"};
  return functions;
}

}  // namespace bielle::mechanism

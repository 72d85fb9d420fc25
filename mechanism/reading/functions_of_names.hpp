// Functions of formulas whose operands are names of nodes: `distance(a, b)`.
#pragma once

#include <string>
#include <vector>

namespace bielle::mechanism {

inline const std::vector<std::string>& functions_of_names() {
  static const std::vector<std::string> functions = {"distance", "angle"};
  return functions;
}

}  // namespace bielle::mechanism

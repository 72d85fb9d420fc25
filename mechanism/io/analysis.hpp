// What a mechanism file asks to be computed: an entry of its section `analysis`.
#pragma once

#include <optional>
#include <string>

#include "mechanism/solvers/arc_length.hpp"
#include "mechanism/solvers/march.hpp"
#include "mechanism/system/model.hpp"

namespace bielle::mechanism {

struct Analysis {
  enum class Type { assembly, statics, dynamics } type;
  std::string name;                 ///< as in the file: "dynamic"
  int steps = 1;                    ///< statics; 0: chosen by the program
  std::optional<PathOptions> path;  ///< statics that follow a path
  double duration = 0;              ///< [s] dynamics
  StepOptions stepping;             ///< without break points
  Scheme scheme{};                  ///< dynamics
  ConstraintForm form = ConstraintForm::corrected;
  NewtonOptions newton;      ///< statics and dynamics
  bool equilibrium = false;  ///< dynamics: positions of static equilibrium first
  std::string scheme_name;   ///< for the summary
};

/// Reads an entry. @throws InputError
Analysis read_analysis(const YamlValue& entry, const Model& model);

}  // namespace bielle::mechanism

// The mechanism file: a model, the analyses to run on it, and what to record.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mechanism/solvers/arc_length.hpp"
#include "mechanism/solvers/march.hpp"
#include "mechanism/system/model.hpp"

namespace bielle::mechanism {

/// One entry of `analysis`.
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

struct OutputOptions {
  int every = 1;  ///< steps between records; the first and the last are always recorded
  /// [s], ascending: if any, dynamic analyses record their start and these times in place of steps.
  std::vector<double> times;
  bool log = false;    ///< a table of all attempted steps beside the results
  int checkpoint = 0;  ///< steps between points that a run can go on from; 0: at the end of dynamic analyses only
};

struct MechanismFile {
  Model model;
  std::vector<Analysis> analyses;
  OutputOptions output;
  std::string text;  ///< of the file
  std::string path;  ///< of the file; empty when read from a text
};

/// Reads a mechanism file.
/// @param overrides  parameters given on the command line, `NAME` -> `EXPRESSION`
/// @throws InputError
MechanismFile read_mechanism_file(const std::string& path, const std::map<std::string, std::string>& overrides = {});

/// The same from a file's text, `name` standing for the file in messages.
MechanismFile read_mechanism_text(const std::string& text, const std::string& name,
                                  const std::map<std::string, std::string>& overrides = {});

}  // namespace bielle::mechanism

// Modes as results: arrays for the sinks, and energies of the parts of the model.
#pragma once

#include <string>
#include <vector>

#include "mechanism/analyses/modes.hpp"

namespace bielle::mechanism {

/// Energies of modes, by the entries of the model file.
struct ModeParts {
  std::vector<std::string> names;     ///< names of the parts: "element 'rod'"
  MatrixX kinetic, potential, share;  ///< (parts, modes); share: fraction of the sum of T + |V|
};
ModeParts mode_parts(const Model& model, const ModesReport& report);

/// Writes the datasets `eigen/...` of the open analysis (mechanism/io/modes.md).
void write_modes(Session& session, const ModesReport& report, const ModeParts& parts, bool shapes);

}  // namespace bielle::mechanism

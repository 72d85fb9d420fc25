// A hydrodynamic journal bearing: the pressure of the film between a turning journal and its bush (journal_film.hpp).
//
// The measures are those of shaft_bearing.hpp. The forces act along x and y and depend on the displacement of the
// journal, its rate, and the speed of the shaft relative to the bush; the film is isothermal, of constant viscosity and
// without inertia. The bearing resists neither axial motion nor tilt, and the friction of the film on the shaft is left
// out. If the journal touches the bush, there is no film and the run ends. Without motion there is no force.
#pragma once

#include "mechanism/joints/flexible/journal_film.hpp"
#include "mechanism/joints/flexible/shaft_bearing.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

struct JournalGeometry {
  double diameter = 0;   ///< [m]
  double length = 0;     ///< [m]
  double clearance = 0;  ///< radial clearance c [m]
  double viscosity = 0;  ///< mu [Pa s]
};

class JournalBearingLaw final : public BearingLaw {
 public:
  /// @param finite  whether the flow along the circumference is taken into account
  JournalBearingLaw(const JournalGeometry& geometry, bool finite, Cavitation cavitation = Cavitation::half);
  Force calc(const Vector6& e, const Vector6& v) const override;
  bool has_rates() const override { return true; }
  bool has_kinks() const override { return true; }  // without motion the film has no direction
  std::string refusal(const Vector6& e) const override;
  std::vector<std::string> describe() const override;

 private:
  JournalGeometry geometry_;
  bool finite_;
  Cavitation cavitation_;
  JournalFilm film_;
};

const KeyTable& journal_bearing_keys();
/// Reads `{type: journal_bearing, nodes, position | at, axis, diameter, length, clearance, viscosity, model,
/// cavitation}`.
void read_journal_bearing(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism

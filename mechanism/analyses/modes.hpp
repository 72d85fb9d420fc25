// Modes of small motions about the present state of a session.
#pragma once

#include <memory>
#include <optional>

#include "mechanism/analyses/linearised_setting.hpp"
#include "mechanism/analyses/standing_state.hpp"
#include "mechanism/solvers/linearised/mode_parts.hpp"
#include "mechanism/solvers/linearised/modes.hpp"

namespace bielle::mechanism {

struct ModesOptions {
  ModeOptions search;
  std::optional<SteadyRotation> rotation = {};  ///< modes about the steady rotation that begins at the state
  std::optional<ModeAxes> axes = {};            ///< axes of the modes; empty: chosen according to the motion
  bool energies = true;                         ///< whether energies are computed
  /// Number of harmonics of periodic equations that is tried first; it is increased until the modes are resolved.
  int harmonics = 1;
};

struct ModesReport : LinearisedSetting {
  StandingState about;
  Modes found;  ///< shapes have unit size (unit_factor)
  MemberEnergies energies;
  std::shared_ptr<const LinearisedEquations> equations;  ///< the linearised equations of the modes
  /// In steady rotation: number of motions for which centrifugal forces exceed the stiffness (count_outweighed).
  std::optional<int> outweighed;
  /// Harmonics of the modes in steady rotation behind a joint. In this case `found` has the shapes, and `equations` the
  /// equations, at azimuth 0. Empty at rest.
  std::shared_ptr<const HarmonicModes> harmonic;
  /// Returns the sense of whirl of a mode in steady rotation behind a joint: 1 forwards, -1 backwards, NaN if it has
  /// none.
  double turning_whirl(const System& system, std::size_t mode) const;
  Vector3 turning_axis = Vector3::Zero();  ///< unit vector of its axis, inertial
  std::vector<char> turning_nodes;         ///< for each node, whether it turns; empty without such a rotation
};

/// Computes the modes; the state of the session is not changed. @throws ComputationError
ModesReport compute_modes(Session& session, const ModesOptions& options);

}  // namespace bielle::mechanism

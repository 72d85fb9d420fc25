// Kinematics and inverse dynamics of a session.
#pragma once

#include <string>
#include <vector>

#include "mechanism/session/energy_balance.hpp"
#include "mechanism/session/session.hpp"
#include "mechanism/solvers/start/start_report.hpp"

namespace bielle::mechanism {

struct KinematicsOptions {
  double duration = 0;  ///< [s] > 0
  double step = 0;      ///< between two positions [s] > 0; the last one may be made smaller to fit
  /// Elastic parts follow in equilibrium under inertia forces (quasi_static_motion.hpp); otherwise they are refused.
  bool elastic = false;
};

struct KinematicsReport {
  StartReport start;
  long points = 0;
  long events = 0;                       ///< crossings met
  std::string last_event;                ///< its name; empty: there was none
  bool stopped_by_event = false;         ///< before the end of the duration
  Energy energy;                         ///< at the end; input and dissipation since the start [J]
  double balance = 0;                    ///< what is missing in their balance [J]
  bool elastic = false;                  ///< something deforms
  double left_out = 0;                   ///< by then, see QuasiStaticMotion::left_out
  std::vector<std::string> indifferent;  ///< coordinates that nothing drives or loads, and that stay at rest
};

/// A mechanism whose every motion is driven: positions, velocities, accelerations and the forces that belong to them,
/// time after time, without integration; elastic parts follow in equilibrium, if asked for. @throws InputError naming
/// what is free, ComputationError naming what cannot be satisfied
KinematicsReport compute_kinematics(Session& session, const KinematicsOptions& options);

}  // namespace bielle::mechanism

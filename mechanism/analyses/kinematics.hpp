// Kinematics and inverse dynamics of a session.
#pragma once

#include <string>
#include <vector>

#include "mechanism/session/energy_balance.hpp"
#include "mechanism/session/session.hpp"
#include "mechanism/solvers/start/start_report.hpp"

namespace bielle::mechanism {

struct KinematicsOptions {
  double duration = 0;  ///< duration [s] > 0
  double step = 0;      ///< time between two positions [s] > 0; it is reduced to fit a whole number of times
  /// Elastic parts are in equilibrium under inertia forces (quasi_static_motion.hpp); if false, elastic parts are an
  /// error.
  bool elastic = false;
};

struct KinematicsReport {
  StartReport start;
  long points = 0;
  long events = 0;                       ///< number of events
  std::string last_event;                ///< name of the last event; empty: no event occurred
  bool stopped_by_event = false;         ///< an event stopped the analysis before the end of the duration
  Energy energy;                         ///< stored energies at the end; input and dissipation since the start [J]
  double balance = 0;                    ///< missing energy in the energy balance [J]
  bool elastic = false;                  ///< whether something deforms
  double left_out = 0;                   ///< omitted inertia part at the end, see QuasiStaticMotion::left_out
  std::vector<std::string> indifferent;  ///< coordinates without drive or load, which stay at rest
};

/// Computes a mechanism whose motions are all driven: positions, velocities, accelerations and the corresponding
/// forces, at a sequence of times, without integration; elastic parts are in equilibrium if requested. @throws
/// InputError naming free motions, ComputationError naming conditions that cannot be satisfied
KinematicsReport compute_kinematics(Session& session, const KinematicsOptions& options);

}  // namespace bielle::mechanism

// What a session is asked in kinematics and inverse dynamics, and what it answers.
#pragma once

#include <string>
#include <vector>

#include "mechanism/session/energy_balance.hpp"
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

}  // namespace bielle::mechanism

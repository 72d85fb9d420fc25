// What a session is asked in kinematics and inverse dynamics, and what it answers.
#pragma once

#include "mechanism/session/energy_balance.hpp"
#include "mechanism/solvers/start/start_report.hpp"

namespace bielle::mechanism {

struct KinematicsOptions {
  double duration = 0;  ///< [s] > 0
  double step = 0;      ///< between two positions [s] > 0; the last one may be made smaller to fit
};

struct KinematicsReport {
  StartReport start;
  long points = 0;
  Energy energy;       ///< at the end; input and dissipation since the start [J]
  double balance = 0;  ///< what is missing in their balance [J]
};

}  // namespace bielle::mechanism

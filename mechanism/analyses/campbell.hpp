// Modes over the speed of a rotor.
#pragma once

#include <string>
#include <vector>

#include "mechanism/analyses/linearised_setting.hpp"
#include "mechanism/math/types.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/session/session.hpp"
#include "mechanism/solvers/linearised/speed_sweep.hpp"

namespace bielle::mechanism {

struct CampbellOptions {
  /// A parameter of the model, which is made anew with each value; empty: the values are rates of a rotation of the
  /// present state [rad/s].
  std::string parameter;
  ModelMaker maker;                   ///< of these models
  bool rotation = false;              ///< everything free is brought into steady rotation; always without a parameter
  Vector3 axis = Vector3::Zero();     ///< unit vector; zero: that of the fastest node at the last value
  Vector3 through = Vector3::Zero();  ///< a point of the axis [m]
  std::string rate;                   ///< of the rotation [rad/s], a formula of the parameters; empty: the parameter
  int node = -1;                      ///< whose angular velocity is the speed; -1: the fastest
  std::vector<double> values;         ///< ascending, at least two
  int modes = 8;                      ///< how many are tracked: the slowest that oscillate at the first value
  std::vector<double> orders = {1};   ///< multiples of the speed > 0
};

struct Campbell : LinearisedSetting {  ///< the setting is that of the last value
  SweptModes swept;
  Vector3 axis = Vector3::Zero();
  std::vector<double> unsteady;  ///< values at which the motion was not steady in these axes
  std::string gathered;          ///< lines of the components of another model, that of the last value
};

/// Modes over a speed, tracked, with critical speeds; the present state of the session stays. If the analysis is
/// stopped, it returns the values so far.
/// @throws InputError where nothing turns, or the model cannot be made with another parameter; ComputationError
Campbell compute_campbell(Session& session, const CampbellOptions& options);

}  // namespace bielle::mechanism

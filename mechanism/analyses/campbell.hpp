// Modes as functions of the speed of a rotor.
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
  /// Name of a parameter of the model, which is created again with each value; if empty, the values are rates of a
  /// rotation of the present state [rad/s].
  std::string parameter;
  ModelMaker maker;       ///< creates these models
  bool rotation = false;  ///< whether everything is brought into steady rotation; true without a parameter
  std::string joint;      ///< joint that drives the turning part; empty: the whole mechanism turns
  /// With a joint: whether modes are those about the mean state (SteadyRotation::mean).
  bool mean = false;
  Vector3 axis = Vector3::Zero();     ///< unit vector; zero: axis of the fastest node at the last value
  Vector3 through = Vector3::Zero();  ///< a point of the axis [m]
  std::string rate;                   ///< rate of rotation [rad/s], a formula of the parameters; empty: the parameter
  int node = -1;                      ///< node whose angular velocity is the speed; -1: the fastest
  std::vector<double> values;         ///< values of the parameter or rate, ascending, at least two
  int modes = 8;                      ///< number of tracked modes: the slowest that oscillate at the first value
  std::vector<double> orders = {1};   ///< multiples of the speed > 0, for critical speeds
};

/// The setting is that of the last value. For a rotation behind a joint, the number of harmonics and the change by one
/// more harmonic are the largest of all values.
struct Campbell : LinearisedSetting {
  SweptModes swept;
  Vector3 axis = Vector3::Zero();  ///< zero for a rotation behind a joint
  std::vector<double> unsteady;    ///< values at which the motion was not steady in these axes
  /// Name of each mode (mode_names.hpp) at the last value, among all modes of that value. A mode that is lost before it
  /// has its name at the first value, with the word "lost".
  std::vector<std::string> names;
  /// Whether a callback threw Interrupted: the points are those computed before it, perhaps none.
  bool interrupted = false;
  std::string gathered;  ///< summary of the step recorders of another model, for the last value
};

/// Computes the modes over a speed, tracked, with critical speeds; the present state of the session is not changed. If
/// the analysis is stopped or interrupted, it returns the values computed so far.
/// @throws InputError if nothing rotates, or the model cannot be created with another parameter; ComputationError
Campbell compute_campbell(Session& session, const CampbellOptions& options);

}  // namespace bielle::mechanism

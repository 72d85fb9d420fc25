// Modes over the speed of a rotor: what a session is asked, and what it answers.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mechanism/math/types.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/session/linearised_setting.hpp"
#include "mechanism/solvers/linearised/speed_sweep.hpp"

namespace bielle::mechanism {

/// The same model with another value of one of its parameters. @throws InputError
using ModelMaker = std::function<Model(const std::string& parameter, double value)>;

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
};

}  // namespace bielle::mechanism

// What the start of a motion had to change, for those who report it.
#pragma once

#include <string>
#include <vector>

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

struct StartReport {
  double largest_displacement = 0;  ///< of a node by the assembly of positions [m]
  std::string displaced_node;       ///< that node's name
  double largest_rotation = 0;      ///< [rad]
  double velocity_change = 0;       ///< largest change of a nodal velocity [m/s]
  double impulse_work = 0;          ///< of drives and supports that bring about such a change [J]
  double settled = 0;               ///< largest displacement of a node by static equilibrium, if asked for [m]
  std::string settled_node;         ///< that node's name
  double balanced = 0;              ///< largest displacement of a node without mass, to where its forces balance [m]
  std::string balanced_node;        ///< that node's name
  std::string unbalanced;           ///< an unknown without mass whose forces could not be balanced; empty: none
  std::vector<std::string> held;    ///< first-order unknowns that static equilibrium has left where they were
  void add(const StartReport& later);
};

/// The node that has moved farthest from one state to another, where that is farther than what is noted already.
/// @param distance,node  how far [m], and its name
void note_farthest(const System& system, const State& from, const State& to, double& distance, std::string& node);

}  // namespace bielle::mechanism

// What the start of a motion had to change, for those who report it.
#pragma once

#include <string>
#include <vector>

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// How far the assembly of positions has moved a node.
struct MovedNode {
  std::string name;
  double displacement = 0;  ///< [m]
  double rotation = 0;      ///< [rad]
};

/// By how much it has changed a coordinate of a component.
struct MovedCoordinate {
  std::string name;   ///< "angle of joint 'main'"
  std::string units;  ///< "m" or "rad"
  double from = 0, to = 0;
};

/// A joint carries this part at the start as one rigid body.
struct CarriedPart {
  std::string joint;               ///< "joint 'main'"
  std::vector<std::string> nodes;  ///< that got their velocity by it, in the order of the file
  int inner = 0;                   ///< further ones, within elements
};

struct StartReport {
  double largest_displacement = 0;     ///< of a node by the assembly of positions [m]
  std::string displaced_node;          ///< that node's name
  double largest_rotation = 0;         ///< [rad]
  double velocity_change = 0;          ///< largest change of a nodal velocity [m/s]
  double impulse_work = 0;             ///< of drives and supports that bring about such a change [J]
  double settled = 0;                  ///< largest displacement of a node by static equilibrium, if asked for [m]
  std::string settled_node;            ///< that node's name
  int unstable = 0;                    ///< motions along which that equilibrium has a negative stiffness
  std::string unstable_motion;         ///< what moves most in one of them: "x at node 'tip'"
  std::string loose;                   ///< what nothing holds or loads there, and stays as drawn; empty: nothing
  double balanced = 0;                 ///< largest displacement of a node without mass, to where its forces balance [m]
  std::string balanced_node;           ///< that node's name
  std::string unbalanced;              ///< an unknown without mass whose forces could not be balanced; empty: none
  std::vector<std::string> held;       ///< first-order unknowns that static equilibrium has left where they were
  std::vector<MovedNode> moved_nodes;  ///< by the assembly of positions, in order: the farthest first
  std::vector<MovedCoordinate> moved_coordinates;  ///< likewise
  std::vector<std::string>
      following;  ///< start rates that follow from others and agree with them: "angle of joint 'b'"
  std::vector<CarriedPart> carried;
  void add(const StartReport& later);
};

/// The node that has moved farthest from one state to another, where that is farther than what is noted already.
/// @param distance,node  how far [m], and its name
void note_farthest(const System& system, const State& from, const State& to, double& distance, std::string& node);

/// Notes what the assembly of positions has moved: the largest motions, and all nodes and coordinates.
void note_moved(const System& system, const Environment& environment, const State& from, const State& to,
                StartReport& report);

}  // namespace bielle::mechanism

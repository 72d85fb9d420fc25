// Report on the changes made at the start of a motion.
#pragma once

#include <string>
#include <vector>

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// Movement of a node by the assembly of positions.
struct MovedNode {
  std::string name;
  double displacement = 0;  ///< [m]
  double rotation = 0;      ///< [rad]
};

/// Change of a coordinate of a component by the assembly.
struct MovedCoordinate {
  std::string name;   ///< "angle of joint 'main'"
  std::string units;  ///< "m" or "rad"
  double from = 0, to = 0;
};

/// A part that a joint carries at the start as one rigid body.
struct CarriedPart {
  std::string joint;               ///< "joint 'main'"
  std::vector<std::string> nodes;  ///< nodes whose velocity is set by the joint, in the order of the file
  int inner = 0;                   ///< number of further nodes, within elements
};

struct StartReport {
  double largest_displacement = 0;  ///< largest by the assembly of positions [m]
  std::string displaced_node;       ///< name of that node
  double largest_rotation = 0;      ///< [rad]
  double velocity_change = 0;       ///< largest change of a nodal velocity [m/s]
  double angular_change = 0;        ///< largest change of a nodal angular velocity that was not zero [rad/s]
  double impulse_work = 0;          ///< work of drives and supports that cause this change [J]
  double settled = 0;               ///< largest displacement of a node by static equilibrium, if requested [m]
  std::string settled_node;         ///< name of that node
  int unstable = 0;                 ///< number of motions for which that equilibrium has a negative stiffness
  std::string unstable_motion;      ///< unknown with the largest part in one of them: "x at node 'tip'"
  std::string loose;                ///< unknown without support or load, which keeps its initial value; empty: none
  /// Largest displacement of a node without mass to the position where its forces balance [m].
  double balanced = 0;
  std::string balanced_node;           ///< name of that node
  std::string unbalanced;              ///< an unknown without mass whose forces could not be balanced; empty: none
  std::vector<std::string> held;       ///< first-order unknowns that static equilibrium does not determine
  std::vector<MovedNode> moved_nodes;  ///< nodes moved by the assembly of positions, the largest first
  std::vector<MovedCoordinate> moved_coordinates;  ///< coordinates changed by it, the largest first
  std::vector<std::string>
      following;  ///< start rates that follow from others and agree with them: "angle of joint 'b'"
  std::vector<CarriedPart> carried;
  void add(const StartReport& later);
  /// Records changes of velocities. @param before,change  (dofs)
  void note_change(const System& system, const VectorX& before, const VectorX& change);
};

/// Records the node that has moved farthest from one state to another, if it is farther than the one already recorded.
/// @param distance,node  distance [m], and name of the node
void note_farthest(const System& system, const State& from, const State& to, double& distance, std::string& node);

/// Records the movements by the assembly of positions: the largest ones, and all nodes and coordinates.
void note_moved(const System& system, const Environment& environment, const State& from, const State& to,
                StartReport& report);

}  // namespace bielle::mechanism

// Dependence of the six directions of each node on the independent unknowns: free, fixed, prescribed in time, or
// carried rigidly.
//
// A node that is not carried has independent increments dp with dz = [dx; dTheta] = G dp, G (6,n) constant: unit
// columns for free directions; a node that may only rotate about one inertial axis e has the column [0; R_start^T e].
// For a node j carried by i at (c, R_c) (in i's axes): x_j = x_i + R_i c, R_j = R_i R_c, hence
//     dz_j = A dz_i,                      A = [I, -R_i c~; 0, R_c^T]
//     v_j = A v_i,                        dv_j = A dv_i + V dz_i,        V   = [0, -R_i (Omega~ c)~; 0, 0]
//     a_j = A a_i + [R_i Omega~ Omega~ c; 0],  da_j = A da_i + W_v dv_i + W_z dz_i,
//     W_v = [0, -R_i ((Omega~ c)~ + Omega~ c~); 0, 0],  W_z = [0, -R_i (Omegadot~ c + Omega~ Omega~ c)~; 0, 0].
// Fixed, prescribed and carried directions are eliminated. One rotation that is fixed alone and directions along other
// than the inertial axes are free here, and constrained by elements/forces/held_directions.hpp.
#pragma once

#include <vector>

#include "mechanism/model/model.hpp"

namespace bielle::mechanism {

/// Columns of G of one node, and the indices of its independent increments among the unknowns.
struct NodeFreedom {
  int begin = 0;          ///< first independent unknown
  int count = 0;          ///< number of unknowns, 0..6
  int rotations = 0;      ///< 0, 1 (about one axis) or 3: the last columns of G
  bool all_free = false;  ///< whether G = I
  Eigen::Matrix<double, 6, 6> G = Eigen::Matrix<double, 6, 6>::Zero();  ///< its first `count` columns are used
};

/// A rigid carry: node `node` follows `carrier` at offset `c` and relative rotation `R_c`.
struct Carry {
  int node = 0, carrier = 0;  ///< the carrier itself is not carried (chains are resolved)
  Vector3 c;
  Matrix3 R_c;
};

class NodeKinematics {
 public:
  /// @throws InputError for invalid supports (one free rotation and a prescribed one, a circle of carriers)
  explicit NodeKinematics(const Model& model);

  int unknowns() const { return unknowns_; }
  const NodeFreedom& freedom(int node) const { return freedom_[static_cast<std::size_t>(node)]; }
  /// Returns the node that an independent unknown moves.
  int node_of(int unknown) const { return node_of_unknown_[static_cast<std::size_t>(unknown)]; }
  /// A node that is free in all directions, and its first unknown: most nodes are, so that they have loops of their
  /// own.
  struct FreeNode {
    std::size_t node;
    Eigen::Index begin;
  };
  const std::vector<FreeNode>& all_free() const { return all_free_; }
  /// Returns the carry of a node, or nullptr.
  const Carry* carry(int node) const;
  bool any_prescribed() const { return !prescribed_.empty(); }

  /// Sets start positions and rates of all nodes at the given time.
  void start(std::vector<NodeState>& nodes, double time) const;
  /// Sets nodes = base o exp(G dp); prescribed and carried nodes follow. @param dp (unknowns)
  /// @param motion_factor  fraction of the prescribed motions that is applied
  void displace(std::vector<NodeState>& nodes, const std::vector<NodeState>& base, const Eigen::Ref<const VectorX>& dp,
                double time, double motion_factor) const;
  /// Sets the rates of all nodes from the independent ones. @param v,a (unknowns)
  void set_rates(std::vector<NodeState>& nodes, const Eigen::Ref<const VectorX>& v, const Eigen::Ref<const VectorX>& a,
                 double time) const;
  /// Gets the independent rates of the free directions (inverse of set_rates).
  void get_rates(const std::vector<NodeState>& nodes, Eigen::Ref<VectorX> v, Eigen::Ref<VectorX> a) const;

  /// Forces on all nodes are stored in one vector: those on nodes that are free in all directions at the indices of
  /// their unknowns, those on other nodes after all unknowns. Returns the first of the six rows [force (inertial);
  /// moment (node axes)] of a node.
  int force_row(int node) const { return force_row_[static_cast<std::size_t>(node)]; }
  int force_rows() const { return unknowns_ + 6 * static_cast<int>(held_.size()); }
  /// Transfers the forces on carried nodes to their carriers. @param forces (force_rows)
  void carry_forces(const std::vector<NodeState>& nodes, Eigen::Ref<VectorX> forces) const;
  /// Computes the forces along the independent increments: G^T f of each node. @param forces (force_rows) @param r
  /// (unknowns)
  void reduce_forces(const Eigen::Ref<const VectorX>& forces, Eigen::Ref<VectorX> r) const;
  /// Power [W] supplied by supports: forces in held directions times their prescribed velocities. @param forces
  /// (force_rows)
  double support_power(const std::vector<NodeState>& nodes, const Eigen::Ref<const VectorX>& forces) const;

 private:
  void add_carried(const Model& model, int node, int root);
  void add_own(const Model& model, int node);
  void set_force_rows();
  void prescribe_positions(std::vector<NodeState>& nodes, double time, double motion_factor) const;
  void follow_carriers(std::vector<NodeState>& nodes) const;

  /// A node with prescribed directions.
  struct Prescribed {
    int node;
    Frame start;
    std::array<Freedom, 6> freedom;
    std::array<PrescribedMotion, 6> motion;
    bool rotation;  ///< all three rotations follow `motion`
  };
  int unknowns_ = 0;
  std::vector<NodeFreedom> freedom_;
  std::vector<int> node_of_unknown_;
  std::vector<FreeNode> all_free_;
  std::vector<std::size_t> held_;  ///< nodes that are not free in all directions
  std::vector<int> force_row_;     ///< first row of the force on each node
  std::vector<Carry> carries_;
  std::vector<int> carry_of_node_;  ///< index into carries_, or -1
  std::vector<Prescribed> prescribed_;
  std::vector<NodeState> start_;
};

}  // namespace bielle::mechanism

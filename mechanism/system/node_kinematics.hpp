// How the six directions of each node follow the independent unknowns: free, fixed, prescribed in time, or carried
// rigidly.
//
// A node that moves by itself has independent increments dp with dz = [dx; dTheta] = G dp, G (6,n) constant: unit
// columns for free directions; a node that may turn about one inertial axis e only has the column [0; R_start^T e]. A
// node j carried by i at (c, R_c) (in i's axes) has x_j = x_i + R_i c, R_j = R_i R_c, hence
//     dz_j = A dz_i,                      A = [I, -R_i c~; 0, R_c^T]
//     v_j = A v_i,                        dv_j = A dv_i + V dz_i,        V   = [0, -R_i (Omega~ c)~; 0, 0]
//     a_j = A a_i + [R_i Omega~ Omega~ c; 0],  da_j = A da_i + W_v dv_i + W_z dz_i,
//     W_v = [0, -R_i ((Omega~ c)~ + Omega~ c~); 0, 0],  W_z = [0, -R_i (Omegadot~ c + Omega~ Omega~ c)~; 0, 0].
// Fixed, prescribed and carried directions are eliminated, never constrained.
#pragma once

#include <vector>

#include "mechanism/model/model.hpp"

namespace bielle::mechanism {

/// Columns of G of one node and where its independent increments stand among the unknowns.
struct NodeFreedom {
  int begin = 0;          ///< first independent unknown
  int count = 0;          ///< 0..6
  int rotations = 0;      ///< 0, 1 (about one axis) or 3: the last columns of G
  bool all_free = false;  ///< G = I
  Eigen::Matrix<double, 6, 6> G = Eigen::Matrix<double, 6, 6>::Zero();  ///< first `count` columns
};

/// A rigid carry: node `node` follows `carrier` at offset `c` and relative rotation `R_c`.
struct Carry {
  int node = 0, carrier = 0;  ///< the carrier itself is not carried (chains are resolved)
  Vector3 c;
  Matrix3 R_c;
};

class NodeKinematics {
 public:
  /// @throws InputError for holds that have no meaning (one free rotation and a prescribed one, carried in a circle)
  explicit NodeKinematics(const Model& model);

  int unknowns() const { return unknowns_; }
  const NodeFreedom& freedom(int node) const { return freedom_[static_cast<std::size_t>(node)]; }
  /// The node that an independent unknown moves.
  int node_of(int unknown) const { return node_of_unknown_[static_cast<std::size_t>(unknown)]; }
  /// A node that is free in all directions, and its first unknown: most nodes are, and the loops over them are short.
  struct FreeNode {
    std::size_t node;
    Eigen::Index begin;
  };
  const std::vector<FreeNode>& all_free() const { return all_free_; }
  /// The carry of a node, or nullptr.
  const Carry* carry(int node) const;
  bool any_prescribed() const { return !prescribed_.empty(); }

  /// Start positions and rates of all nodes at the given time.
  void start(std::vector<NodeState>& nodes, double time) const;
  /// nodes = base o exp(G dp), prescribed and carried nodes following. @param dp (unknowns)
  /// @param motion_factor  part of the prescribed motions that is made
  void displace(std::vector<NodeState>& nodes, const std::vector<NodeState>& base, const Eigen::Ref<const VectorX>& dp,
                double time, double motion_factor) const;
  /// Rates of all nodes from the independent ones. @param v,a (unknowns)
  void set_rates(std::vector<NodeState>& nodes, const Eigen::Ref<const VectorX>& v, const Eigen::Ref<const VectorX>& a,
                 double time) const;
  /// Independent rates of the free directions (inverse of set_rates on them).
  void get_rates(const std::vector<NodeState>& nodes, Eigen::Ref<VectorX> v, Eigen::Ref<VectorX> a) const;

  /// Forces on all nodes in one vector: those on nodes that are free in all directions stand where their unknowns do,
  /// those on others after all unknowns. First of the six rows [force (inertial); moment (node axes)] of a node.
  int force_row(int node) const { return force_row_[static_cast<std::size_t>(node)]; }
  int force_rows() const { return unknowns_ + 6 * static_cast<int>(held_.size()); }
  /// Hands the forces on carried nodes to their carriers. @param forces (force_rows)
  void carry_forces(const std::vector<NodeState>& nodes, Eigen::Ref<VectorX> forces) const;
  /// Forces along the independent increments: G^T f of each node. @param forces (force_rows) @param r (unknowns)
  void reduce_forces(const Eigen::Ref<const VectorX>& forces, Eigen::Ref<VectorX> r) const;
  /// Power [W] that supports put in: forces of held directions times their prescribed velocities. @param forces
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
  std::vector<std::size_t> held_;  ///< the others
  std::vector<int> force_row_;     ///< of each node
  std::vector<Carry> carries_;
  std::vector<int> carry_of_node_;  ///< index into carries_, or -1
  std::vector<Prescribed> prescribed_;
  std::vector<NodeState> start_;
};

}  // namespace bielle::mechanism

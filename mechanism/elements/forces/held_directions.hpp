// Directions of a node that are held by constraints: one or two rotations, and directions along axes that are not the
// inertial ones. (Other held directions are eliminated, system/node_kinematics.hpp.)
//
// The axes q_x, q_y, q_z are fixed in space. The node was drawn at x_0, and its axes b_k coincided with q_k.
//   displacement k          q_k . (x - x_0) = 0
//   two rotations, i and j  q_i . b_k = 0 and q_j . b_k = 0: the third axis keeps its direction
//   one rotation            the rotation from where the node was drawn has the Bryant angles a, b, c about q_x, the new
//                           y and the newest z, Rx(a) Ry(b) Rz(c). The held angle stays zero, the two others are free
//                           over any number of turns:
//                             rx:  a = 0,  -q_y . b_z = 0        ry:  b = 0,  q_x . b_z = 0
//                             rz:  c = 0,  -q_x . b_y = 0
//                           A direction on the node stays normal to one in space, as in a universal joint. The row has
//                           a gradient of length one everywhere: their common normal. At small rotations the order of
//                           the angles does not matter, and the gradient is the held axis.
// The multipliers are forces along q_k [N] and torques about the gradients [N m].
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mechanism/model/assembly_branch.hpp"
#include "mechanism/model/model.hpp"

namespace bielle::mechanism {

class HeldDirections final : public Component, public AssemblyBranch {
 public:
  /// @param node    node at its initial place, with its index in the model
  /// @param axes    columns q_k, inertial components
  /// @param held    flags of x y z rx ry rz that are held by constraints; one or two of the rotations
  HeldDirections(const Node& node, int index, const Matrix3& axes, std::array<bool, 6> held);
  int node() const { return node_; }
  bool holds_translations() const { return held_[0] || held_[1] || held_[2]; }

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                            Eigen::Ref<VectorX> acceleration) const override;
  std::string wrong_branch(const LocalState& state) const override;
  void describe(const LocalState& state, Description& description) const override;
  void draw(Drawing& drawing) const override;

 private:
  /// A row that is the product of a direction in space, multiplied by the sign of the row, and a direction on the node,
  /// in the node's axes.
  struct Alignment {
    std::string name;
    Vector3 in_space, on_node;
  };
  struct Row {
    double value;
    Vector3 gradient;  ///< along dTheta of the node
    Matrix3 second;    ///< its derivative
  };
  static Row row(const Alignment& alignment, const LocalState& state);
  void add_alignment(int held, int in_space, int on_node, double sign, const Node& node);

  int node_;
  Vector3 drawn_;
  Matrix3 axes_;
  std::array<bool, 6> held_;
  std::vector<int> displacements_;
  std::vector<Alignment> alignments_;
  int kept_ = -1;  ///< axis that keeps its direction, if two rotations are held
};

}  // namespace bielle::mechanism

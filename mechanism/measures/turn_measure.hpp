// The turn of a node about an axis, counted over any number of turns: "pinion.turn.z".
//
// The rotation C by which a node has turned from where it was drawn, relative to another node, is a turn by phi about
// the axis e followed by a tilt of e about a line normal to it (swing and twist). With y and z normal to e,
//     phi = atan2(C_zy - C_yz, C_yy + C_zz) = 2 atan2(q . e, q_0)      of the quaternion (q_0, q) of C.
// - It is the angle of a hinge if the node turns about e alone.
// - It depends on e alone, and e may be taken as fixed on either node: a tilt leaves the components of C about e.
// - Spin and precession of a tilted top add up: Rz(a) Rx(b) Rz(c) has the turn a + c about z at any tilt |b| < pi.
// - It is not defined at a tilt of half a turn, where q_0 = q . e = 0.
// Reference: P. Dobrowolski, Swing-twist decomposition in Clifford algebra, arXiv:1506.05481 (2015).
//
// Memory: [phi, its rate | time] of the last accepted step, as joints count their angles (turns.hpp).
#pragma once

#include "mechanism/measures/coordinate.hpp"
#include "mechanism/measures/node_measures.hpp"

namespace bielle::mechanism {

class TurnMeasure final : public Measure {
 public:
  /// @param A,B   the same axes, as drawn, in the components of the first and of the second node; the first one is e
  /// @param rate  whether the measure is the rate of the turn [rad/s]
  TurnMeasure(std::string name, const NodePair& pair, const Matrix3& A, const Matrix3& B, bool rate)
      : Measure(std::move(name)), pair_(pair), A_(A), B_(B), rate_(rate) {}
  std::string units() const override { return rate_ ? "rad/s" : "rad"; }
  /// @throws ComputationError if the node is tilted by half a turn
  double value(const LocalState& state) const override;
  double calc(const LocalState& state, MeasureGradient& gradient) const override;
  void accept(const LocalState& state, Eigen::Ref<VectorX> memory) const override;
  void describe(const LocalState& state, Description& description) const override;

 private:
  void declare_subjects(Declaration& declaration) const override;
  /// Returns phi in (-pi, pi] with its rate.
  CoordinateRate principal(const LocalState& state) const;
  double counted(const CoordinateRate& principal, const LocalState& state) const;
  void check_tilt(double sine, double cosine) const;

  NodePair pair_;
  Matrix3 A_, B_;
  bool rate_;
};

}  // namespace bielle::mechanism

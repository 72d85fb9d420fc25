// A node that slides along a deforming beam.
//
// The beam's line is a curve through its nodes with continuous tangent: on element e between nodes k = e, e+1, with the
// initial arc length u from the beam's start, xi = (u - s_e)/L_e,
//     p(u) = sum_k N_k x_k + M_k t_k,   N = {1 - 3 xi^2 + 2 xi^3, 3 xi^2 - 2 xi^3},
//                                       M = L_e {xi - 2 xi^2 + xi^3, xi^3 - xi^2},
// with the unit tangent t_k that is fixed on node k. u is an unknown of the joint, without mass. The rows are, in the
// axes of J_A, which is fixed on the beam's first node:
//     x y z     d - p(u) = 0, d to the slider's attachment point: the equation of u makes the force normal to the beam,
//               except for friction, which acts on u (by initial lengths)
//     ry rz     with `orientation: tangent`: y_B . p' = z_B . p' = 0, x_B initially along the beam; turning about it is
//     free
// The force acts on the two nodes of the element as N_k f and moments M_k t_k x f: it is continuous between elements.
// Local nodes: the beam's first, the slider, the beam's others.
// Reference: the sliding joint of A. Cardona's thesis is the rigid-beam case; curves by Hermite's interpolation of node
// frames are exact to the fourth order of the element's length.
#pragma once

#include <array>

#include "mechanism/joints/joint.hpp"

namespace bielle::mechanism {

/// The initial line of a beam.
struct SliderLine {
  std::vector<int> nodes;        ///< node indices in the model, at least two
  std::vector<Vector3> tangent;  ///< unit vectors, in the axes of each node
  std::vector<double> place;     ///< arc length from the start to each node [m]
};

class SliderJoint final : public Joint {
 public:
  enum class Ends { error, stop };
  /// @param frames  J_A on the line's first node, J_B on the slider with x_B along the line   @param start  initial u
  ///                [m]
  SliderJoint(std::string name, JointFrames frames, SliderLine line, double start, bool tangent, Ends ends,
              const Model& model);

  Vector6 calc_press(const LocalState& state) const override;
  Vector6 calc_press(const LocalState& state, MatrixX& derivatives) const override;
  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                            Eigen::Ref<VectorX> acceleration) const override;
  double turning_rate(const LocalState& state) const override;
  void calc_coordinate(std::size_t index, const LocalState& state, CoordinateDerivatives& jet) const override;
  void calc_slopes(std::size_t index, const LocalState& state, CoordinateSlopes& slopes) const override;
  void accept(const LocalState& state, Eigen::Ref<VectorX> memory) const override;
  void calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const override;
  void describe(const LocalState& state, Description& description) const override;
  void draw(Drawing& drawing) const override;

 private:
  /// A row along the increments of all local nodes and u.
  struct Row {
    double value = 0;
    VectorX gradient;
    MatrixX second;
  };
  CoordinateRate principal_coordinate(std::size_t index, const LocalState& state) const override;
  int rows() const { return tangent_ ? 5 : 3; }
  int parameter() const { return 6 * static_cast<int>(line_.nodes.size() + 1); }  ///< local row of u
  /// Returns the local number of the k-th node of the line.
  static int local(std::size_t k) { return k == 0 ? 0 : static_cast<int>(k) + 1; }
  void calc_row(int row, const LocalState& state, Row& result) const;
  void calc_position_row(int axis, const LocalState& state, Row& result) const;
  void calc_tangent_row(int axis, const LocalState& state, Row& result) const;
  std::size_t element_at(double u) const;
  SliderLine line_;
  double start_;
  bool tangent_;
  Ends ends_;
};

const KeyTable& slider_keys();
/// Reads `slider: {node, beam, at, start, ends: error | stop, orientation: free | tangent}`.
void read_slider(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism

// Force and moment per length along a beam: weight, wind, stream pressure, thrust.
//
// At z in [0, 1] of an element between nodes A and B (section axes S_k = R_k R_Sk, psi = log(S_A^T S_B), length L of
// the reference) the load acts on the line and on the section
//     x(z) = (1-z) x_A + z x_B + z (1-z) L (S_A e_x - S_B e_x)/2,     S(z) = S_A exp(z psi)
//     dx = sum_k (N_k dx_k - R_k a_k~ dTheta_k),    dTheta(z) = sum_k W_k R_Sk^T dTheta_k
//     W_B = z T(z psi) T^-1(psi),   W_A similarly with 1-z and -psi.
// The line is that of the element's inertia (beam_inertia.hpp): a force m g per length is the weight of the beam, up to
// rounding. With the force f, and the moment n about the line in section axes, per length,
//     dead (default)  F, M inertial:      f = F,       n = S^T M + c~ S^T F
//     follower        F, M section axes:  f = S F,     n = M + c~ F           (c: the point (0, y, z) of the section)
// the residual is  -L int [ N_k f ;  a_k~ R_k^T f + R_Sk W_k^T n ]_k dz,  by three Gauss points between the places at
// which the load jumps along the beam. A uniform force on a straight beam with the residual bending flexibility gives
// the exact linear displacements of the nodes; moments, varying and follower loads converge with the second power of L
// or better. Loads are multiplied by the environment's load factor; their power is counted as input. A dead force on
// the line has a potential (symmetric tangent except for the moments at nodes); follower loads in general have none.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mechanism/elements/beam/formula_vector.hpp"
#include "mechanism/math/se3.hpp"
#include "mechanism/model/component.hpp"
#include "mechanism/model/time_dependent.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// A load per length as functions of s (0 at the start of the beam, 1 at its end) and t [s].
struct LineLoad {
  FormulaVector force, moment;  ///< [N/m], [N m/m]; inertial, or along the section's axes if follower
  bool has_force = false, has_moment = false;
  Vector3 at = Vector3::Zero();  ///< (0, y, z): point of application in the section [m], from the node line
  bool follower = false;
};

const KeyTable& line_load_keys();
/// Reads `{force, moment, at: [y, z], follower}`, or a list of such loads.
/// @param elements  number of elements of the beam: three points on each, and between its kinks, must integrate the
/// load to 1 % @throws InputError
std::vector<LineLoad> read_line_loads(const YamlValue& value, int elements);

/// One element of a beam: its nodes and position.
struct BeamSpan {
  int node_a = 0, node_b = 0;
  Matrix3 R_A = Matrix3::Identity(), R_B = Matrix3::Identity();  ///< section frames in the axes of the nodes
  Vector3 chord = Vector3::UnitX();                              ///< its length [m] along x of the section axes
  double s_A = 0, s_B = 1;                                       ///< its ends along the beam, 0 .. 1
};

/// One line load on one element. See the head of this file.
class DistributedLoad : public Component, public TimeDependent {
 public:
  /// @param name  name of the beam
  DistributedLoad(std::string name, const BeamSpan& span, LineLoad load);

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  void add_break_points(std::vector<double>& times) const override;
  /// The values are those in the middle of the element.
  std::vector<Formula> time_formulas() const override;
  void calc_time_formulas(const LocalState& state, std::span<double> values) const override;
  void describe(const LocalState& state, Description& description) const override;
  /// Outputs the resultant of all loads per length on the beam, inertial components: `distributed_force` (3) [N], and
  /// `distributed_moment` (3) [N m] about the inertial origin.
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;

 private:
  struct Point {
    double w, z;               ///< fraction of the length [m], position in the element
    std::array<double, 2> N;   ///< shape functions
    std::array<Vector3, 2> a;  ///< [m], node axes
  };
  struct Section;
  Section section(const LocalState& state, const Point& point) const;

  BeamSpan span_;
  LineLoad load_;
  std::vector<Point> points_;
};

}  // namespace bielle::mechanism

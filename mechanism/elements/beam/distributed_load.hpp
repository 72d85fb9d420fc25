// Force and moment per length along a beam: weight, wind, stream pressure, thrust.
//
// The load acts on the line of an element (span_load.hpp), which is that of its inertia: a force m g per length is the
// weight of the beam, up to rounding. The force f, and the moment n about the line in section axes, per length, are
//     dead (default)  F, M inertial:      f = F,       n = S^T M + c~ S^T F
//     follower        F, M section axes:  f = S F,     n = M + c~ F           (c: the point (0, y, z) of the section)
// They are integrated by three Gauss points between the places at which the load jumps along the beam. A uniform force
// on a straight beam with the residual bending flexibility gives the exact linear displacements of the nodes; moments,
// varying and follower loads converge with the second power of L or better. Loads are multiplied by the environment's
// load factor; their power is counted as input. A dead force on the line has a potential (symmetric tangent except for
// the moments at nodes); follower loads in general have none.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mechanism/elements/beam/formula_vector.hpp"
#include "mechanism/elements/beam/span_load.hpp"
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

/// One line load on one element. See the head of this file.
class DistributedLoad final : public SpanLoad {
 public:
  /// @param name  name of the beam
  DistributedLoad(std::string name, const BeamSpan& span, LineLoad load);

  void declare(Declaration& declaration) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_break_points(std::vector<double>& times) const override;
  /// The values are those in the middle of the element.
  std::vector<Formula> time_formulas() const override;
  void calc_time_formulas(const LocalState& state, std::span<double> values) const override;
  void describe(const LocalState& state, Description& description) const override;
  /// Outputs the resultant of all loads per length on the beam, inertial components: `distributed_force` (3) [N], and
  /// `distributed_moment` (3) [N m] about the inertial origin.
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;

 protected:
  SpanForce load(const LocalState& state, const SpanPoint& point, const SpanSection& at) const override;

 private:
  struct Given {
    Vector3 F, M;  ///< multiplied by the load factor
  };
  Given given(const LocalState& state, const SpanPoint& point) const;
  SpanForce on_line(const Given& given, const SpanSection& at) const;

  LineLoad load_;
};

}  // namespace bielle::mechanism

// Force and moment per length along a beam: weight, wind, stream pressure, thrust, drag.
//
// The load acts on the line of an element (span_load.hpp), which is that of its inertia: a force m g per length is the
// weight of the beam, up to rounding. The force f, and the moment n about the line in section axes, per length, are
//     dead (default)  F, M inertial:      f = F,       n = S^T M + c~ S^T F
//     follower        F, M section axes:  f = S F,     n = M + c~ F           (c: the point (0, y, z) of the section)
// F and M are formulas of the place s, the time, the motion of the line and of the section there (span_motion.hpp) and
// measures of the state. They are integrated by three Gauss points between the places at which the load jumps along the
// beam. A uniform force on a straight beam with the residual bending flexibility gives the exact linear displacements
// of the nodes; moments, varying and follower loads converge with the second power of L or better. Loads are multiplied
// by the environment's load factor; their power is counted as input. A dead force on the line has a potential
// (symmetric tangent except for the moments at nodes); follower loads in general have none.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "mechanism/elements/beam/span_load.hpp"
#include "mechanism/elements/beam/span_motion.hpp"
#include "mechanism/measures/state_formula.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/references.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// A load per length.
struct LineLoad {
  /// Components of the force [N/m], then of the moment [N m/m], of `span_variables` and measures: inertial, or along
  /// the section's axes if follower.
  std::array<StateFormula, 6> components;
  References references;  ///< the measures of the formulas
  bool has_force = false, has_moment = false;
  Vector3 at = Vector3::Zero();  ///< (0, y, z): point of application in the section [m], from the node line
  bool follower = false;
};

const KeyTable& line_load_keys();

/// One line load on one element. See the head of this file.
class DistributedLoad final : public SpanLoad {
 public:
  /// @param name  name of the beam
  DistributedLoad(std::string name, const BeamSpan& span);
  /// Sets the load when the formulas of the model are read.
  void set(LineLoad load);

  void declare(Declaration& declaration) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_break_points(std::vector<double>& times) const override;
  /// The formulas of time are evaluated in the middle of the element.
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
  Given given(const LocalState& state, const SpanValues& variables) const;
  SpanForce on_line(const Given& given, const SpanSection& at) const;
  void add_formula_tangent(const SpanPoint& point, const SpanSection& at, const SpanValues& variables,
                           const LocalState& state, LocalTangent& tangent) const;
  std::string text(std::size_t first) const;

  LineLoad load_;
  SpanPoint middle_;  ///< point in the middle of the element
};

/// Reads `{force, moment, at: [y, z], follower}`, or a list of such loads, and adds one component for each load to each
/// element; the formulas are read after the model.
/// @param spans  elements of the beam, in order: three points on each, and between its kinks, must integrate a load
/// that depends on s and t alone to 1 %
/// @throws InputError
void add_line_loads(const std::string& beam, const YamlValue& value, const std::vector<BeamSpan>& spans,
                    const Entry& own, Model& model);

}  // namespace bielle::mechanism

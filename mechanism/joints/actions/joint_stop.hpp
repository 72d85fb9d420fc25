// Stops at the ends of a coordinate's range (laws/stop_law.hpp).
#pragma once

#include "mechanism/joints/actions/coordinate_action.hpp"
#include "mechanism/laws/stop_law.hpp"

namespace bielle::mechanism {

class JointStop final : public CoordinateAction {
 public:
  JointStop(std::string name, const Joint& joint, std::size_t coordinate, const StopLaw& law)
      : CoordinateAction("stops", std::move(name), joint, coordinate), law_(law) {}

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  void describe(const LocalState& state, Description& description) const override;
  void calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const override;
  void begin_branch(const LocalState& state, std::span<const int> crossed, Eigen::Ref<VectorX> memory) const override;
  bool leaves_branch(const LocalState& state) const override;
  /// Returns the names of the distance to the nearer stop, negative beyond it, and of the force on the coordinate:
  /// "angle.stop_gap", "angle.stop_force".
  std::vector<std::string> measure_names() const override;
  std::unique_ptr<Measure> make_measure(const std::string& name, const std::string& measure) const override;
  /// Computes the distance or the force, with its derivatives over the local layout.
  double calc_gap(const LocalState& state, MeasureGradient& gradient) const;
  double calc_force(const LocalState& state, MeasureGradient& gradient) const;

 private:
  StopLaw::Contact contact(const LocalState& state, double q, double v) const;
  StopLaw law_;
};

}  // namespace bielle::mechanism

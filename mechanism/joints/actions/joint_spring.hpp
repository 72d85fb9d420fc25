// Spring, damper and preload in a joint, on one of its coordinates q: resisting force N(q - rest, qdot, t, measures).
//
// For a displacement or angle the force acts along the coordinate. For a component of a rotation vector the elastic
// part is the gradient of its potential, along g, and the rest is a moment about the joint's axis, along w
// (measures/coordinate.hpp): the energies are exact in both cases.
#pragma once

#include "mechanism/joints/actions/coordinate_action.hpp"
#include "mechanism/laws/force_law.hpp"
#include "mechanism/model/time_dependent.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

class JointSpring final : public CoordinateAction, public TimeDependent {
 public:
  /// @param rest  value of the coordinate at which the spring is unloaded [m] or [rad]
  JointSpring(std::string name, const Joint& joint, std::size_t coordinate, double rest, double preload)
      : CoordinateAction("spring", std::move(name), joint, coordinate), rest_(rest), law_(0, 0, preload) {}
  /// Adds the term of a key `stiffness` or `damping`, after the model has been read.
  void read(const YamlValue& value, bool damping, Model& model);

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  std::vector<Formula> time_formulas() const override;
  void calc_time_formulas(const LocalState& state, std::span<double> values) const override;
  void describe(const LocalState& state, Description& description) const override;
  void add_break_points(std::vector<double>& times) const override { law_.add_break_points(times); }

 private:
  bool splits() const { return coordinate().kind == JointCoordinate::Kind::rotation; }
  double rest_;
  ForceLaw law_;
};

}  // namespace bielle::mechanism

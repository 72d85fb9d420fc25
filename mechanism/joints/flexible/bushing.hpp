// A block of rubber, a flexible coupling, or a mount between two nodes: six stiffnesses with full coupling, damping,
// curves, coefficients over a speed, and hysteresis, without a constraint.
//
// Its measures x, y, z, rx, ry, rz are those of the frame halfway between the two nodes (measures/middle_frame.hpp):
// displacement of the second attachment point along its axes, and the rotation vector of the second frame relative to
// the first. Forces follow the law of laws/elastic_law.hpp in these measures. Therefore
// - a rigid motion of both nodes has no effect, for any rotation;
// - exchanging the nodes only changes the signs;
// - the elastic force has a potential, and its tangent is symmetric in equilibrium, at any relative rotation below half
//   a turn. The moment about the axes of the frame is T^-T(psi) of that along psi: the two agree for small rotations.
#pragma once

#include "mechanism/joints/flexible/elastic_pair.hpp"
#include "mechanism/measures/time_formula.hpp"
#include "mechanism/model/references.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

class Bushing final : public ElasticPair, public TimeDependent {
 public:
  Bushing(std::string name, JointFrames frames, const Model& model);
  /// Reads the speed of the film, after the model has been read. @throws InputError if it depends on the bushing
  void read_film_speed(const YamlValue& formula, Model& model);
  void declare(Declaration& declaration) const override;
  void add_break_points(std::vector<double>& times) const override;
  std::vector<Formula> time_formulas() const override;
  void calc_time_formulas(const LocalState& state, std::span<double> values) const override {
    calc_time_formula(law().film->speed, state, values);
  }
  /// Checks the rotation vector and stores it. @throws ComputationError for nearly half a turn or more
  void accept(const LocalState& state, Eigen::Ref<VectorX> memory) const override;

 private:
  void calc_measures(const LocalState& state, ElasticLaw::Measures& measures, bool second) const override;
  References references_;  ///< measures of the film's speed
};

const KeyTable& bushing_keys();
/// Reads `{type: bushing, nodes, position | at, axis, second_axis, stiffness, damping, preload, curves, film,
/// maxwell}`.
void read_bushing(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism

// Joints without constraints: an elastic law (laws/elastic_law.hpp) connects their two nodes.
//
// A type computes its measures, up to six, as numbers with derivatives. The resisting forces of the law act along their
// gradients, so that the elastic forces have a potential and an exact tangent.
#pragma once

#include "mechanism/joints/joint.hpp"
#include "mechanism/laws/elastic_law.hpp"

namespace bielle::mechanism {

class ElasticPair : public Joint {
 public:
  ElasticPair(std::string type, std::string name, JointFrames frames, std::vector<JointCoordinate> coordinates,
              ElasticLaw law, const Model& model);
  ElasticLaw& law() { return law_; }
  const ElasticLaw& law() const { return law_; }

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  /// Output `force`: forces of the law along the measures.
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  void describe(const LocalState& state, Description& description) const override;
  /// The names are "force.x" and so on, forces of the law, besides the measures of all joints.
  std::vector<std::string> measure_names() const override;
  std::unique_ptr<Measure> make_measure(const std::string& name, const std::string& measure) const override;
  /// Computes the force of the joint along a measure, as recorded, with its derivatives over the local layout.
  double calc_force(const LocalState& state, std::size_t k, MeasureGradient& gradient) const;
  bool reaction_has_rates() const override { return law_.has_damping(); }

 protected:
  /// @param second  whether second derivatives are required
  virtual void calc_measures(const LocalState& state, ElasticLaw::Measures& measures, bool second) const = 0;
  /// Returns a coordinate that is one of the measures.
  PairMeasure calc_own_coordinate(std::size_t index, const LocalState& state) const override;

 private:
  ElasticLaw law_;
};

}  // namespace bielle::mechanism

// Joints that constrain nothing: an elastic law (measures/elastic_law.hpp) holds their two nodes together.
//
// A type computes its measures, up to six, as numbers with derivatives. What the law resists with acts along their
// gradients: forces with a potential, and their exact tangent.
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
  /// `force`: what the law exerts along the measures.
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  void describe(const LocalState& state, Description& description) const override;
  bool reaction_has_rates() const override { return law_.has_damping(); }

 protected:
  /// @param second  whether second derivatives are wanted
  virtual void calc_measures(const LocalState& state, ElasticLaw::Measures& measures, bool second) const = 0;
  /// A coordinate that is one of the measures.
  PairMeasure calc_own_coordinate(std::size_t index, const LocalState& state) const override;

 private:
  ElasticLaw law_;
};

}  // namespace bielle::mechanism

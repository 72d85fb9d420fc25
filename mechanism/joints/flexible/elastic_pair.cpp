#include "mechanism/joints/flexible/elastic_pair.hpp"

#include "mechanism/model/description.hpp"

namespace bielle::mechanism {

ElasticPair::ElasticPair(std::string type, std::string name, JointFrames frames,
                         std::vector<JointCoordinate> coordinates, ElasticLaw law, const Model& model)
    : Joint(std::move(type), std::move(name), std::move(frames), std::move(coordinates), model), law_(std::move(law)) {}

void ElasticPair::declare(Declaration& declaration) const {
  Joint::declare(declaration);
  law_.declare(declaration);
}

void ElasticPair::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  ElasticLaw::Measures measures;
  calc_measures(state, measures, false);
  law_.add_residual(state, measures, r);
}

void ElasticPair::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  ElasticLaw::Measures measures;
  calc_measures(state, measures, true);
  law_.add_tangent(state, measures, tangent);
}

void ElasticPair::add_energy(const LocalState& state, Energy& energy) const {
  ElasticLaw::Measures measures;
  calc_measures(state, measures, false);
  law_.add_energy(state, measures, energy);
}

PairMeasure ElasticPair::calc_own_coordinate(std::size_t index, const LocalState& state) const {
  ElasticLaw::Measures measures;
  calc_measures(state, measures, true);
  return measures[index];
}

std::vector<OutputField> ElasticPair::output_fields() const {
  std::vector<OutputField> fields = Joint::output_fields();
  std::string names, units;
  for (std::size_t k = 0; k < law_.size(); ++k) {
    names += (k > 0 ? ", " : "") + law_.measure_name(k);
    units += std::string(k > 0 ? ", " : "") + (law_.is_turn(k) ? "N m" : "N");
  }
  fields.push_back({"force", {law_.size()}, units, "what the joint exerts along " + names});
  return fields;
}

void ElasticPair::write_output(const LocalState& state, double* values) const {
  Joint::write_output(state, values);
  ElasticLaw::Measures measures;
  calc_measures(state, measures, false);
  const Vector6 N = law_.force(state, measures);
  double* force = values + 2 * coordinates().size() + 12;
  for (std::size_t k = 0; k < law_.size(); ++k) force[k] = -N[static_cast<Eigen::Index>(k)];
}

void ElasticPair::describe(const LocalState& state, Description& description) const {
  Joint::describe(state, description);
  for (const std::string& fact : law_.describe()) description.add_line(fact);
}

}  // namespace bielle::mechanism

#include "mechanism/joints/flexible/elastic_pair.hpp"

#include "mechanism/measures/own_measure.hpp"
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

double ElasticPair::calc_force(const LocalState& state, std::size_t k, MeasureGradient& gradient) const {
  ElasticLaw::Measures measures;
  calc_measures(state, measures, true);
  const ElasticLaw::Slopes slopes = law_.slopes(state, measures);
  const auto i = static_cast<Eigen::Index>(k);
  gradient.position().head<12>() = -slopes.by_position.row(i).transpose();
  gradient.position().segment(state.slots().first_order_row(), slopes.by_unknown.cols()) =
      -slopes.by_unknown.row(i).transpose();
  gradient.rate().head<12>() = -slopes.by_rate.row(i).transpose();
  law_.add_by_speed(state, -slopes.by_speed[i], gradient);
  return -slopes.N[i];
}

namespace {

/// "mount.force.x"
class ElasticForceMeasure final : public OwnMeasure {
 public:
  ElasticForceMeasure(std::string name, const ElasticPair& pair, std::size_t k)
      : OwnMeasure(std::move(name), pair), pair_(pair), k_(k) {}
  std::string units() const override { return pair_.law().is_turn(k_) ? "N m" : "N"; }

 private:
  double calc_own(const LocalState& own, MeasureGradient& gradient) const override {
    return pair_.calc_force(own, k_, gradient);
  }
  const ElasticPair& pair_;
  std::size_t k_;
};

}  // namespace

std::vector<std::string> ElasticPair::measure_names() const {
  std::vector<std::string> names = Joint::measure_names();
  for (std::size_t k = 0; k < law_.size(); ++k) names.push_back("force." + law_.measure_name(k));
  return names;
}

std::unique_ptr<Measure> ElasticPair::make_measure(const std::string& name, const std::string& measure) const {
  for (std::size_t k = 0; k < law_.size(); ++k)
    if (measure == "force." + law_.measure_name(k)) return std::make_unique<ElasticForceMeasure>(name, *this, k);
  return Joint::make_measure(name, measure);
}

void ElasticPair::describe(const LocalState& state, Description& description) const {
  Joint::describe(state, description);
  for (const std::string& fact : law_.describe()) description.add_line(fact);
}

}  // namespace bielle::mechanism

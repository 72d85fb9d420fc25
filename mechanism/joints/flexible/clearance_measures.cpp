// Gap and normal force of joints with clearance, as measures.
#include <limits>

#include "mechanism/joints/flexible/clearance_joint.hpp"
#include "mechanism/measures/own_measure.hpp"

namespace bielle::mechanism {
namespace {

/// "pin.gap", "pin.normal_force"
class ClearanceMeasure final : public OwnMeasure {
 public:
  ClearanceMeasure(std::string name, const ClearanceJoint& joint, bool force)
      : OwnMeasure(std::move(name), joint), joint_(joint), force_(force) {}
  std::string units() const override { return force_ ? "N" : "m"; }

 private:
  double calc_own(const LocalState& own, MeasureGradient& gradient) const override {
    return force_ ? joint_.calc_normal_force(own, gradient) : joint_.calc_gap(own, gradient);
  }
  const ClearanceJoint& joint_;
  bool force_;
};

}  // namespace

double ClearanceJoint::calc_gap(const LocalState& state, MeasureGradient& gradient) const {
  const PairRotation turned = rotation(state);
  double smallest = std::numeric_limits<double>::infinity();
  for (const Place& each : places_) {
    // The derivatives of a contact are only computed if the surfaces touch. Without a gap they always touch.
    ClearancePlace place = each.place;
    place.gap = 0;
    const ClearanceContact c(state.node(0), state.node(1), frames(), place, turned, false);
    const double gap = each.place.gap - c.p().value;
    if (!(gap < smallest)) continue;
    smallest = gap;
    gradient.position().head<12>() = -c.p().gradient;
  }
  return smallest;
}

double ClearanceJoint::calc_normal_force(const LocalState& state, MeasureGradient& gradient) const {
  const PairRotation turned = rotation(state);
  const Vector12 v = pair_rate(state.node(0), state.node(1));
  double sum = 0;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const ClearanceContact c = contact(k, state, turned, true);
    const NormalLaw::Force force = push(k, state, c);
    if (force.F == 0) continue;
    sum += force.F;
    gradient.position().head<12>() += force.by_p * c.p().gradient + force.by_rate * (c.p().second.transpose() * v);
    gradient.rate().head<12>() += force.by_rate * c.p().gradient;
  }
  return sum;
}

std::vector<std::string> ClearanceJoint::measure_names() const {
  std::vector<std::string> names = Joint::measure_names();
  names.insert(names.end(), {"gap", "normal_force"});
  return names;
}

std::unique_ptr<Measure> ClearanceJoint::make_measure(const std::string& name, const std::string& measure) const {
  if (measure == "gap") return std::make_unique<ClearanceMeasure>(name, *this, false);
  if (measure == "normal_force") return std::make_unique<ClearanceMeasure>(name, *this, true);
  return Joint::make_measure(name, measure);
}

}  // namespace bielle::mechanism

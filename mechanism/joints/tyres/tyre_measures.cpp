// Deflection and forces of tyres, as measures.
#include <array>

#include "mechanism/joints/tyres/tyre.hpp"
#include "mechanism/measures/own_measure.hpp"

namespace bielle::mechanism {
namespace {

struct TyreQuantityName {
  const char* name;
  const char* units;
  Tyre::Quantity quantity;
};

constexpr TyreQuantityName tyre_quantities[] = {{"deflection", "m", Tyre::Quantity::deflection},
                                                {"normal_force", "N", Tyre::Quantity::normal_force},
                                                {"longitudinal_force", "N", Tyre::Quantity::longitudinal_force},
                                                {"lateral_force", "N", Tyre::Quantity::lateral_force},
                                                {"aligning_moment", "N m", Tyre::Quantity::aligning_moment}};

/// "front.normal_force"
class TyreMeasure final : public OwnMeasure {
 public:
  TyreMeasure(std::string name, const Tyre& tyre, const TyreQuantityName& quantity)
      : OwnMeasure(std::move(name), tyre), tyre_(tyre), quantity_(quantity) {}
  std::string units() const override { return quantity_.units; }

 private:
  double calc_own(const LocalState& own, MeasureGradient& gradient) const override {
    return tyre_.calc_quantity(quantity_.quantity, own, gradient);
  }
  const Tyre& tyre_;
  const TyreQuantityName& quantity_;
};

TyreNumber TyreForces::*force_of(Tyre::Quantity quantity) {
  switch (quantity) {
    case Tyre::Quantity::longitudinal_force:
      return &TyreForces::F_x;
    case Tyre::Quantity::lateral_force:
      return &TyreForces::F_y;
    case Tyre::Quantity::aligning_moment:
      return &TyreForces::moment;
    default:
      return &TyreForces::N;
  }
}

}  // namespace

double Tyre::calc_quantity(Quantity quantity, const LocalState& state, MeasureGradient& gradient) const {
  if (quantity == Quantity::deflection) {
    const PairSlope e = deflection(state);
    gradient.position().head<12>() = e.gradient;
    return e.value;
  }
  if (!touches(state)) return 0;
  const Contact<2> contact = calc_contact<2>(state);
  const TyreNumber& force = contact.forces.*force_of(quantity);
  const auto size = gradient.position().size();
  gradient.position() = (force.gradient.transpose() * contact.by_position).transpose().head(size);
  gradient.rate() = (force.gradient.transpose() * contact.by_rate).transpose().head(size);
  return force.value;
}

std::vector<std::string> Tyre::measure_names() const {
  std::vector<std::string> names = Joint::measure_names();
  for (const TyreQuantityName& each : tyre_quantities) names.emplace_back(each.name);
  return names;
}

std::unique_ptr<Measure> Tyre::make_measure(const std::string& name, const std::string& measure) const {
  for (const TyreQuantityName& each : tyre_quantities)
    if (measure == each.name) return std::make_unique<TyreMeasure>(name, *this, each);
  return Joint::make_measure(name, measure);
}

}  // namespace bielle::mechanism

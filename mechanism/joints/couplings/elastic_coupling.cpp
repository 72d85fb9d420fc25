#include "mechanism/joints/couplings/elastic_coupling.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mechanism/measures/own_measure.hpp"
#include "mechanism/model/description.hpp"

namespace bielle::mechanism {
namespace {

thread_local CoordinateDerivatives term_jet;
thread_local CoordinateSlopes term_slopes;
thread_local VectorX sum_gradient, sum_rate_slope, joint_rates;

/// "pair.deformation", "pair.force"
class CouplingMeasure final : public OwnMeasure {
 public:
  CouplingMeasure(std::string name, const ElasticCoupling& coupling, bool force)
      : OwnMeasure(std::move(name), coupling), coupling_(coupling), force_(force) {}
  std::string units() const override {
    const JointCoordinate& unit = coupling_.unit_of_sum();
    return force_ ? unit.force_units() : unit.units();
  }

 private:
  double calc_own(const LocalState& own, MeasureGradient& gradient) const override {
    return coupling_.calc_measure(force_, own, gradient);
  }
  const ElasticCoupling& coupling_;
  bool force_;
};

}  // namespace

ElasticCoupling::ElasticCoupling(std::string type, std::string name, const Law& law)
    : CoordinateCoupling(std::move(type), std::move(name)),
      stops_{-0.5 * law.backlash, 0.5 * law.backlash, law.stiffness, law.damping} {}

void ElasticCoupling::declare(Declaration& declaration) const {
  references().declare(declaration);
  declaration.stiffness = true;
  declaration.damping = stops_.damping > 0;
  if (!plays()) return;
  declaration.kinks = true;  // the force has a kink at zero
  declaration.memory = {0};  // side of the contact
  stops_.declare_events("flanks touch, forwards", "flanks touch, backwards", declaration);
}

CoordinateRate ElasticCoupling::deformation(const LocalState& state) const {
  long double value = 0;  // long double, because angles of many turns cancel in the sum
  double rate = 0;
  for (const Term& term : terms()) {
    const CoordinateRate c = term.joint->coordinate(term.coordinate, state.of(term.reference));
    value += static_cast<long double>(term.factor) * c.value;
    rate += term.factor * c.rate;
  }
  return {static_cast<double>(value), rate};
}

CoordinateRate ElasticCoupling::calc_sum(const LocalState& state, VectorX& g, VectorX& h) const {
  g.setZero(state.slots().size());
  h.setZero(state.slots().size());
  long double value = 0;
  double rate = 0;
  for (const Term& term : terms()) {
    const LocalState of_joint = state.of(term.reference);
    term.joint->calc_coordinate(term.coordinate, of_joint, term_jet);
    const auto n = term_jet.g().size();
    joint_rates.resize(n);
    get_local_velocities(of_joint, joint_rates);
    const int at = state.slots().reference_row(term.reference);
    g.segment(at, n) += term.factor * term_jet.g();
    h.segment(at, n).noalias() += term.factor * (term_jet.W().transpose() * joint_rates);
    value += static_cast<long double>(term.factor) * term_jet.value;
    rate += term.factor * term_jet.rate;
  }
  return {static_cast<double>(value), rate};
}

StopLaw::Contact ElasticCoupling::contact(const LocalState& state, const CoordinateRate& e) const {
  return stops_.contact(state.environment().statics ? stops_.side_at_rest(e.value) : state.memory()[0], e.value,
                        e.rate);
}

ElasticCoupling::Force ElasticCoupling::force_of(const LocalState& state, const CoordinateRate& e) const {
  if (!plays()) return {stops_.stiffness * e.value + stops_.damping * e.rate, true};
  const StopLaw::Contact c = contact(state, e);
  return {c.N, c.pushes};
}

void ElasticCoupling::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  const double F = force(state);
  if (F == 0) return;
  for (const Term& term : terms()) {
    term.joint->calc_slopes(term.coordinate, state.of(term.reference), term_slopes);
    r.segment(state.slots().reference_row(term.reference), term_slopes.g().size()) +=
        (F * term.factor) * term_slopes.g();
  }
}

void ElasticCoupling::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (!tangent.wants_K && !tangent.wants_C) return;
  VectorX &g = sum_gradient, &h = sum_rate_slope;
  const Force force = force_of(state, calc_sum(state, g, h));
  if (!force.acts) return;
  if (tangent.wants_C && stops_.damping > 0) tangent.C.dense().noalias() += stops_.damping * g * g.transpose();
  if (!tangent.wants_K) return;
  auto K = tangent.K.dense();
  K.noalias() += stops_.stiffness * g * g.transpose();
  if (stops_.damping > 0) K.noalias() += stops_.damping * g * h.transpose();
  for (const Term& term : terms()) {
    term.joint->calc_coordinate(term.coordinate, state.of(term.reference), term_jet);
    const int at = state.slots().reference_row(term.reference);
    const auto n = term_jet.g().size();
    K.block(at, at, n, n) += (force.F * term.factor) * term_jet.S();
  }
}

void ElasticCoupling::add_energy(const LocalState& state, Energy& energy) const {
  const CoordinateRate e = deformation(state);
  if (plays()) return stops_.add_energy(contact(state, e), e.rate, energy);
  energy.elastic += 0.5 * stops_.stiffness * e.value * e.value;
  energy.dissipation += stops_.damping * e.rate * e.rate;
}

void ElasticCoupling::calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const {
  if (plays()) stops_.calc_event_functions(deformation(state).value, values);
}

void ElasticCoupling::begin_branch(const LocalState& state, std::span<const int> /*crossed*/,
                                   Eigen::Ref<VectorX> memory) const {
  if (!plays()) return;
  const CoordinateRate e = deformation(state);
  memory[0] = stops_.side_after(e.value, e.rate);
}

bool ElasticCoupling::leaves_branch(const LocalState& state) const {
  return plays() && contact(state, deformation(state)).penetration < 0;
}

std::vector<OutputField> ElasticCoupling::output_fields() const {
  std::vector<OutputField> fields = CoordinateCoupling::output_fields();
  fields.push_back({"deformation", {}, unit().units(), "sum of factor times coordinate, from the middle of the play"});
  return fields;
}

void ElasticCoupling::write_output(const LocalState& state, double* values) const {
  CoordinateCoupling::write_output(state, values);
  values[terms().size()] = deformation(state).value;
}

void ElasticCoupling::describe(const LocalState& /*state*/, Description& description) const {
  const char *units = unit().units(), *force = unit().force_units();
  std::string text = fmt::format("{}, stiffness {:.6g} {}/{}", sum_text(), stops_.stiffness, force, units);
  if (stops_.damping > 0) text += fmt::format(", damping {:.6g} {} s/{}", stops_.damping, force, units);
  if (plays()) text += fmt::format(", backlash {:.6g} {}", 2 * stops_.upper, units);
  description.add(text);
}

std::string ElasticCoupling::what_is_open(const LocalState& state) const {
  const double gap = stops_.upper - std::abs(deformation(state).value);
  if (!plays() || gap < 0) return {};
  return fmt::format("is within its backlash, {:.3g} {} from its nearer flank", gap, unit().units());
}

double ElasticCoupling::calc_measure(bool force, const LocalState& state, MeasureGradient& gradient) const {
  VectorX &g = sum_gradient, &h = sum_rate_slope;
  const CoordinateRate e = calc_sum(state, g, h);
  if (!force) {
    gradient.position() = g;
    return e.value;
  }
  const Force of_state = force_of(state, e);
  if (of_state.acts) {
    gradient.position() = stops_.stiffness * g + stops_.damping * h;
    gradient.rate() = stops_.damping * g;
  }
  return of_state.F;
}

std::unique_ptr<Measure> ElasticCoupling::make_measure(const std::string& name, const std::string& measure) const {
  return std::make_unique<CouplingMeasure>(name, *this, measure == "force");
}

}  // namespace bielle::mechanism

#include "mechanism/joints/actions/joint_stop.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mechanism/measures/own_measure.hpp"
#include "mechanism/model/description.hpp"

namespace bielle::mechanism {

void JointStop::declare(Declaration& declaration) const {
  declare_references(declaration);
  declaration.damping = range_.damping > 0;
  declaration.kinks = true;  // at zero total force
  declaration.memory = {0};  // side of the contact
  if (std::isfinite(range_.upper)) declaration.event_functions.push_back({coordinate().name + " at its upper stop"});
  if (std::isfinite(range_.lower)) declaration.event_functions.push_back({coordinate().name + " at its lower stop"});
}

JointStop::Contact JointStop::contact(const LocalState& state, double q, double v) const {
  Contact contact;
  if (state.environment().statics)
    contact.side = q > range_.upper ? 1 : q < range_.lower ? -1 : 0;
  else
    contact.side = state.memory()[0];
  if (contact.side == 0) return contact;
  contact.penetration = contact.side > 0 ? q - range_.upper : range_.lower - q;
  const double push = range_.stiffness * contact.penetration + range_.damping * contact.side * v;
  contact.pushes = push > 0;
  contact.N = contact.side * std::max(0.0, push);
  return contact;
}

void JointStop::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  CoordinateDerivatives& jet = calc(state);
  if (const Contact c = contact(state, jet.value, jet.rate); c.pushes)
    r.segment(row(state), jet.w().size()) += c.N * jet.w();
}

void JointStop::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  CoordinateDerivatives& jet = calc(state);
  const Contact c = contact(state, jet.value, jet.rate);
  if (!c.pushes) return;
  const int at = row(state);
  const auto n = jet.w().size();
  if (tangent.wants_K) {
    auto K = tangent.K.dense().block(at, at, n, n);
    K += c.N * jet.W() + range_.stiffness * jet.w() * jet.g().transpose();
    if (range_.damping > 0) K += range_.damping * jet.w() * rate_slope(state, jet).transpose();
  }
  if (tangent.wants_C) tangent.C.dense().block(at, at, n, n) += range_.damping * jet.w() * jet.w().transpose();
}

void JointStop::add_energy(const LocalState& state, Energy& energy) const {
  const auto [q, v] = value(state);
  const Contact c = contact(state, q, v);
  if (c.side == 0) return;
  // The energy of a spring that the damper keeps from pushing is dissipated by the damper.
  energy.elastic += 0.5 * range_.stiffness * c.penetration * c.penetration;
  energy.dissipation += (c.N - c.side * range_.stiffness * c.penetration) * v;
}

void JointStop::describe(const LocalState& /*state*/, Description& description) const {
  const char *units = coordinate().units(), *force = coordinate().force_units();
  std::string text;
  if (std::isfinite(range_.lower)) text += fmt::format(" lower end {:.6g} {},", range_.lower, units);
  if (std::isfinite(range_.upper)) text += fmt::format(" upper end {:.6g} {},", range_.upper, units);
  text += fmt::format(" stiffness {:.6g} {}/{}", range_.stiffness, force, units);
  if (range_.damping > 0) text += fmt::format(", damping {:.6g} {} s/{}", range_.damping, force, units);
  description.add_line(fmt::format("stops on {}:{}", coordinate().name, text));
}

std::vector<OutputField> JointStop::output_fields() const {
  return {force_field("stop_force", "force or torque of the stops along the joint's coordinates")};
}

void JointStop::write_output(const LocalState& state, double* values) const {
  const auto [q, v] = value(state);
  write_force(-contact(state, q, v).N, values);
}

double JointStop::calc_gap(const LocalState& state, MeasureGradient& gradient) const {
  CoordinateDerivatives& jet = calc(state);
  const bool at_upper = range_.upper - jet.value < jet.value - range_.lower;
  gradient.position().segment(row(state), jet.g().size()) = (at_upper ? -1 : 1) * jet.g();
  return at_upper ? range_.upper - jet.value : jet.value - range_.lower;
}

double JointStop::calc_force(const LocalState& state, MeasureGradient& gradient) const {
  CoordinateDerivatives& jet = calc(state);
  const Contact c = contact(state, jet.value, jet.rate);
  if (!c.pushes) return 0;
  const int at = row(state);
  const auto n = jet.g().size();
  gradient.position().segment(at, n) = -range_.stiffness * jet.g();
  if (range_.damping > 0) {
    gradient.position().segment(at, n) -= range_.damping * rate_slope(state, jet);
    gradient.rate().segment(at, n) = -range_.damping * jet.w();
  }
  return -c.N;
}

namespace {

/// "main.angle.stop_gap", "main.angle.stop_force"
class StopMeasure final : public OwnMeasure {
 public:
  StopMeasure(std::string name, const JointStop& stop, bool force)
      : OwnMeasure(std::move(name), stop), stop_(stop), force_(force) {}
  std::string units() const override { return force_ ? stop_.coordinate().force_units() : stop_.coordinate().units(); }

 private:
  double calc_own(const LocalState& own, MeasureGradient& gradient) const override {
    return force_ ? stop_.calc_force(own, gradient) : stop_.calc_gap(own, gradient);
  }
  const JointStop& stop_;
  bool force_;
};

}  // namespace

std::vector<std::string> JointStop::measure_names() const {
  return {coordinate().name + ".stop_gap", coordinate().name + ".stop_force"};
}

std::unique_ptr<Measure> JointStop::make_measure(const std::string& name, const std::string& measure) const {
  return std::make_unique<StopMeasure>(name, *this, measure.ends_with("force"));
}

void JointStop::calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const {
  const double q = value(state).value;
  Eigen::Index k = 0;
  if (std::isfinite(range_.upper)) values[k++] = q - range_.upper;
  if (std::isfinite(range_.lower)) values[k] = range_.lower - q;
}

bool JointStop::leaves_branch(const LocalState& state) const {
  const auto [q, v] = value(state);
  return contact(state, q, v).penetration < 0;
}

void JointStop::begin_branch(const LocalState& state, std::span<const int> /*crossed*/,
                             Eigen::Ref<VectorX> memory) const {
  // After an event the coordinate is slightly beyond the stop, or before it. Exactly at the stop its rate decides; a
  // part at rest there is in contact, and leaves the branch if it is not pressed against the stop.
  const auto [q, v] = value(state);
  const auto beyond = [](double p, double rate) { return p > 0 || (p == 0 && rate >= 0); };
  memory[0] = beyond(q - range_.upper, v) ? 1 : beyond(range_.lower - q, -v) ? -1 : 0;
}

}  // namespace bielle::mechanism

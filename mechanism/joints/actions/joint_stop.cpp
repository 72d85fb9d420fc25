#include "mechanism/joints/actions/joint_stop.hpp"

#include <cmath>

#include <fmt/format.h>

#include "mechanism/measures/own_measure.hpp"
#include "mechanism/model/description.hpp"

namespace bielle::mechanism {

void JointStop::declare(Declaration& declaration) const {
  declare_references(declaration);
  declaration.damping = law_.damping > 0;
  declaration.kinks = true;  // the force has a kink at zero
  declaration.memory = {0};  // side of the contact
  law_.declare_events(coordinate().name + " at its upper stop", coordinate().name + " at its lower stop", declaration);
}

StopLaw::Contact JointStop::contact(const LocalState& state, double q, double v) const {
  return law_.contact(state.environment().statics ? law_.side_at_rest(q) : state.memory()[0], q, v);
}

void JointStop::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  CoordinateSlopes& slopes = calc_slopes(state);
  if (const StopLaw::Contact c = contact(state, slopes.value, slopes.rate); c.pushes)
    r.segment(row(state), slopes.w().size()) += c.N * slopes.w();
}

void JointStop::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  CoordinateDerivatives& jet = calc(state);
  const StopLaw::Contact c = contact(state, jet.value, jet.rate);
  if (!c.pushes) return;
  const int at = row(state);
  const auto n = jet.w().size();
  if (tangent.wants_K) {
    auto K = tangent.K.dense().block(at, at, n, n);
    K += c.N * jet.W() + law_.stiffness * jet.w() * jet.g().transpose();
    if (law_.damping > 0) K += law_.damping * jet.w() * rate_slope(state, jet).transpose();
  }
  if (tangent.wants_C) tangent.C.dense().block(at, at, n, n) += law_.damping * jet.w() * jet.w().transpose();
}

void JointStop::add_energy(const LocalState& state, Energy& energy) const {
  const auto [q, v] = value(state);
  law_.add_energy(contact(state, q, v), v, energy);
}

void JointStop::describe(const LocalState& /*state*/, Description& description) const {
  const char *units = coordinate().units(), *force = coordinate().force_units();
  std::string text;
  if (std::isfinite(law_.lower)) text += fmt::format(" lower end {:.6g} {},", law_.lower, units);
  if (std::isfinite(law_.upper)) text += fmt::format(" upper end {:.6g} {},", law_.upper, units);
  text += fmt::format(" stiffness {:.6g} {}/{}", law_.stiffness, force, units);
  if (law_.damping > 0) text += fmt::format(", damping {:.6g} {} s/{}", law_.damping, force, units);
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
  const bool at_upper = law_.upper - jet.value < jet.value - law_.lower;
  gradient.position().segment(row(state), jet.g().size()) = (at_upper ? -1 : 1) * jet.g();
  return at_upper ? law_.upper - jet.value : jet.value - law_.lower;
}

double JointStop::calc_force(const LocalState& state, MeasureGradient& gradient) const {
  CoordinateDerivatives& jet = calc(state);
  const StopLaw::Contact c = contact(state, jet.value, jet.rate);
  if (!c.pushes) return 0;
  const int at = row(state);
  const auto n = jet.g().size();
  gradient.position().segment(at, n) = -law_.stiffness * jet.g();
  if (law_.damping > 0) {
    gradient.position().segment(at, n) -= law_.damping * rate_slope(state, jet);
    gradient.rate().segment(at, n) = -law_.damping * jet.w();
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
  law_.calc_event_functions(value(state).value, values);
}

bool JointStop::leaves_branch(const LocalState& state) const {
  const auto [q, v] = value(state);
  return contact(state, q, v).penetration < 0;
}

void JointStop::begin_branch(const LocalState& state, std::span<const int> /*crossed*/,
                             Eigen::Ref<VectorX> memory) const {
  const auto [q, v] = value(state);
  memory[0] = law_.side_after(q, v);
}

}  // namespace bielle::mechanism

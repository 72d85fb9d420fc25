#include "mechanism/elements/beam/distributed_load.hpp"

#include <utility>

#include <fmt/format.h>

#include "mechanism/elements/beam/load_pieces.hpp"
#include "mechanism/math/so3.hpp"
#include "mechanism/model/description.hpp"

namespace bielle::mechanism {

DistributedLoad::DistributedLoad(std::string name, const BeamSpan& span)
    : SpanLoad(std::move(name), span, {0, 1}), middle_(points()[1]) {}

void DistributedLoad::set(LineLoad load) {
  load_ = std::move(load);
  divide(load_pieces(load_.components, span().s_A, span().s_B));
}

void DistributedLoad::declare(Declaration& declaration) const {
  declaration.nodes = {span().node_a, span().node_b};
  declaration.stiffness = true;
  load_.references.declare(declaration);
  for (const StateFormula& component : load_.components) {
    if (component.reads_state() || reads_span_motion(component)) declaration.damping = true;
    if (component.reads_reactions()) declaration.reads_reactions = true;
  }
}

DistributedLoad::Given DistributedLoad::given(const LocalState& state, const SpanValues& variables) const {
  Vector6 components;
  for (std::size_t k = 0; k < 6; ++k)
    components[static_cast<Eigen::Index>(k)] = load_.components[k].value(state, variables);
  components *= state.environment().load_factor;
  return {components.head<3>(), components.tail<3>()};
}

SpanForce DistributedLoad::on_line(const Given& given, const SpanSection& at) const {
  SpanForce force;
  force.f = load_.follower ? Vector3(at.S * given.F) : given.F;
  force.n =
      (load_.follower ? given.M : Vector3(at.S.transpose() * given.M)) + load_.at.cross(at.S.transpose() * force.f);
  return force;
}

SpanForce DistributedLoad::load(const LocalState& state, const SpanPoint& point, const SpanSection& at) const {
  return on_line(given(state, span_values(span(), point, at, state)), at);
}

/// At constant F and M:  df = -S F~ dTheta(z) for followers, else 0;  dn = ((S^T M)~ + c~ (S^T F)~) dTheta(z) for dead
/// loads, else 0.
void DistributedLoad::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (!tangent.wants_K && !tangent.wants_C) return;
  for (const SpanPoint& point : points()) {
    const SpanSection at = span_section(span(), point, state);
    const SpanValues variables = span_values(span(), point, at, state);
    add_formula_tangent(point, at, variables, state, tangent);
    if (!tangent.wants_K) continue;
    const Given here = given(state, variables);
    Matrix3 f_turn = Matrix3::Zero(), n_turn = Matrix3::Zero();
    if (load_.follower)
      f_turn = -at.S * skew(here.F);
    else
      n_turn = skew(at.S.transpose() * here.M) + skew(load_.at) * skew(at.S.transpose() * here.F);
    add_span_tangent(span(), point, at, on_line(here, at), f_turn, n_turn, state, tangent.K.dense());
  }
}

/// Adds the derivatives through the formulas: the rows of a unit component times the gradient of its formula.
void DistributedLoad::add_formula_tangent(const SpanPoint& point, const SpanSection& at, const SpanValues& variables,
                                          const LocalState& state, LocalTangent& tangent) const {
  thread_local FormulaGradient gradient;
  SpanGradients by_nodes;
  bool have_gradients = false;
  for (std::size_t k = 0; k < 6; ++k) {
    const StateFormula& component = load_.components[k];
    const bool moves = reads_span_motion(component);
    if (!moves && !component.reads_state()) continue;
    if (moves && !have_gradients) by_nodes = span_gradients(span(), point, at, state);
    have_gradients = have_gradients || moves;
    component.calc(state, variables, gradient);
    Given unit{Vector3::Zero(), Vector3::Zero()};
    (k < 3 ? unit.F : unit.M)[static_cast<Eigen::Index>(k % 3)] = state.environment().load_factor;
    const Vector12 rows = span_rows(span(), point, at, on_line(unit, at), state);
    if (component.reads_state()) {
      if (tangent.wants_K) tangent.K.dense().topRows<12>() += rows * gradient.by_state.position().transpose();
      if (tangent.wants_C) tangent.C.dense().topRows<12>() += rows * gradient.by_state.rate().transpose();
    }
    if (!moves) continue;
    const Eigen::Map<const Eigen::Matrix<double, 1, span_variable_count>> by_variable(gradient.by_variable.data());
    if (tangent.wants_K) tangent.K.dense().block<12, 12>(0, 0) += rows * (by_variable * by_nodes.by_position);
    if (tangent.wants_C) tangent.C.dense().block<12, 12>(0, 0) += rows * (by_variable * by_nodes.by_rate);
  }
}

void DistributedLoad::add_break_points(std::vector<double>& times) const {
  for (const StateFormula& component : load_.components) component.add_break_points(span_time, times);
}

std::vector<TimeDependent::Formula> DistributedLoad::time_formulas() const {
  std::vector<Formula> formulas;
  for (std::size_t k = 0; k < 6; ++k)
    if (load_.components[k].holds_time(span_time))
      formulas.push_back(
          {fmt::format("{} per length {}", k < 3 ? "force" : "moment", "xyz"[k % 3]), k < 3 ? "N/m" : "N"});
  return formulas;
}

void DistributedLoad::calc_time_formulas(const LocalState& state, std::span<double> values) const {
  const SpanValues variables = span_values(span(), middle_, span_section(span(), middle_, state), state);
  std::size_t next = 0;
  for (const StateFormula& component : load_.components)
    if (component.holds_time(span_time)) values[next++] = component.value(state, variables);
}

std::string DistributedLoad::text(std::size_t first) const {
  return fmt::format("({}, {}, {})", load_.components[first].text(), load_.components[first + 1].text(),
                     load_.components[first + 2].text());
}

void DistributedLoad::describe(const LocalState& /*state*/, Description& description) const {
  if (span().s_A > 0) return;  // equal on all elements
  std::string said;
  if (load_.has_force) said += fmt::format("force {} N/m", text(0));
  if (load_.has_force && !load_.at.isZero(0))
    said += fmt::format(" at y {:.6g} m, z {:.6g} m of the section", load_.at.y(), load_.at.z());
  if (load_.has_moment) said += fmt::format("{}moment {} N m/m", said.empty() ? "" : ", ", text(3));
  description.add_line(
      fmt::format("load per length: {}, {}", said, load_.follower ? "turning with the section" : "fixed in space"));
}

std::vector<OutputField> DistributedLoad::output_fields() const {
  constexpr bool summed = true;
  return {{"distributed_force", {3}, "N", "sum of the loads per length, inertial components", summed},
          {"distributed_moment", {3}, "N m", "their moment about the inertial origin, inertial components", summed}};
}

void DistributedLoad::write_output(const LocalState& state, double* values) const {
  Vector3 F = Vector3::Zero(), m = Vector3::Zero();
  for (const SpanPoint& point : points()) {
    const SpanSection at = span_section(span(), point, state);
    const SpanForce here = load(state, point, at);
    F += point.w * here.f;
    m += point.w * (span_position(point, state).cross(here.f) + at.S * here.n);
  }
  Eigen::Map<Vector6>(values) << F, m;
}

}  // namespace bielle::mechanism

#include "mechanism/joints/actions/one_way.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mechanism/joints/rest_limits.hpp"
#include "mechanism/model/description.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {

void OneWay::declare_one_way(Declaration& declaration, EventFunction opening) const {
  declare_references(declaration);
  declaration.memory = {0, 0, 0, 0};
  EventFunction closing{fmt::format("one-way clutch on {} holds", coordinate().name),
                        EventFunction::Direction::falling};
  opening.name = fmt::format("one-way clutch on {} opens", coordinate().name);
  closing.begins_on = 1;
  closing.nearest = 1e-5;
  declaration.event_functions = {closing, opening};
}

std::vector<OutputField> OneWay::output_fields() const {
  OutputField flag = force_field("one_way_holds", "1 along the coordinates that a one-way clutch holds, else 0");
  flag.units = std::string{"-"};
  return {force_field("one_way_force", "force or torque of one-way clutches along the joint's coordinates"), flag};
}

void OneWay::write_output(const LocalState& state, double* values) const {
  write_force(force(state), values);
  write_force(holds(state) ? 1 : 0, values + joint().coordinates().size());
}

void OneWay::describe(const LocalState& /*state*/, Description& description) const {
  std::string text = fmt::format("one-way clutch on {}, free {}, {}", coordinate().name,
                                 rule_.sense > 0 ? "forwards" : "backwards", form());
  if (rule_.pitch > 0) text += fmt::format(", holds at multiples of {:.6g} {}", rule_.pitch, coordinate().units());
  description.add_line(text);
}

double OneWay::clearance(const LocalState& state, double q) const {
  return rule_.sense * q - state.memory()[passed] * rule_.pitch;
}

double OneWay::rounding(double q) const { return 1e-10 * rule_.pitch + 1e-14 * std::abs(q); }

void OneWay::accept(const LocalState& state, Eigen::Ref<VectorX> memory) const {
  const auto [q, rate] = value(state);
  if (holds(state)) return;
  const bool away =
      rule_.pitch > 0 ? clearance(state, q) > rounding(q) : rule_.sense * rate > velocity_at_rest(state.of(0), 1);
  if (away) memory[has_moved] = 1;
  if (rule_.pitch > 0) memory[passed] = std::max(memory[passed], std::floor(rule_.sense * q / rule_.pitch));
}

void OneWay::calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const {
  values[closes] = 1;
  values[opens] = holds(state) ? opening(state) : not_opening();
  if (holds(state)) return;
  const auto [q, rate] = value(state);
  const double v = rule_.sense * rate, limit = velocity_at_rest(state.of(0), 1);
  if (state.memory()[has_moved] != 0) {
    values[closes] = rule_.pitch > 0 ? clearance(state, q) : v - limit;
  } else {
    // Just after opening, the velocity is only a rounding error, or an error of the scheme. The acceleration is
    // therefore included.
    const double a = rule_.sense * calc_kept_rates(state).second;
    values[closes] = std::max(v + limit, a + acceleration_at_rest(state.of(0), 1));
    // A ratchet that leaves its multiple may come back within the step.
    if (rule_.pitch > 0) values[closes] = std::max(values[closes], clearance(state, q) - touching(q));
  }
}

void OneWay::hold_at(double value, Eigen::Ref<VectorX> memory) const {
  memory[holding] = 1;
  memory[held_at] = value;
  memory[has_moved] = 0;
}

/// Sets it free at a state; it may engage from there on.
void OneWay::activate(const LocalState& state, Eigen::Ref<VectorX> memory) const {
  const double q = value(state).value;
  memory[holding] = 0;
  memory[has_moved] = 1;
  if (rule_.pitch > 0) memory[passed] = std::floor((rule_.sense * q + rounding(q)) / rule_.pitch);
}

void OneWay::begin_motion(const LocalState& state, bool known, Eigen::Ref<VectorX> memory) const {
  if (is_wound(state)) return;
  activate(state, memory);
  if (!known) return;
  const auto [q, rate] = value(state);
  const double v = rule_.sense * rate, limit = velocity_at_rest(state.of(0), 1);
  if (rule_.pitch > 0) {
    const double stop = memory[passed] * rule_.pitch;
    if (rule_.sense * q - stop <= rounding(q) && v <= limit) hold_at(rule_.sense * stop, memory);
    return;
  }
  if (v < -limit)
    throw ComputationError(
        fmt::format("the one-way clutch on the {} of joint '{}' holds against a rate of {:.6g} {}, with "
                    "which the motion begins",
                    coordinate().name, joint().name(), rate, coordinate().rate_units()));
  if (v <= limit) hold_at(q, memory);
}

void OneWay::begin_branch(const LocalState& state, std::span<const int> crossed, Eigen::Ref<VectorX> memory) const {
  const auto has_crossed = [&](int k) { return std::find(crossed.begin(), crossed.end(), k) != crossed.end(); };
  if (holds(state) && has_crossed(opens)) {
    memory[holding] = memory[has_moved] = 0;
  } else if (!holds(state) && has_crossed(closes)) {
    hold_at(rule_.pitch > 0 ? rule_.sense * state.memory()[passed] * rule_.pitch : value(state).value, memory);
  }
}

bool OneWay::knows_memory(const LocalState& state) const {
  const auto memory = state.memory();
  const auto is_flag = [](double value) { return value == 0 || value == 1; };
  return is_flag(memory[holding]) && is_flag(memory[has_moved]) && std::floor(memory[passed]) == memory[passed];
}

// -- rigid

void RigidOneWay::declare(Declaration& declaration) const {
  EventFunction opening{"", EventFunction::Direction::rising};
  opening.begins_on = -1;
  opening.reads_reaction = true;
  opening.one_sided = EventFunction::OneSided::opens;
  declare_one_way(declaration, opening);
  EventFunction taking{fmt::format("one-way clutch on {} holds in place of another", coordinate().name),
                       EventFunction::Direction::rising};
  taking.begins_on = -1;
  taking.one_sided = EventFunction::OneSided::violated;
  declaration.event_functions.push_back(taking);
  Declaration::Scalar row{coordinate().name + " held one way", coordinate().force_units()};
  row.switched = row.yields = true;
  declaration.multipliers.push_back(row);
}

/// The coordinate opens by its force. If other constraints hold it as well, there is no force, and its motion decides.
void RigidOneWay::calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const {
  OneWay::calc_event_functions(state, values);
  values[takes_over] = -1;
  if (!holds(state) || !state.idle(0)) return;
  const double v = sense() * value(state).rate, a = sense() * calc_kept_rates(state).second,
               v_limit = velocity_at_rest(state.of(0), 1), a_limit = acceleration_at_rest(state.of(0), 1);
  const bool moves = std::abs(v) > v_limit;
  values[opens] = moves ? v : a - a_limit;
  values[takes_over] = moves ? -v : -a - a_limit;
}

void RigidOneWay::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  CoordinateSlopes& slopes = calc_slopes(state);
  const double away = slopes.principal - held_value(state);
  add_kept(state, slopes, coordinate().kind == JointCoordinate::Kind::angle ? std::remainder(away, 2 * M_PI) : away, r);
}

void RigidOneWay::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (tangent.wants_K) add_kept_tangent(state, calc(state), tangent);
}

void RigidOneWay::add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                                       Eigen::Ref<VectorX> acceleration) const {
  const auto [first, second] = calc_kept_rates(state);
  velocity[0] += first;
  acceleration[0] += second;
}

bool RigidOneWay::is_on(const LocalState& state, int /*row*/) const { return holds(state); }

// -- elastic

void ElasticOneWay::declare(Declaration& declaration) const {
  EventFunction opening{"", EventFunction::Direction::falling};
  opening.begins_on = 1;  // a motion may begin without elongation
  declare_one_way(declaration, opening);
  declaration.damping = damping_ > 0;
  declaration.kinks = true;  // the force has a kink at zero
}

ElasticOneWay::Contact ElasticOneWay::contact(const LocalState& state, double q, double rate) const {
  Contact contact;
  if (!holds(state)) return contact;
  contact.p = sense() * (held_value(state) - q);
  const double push = stiffness_ * contact.p - damping_ * sense() * rate;
  contact.pushes = push > 0;
  contact.N = std::max(0.0, push);
  return contact;
}

void ElasticOneWay::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  CoordinateSlopes& slopes = calc_slopes(state);
  if (const Contact c = contact(state, slopes.value, slopes.rate); c.pushes)
    r.segment(row(state), slopes.w().size()) -= sense() * c.N * slopes.w();
}

void ElasticOneWay::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  CoordinateDerivatives& jet = calc(state);
  const Contact c = contact(state, jet.value, jet.rate);
  if (!c.pushes) return;
  const int at = row(state);
  const auto n = jet.w().size();
  if (tangent.wants_K) {
    auto K = tangent.K.dense().block(at, at, n, n);
    K += stiffness_ * jet.w() * jet.g().transpose() - sense() * c.N * jet.W();
    if (damping_ > 0) K += damping_ * jet.w() * rate_slope(state, jet).transpose();
  }
  if (tangent.wants_C) tangent.C.dense().block(at, at, n, n) += damping_ * jet.w() * jet.w().transpose();
}

void ElasticOneWay::add_energy(const LocalState& state, Energy& energy) const {
  const auto [q, rate] = value(state);
  const Contact c = contact(state, q, rate);
  energy.elastic += 0.5 * stiffness_ * c.p * c.p;
  energy.dissipation += (stiffness_ * c.p - c.N) * sense() * rate;
}

bool ElasticOneWay::leaves_branch(const LocalState& state) const {
  return holds(state) && sense() * (held_value(state) - value(state).value) < -1e-14 * std::abs(held_value(state));
}

double ElasticOneWay::opening(const LocalState& state) const {
  return sense() * (held_value(state) - value(state).value);
}

double ElasticOneWay::force(const LocalState& state) const {
  const auto [q, rate] = value(state);
  return sense() * contact(state, q, rate).N;
}

std::string ElasticOneWay::form() const {
  const std::string per = fmt::format("{}/{}", coordinate().force_units(), coordinate().units());
  std::string text = fmt::format("stiffness {:.6g} {}", stiffness_, per);
  if (damping_ > 0)
    text += fmt::format(", damping {:.6g} {} s/{}", damping_, coordinate().force_units(), coordinate().units());
  return text;
}

}  // namespace bielle::mechanism

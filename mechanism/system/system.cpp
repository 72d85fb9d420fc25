#include "mechanism/system/system.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mechanism/model/assembly_branch.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {

System::System(const Model& model)
    : model_(model),
      kinematics_(model),
      unknowns_(model, kinematics_),
      work_(unknowns_),
      residual_(model, kinematics_, unknowns_, work_),
      tangent_(model, kinematics_, unknowns_, work_),
      idle_(model, unknowns_),
      branches_(model, unknowns_, work_) {
  for (const Member& member : model.members()) {
    Declaration declaration;
    member.component->declare(declaration);
    unknowns_.add(declaration);
    work_.add(declaration);
    residual_.add(declaration);
    tangent_.add(declaration);
    idle_.add(declaration);
    branches_.add(declaration);
  }
  unknowns_.complete();
  work_.complete();
  residual_.complete();
  tangent_.complete();
  build_pattern();
}

void System::build_pattern() {
  tangent_.build_pattern(idle_.possible());
  idle_.find_places(pattern());
}

void System::forget_pairs() const {
  if (tangent_.forget_pairs()) idle_.find_places(pattern());
}

void System::set_aside(const std::vector<int>& multipliers) {
  idle_.set_aside(multipliers);
  // Rows that may be set aside later must also be formulated along carried axes.
  unknowns_.carry_axes(idle_.possible());
  build_pattern();
}

std::string System::wrong_branch(const State& state, const Environment& environment) const {
  for (std::size_t m = 0; m < slots().size(); ++m) {
    if (slots()[m].multipliers == 0 || !is_active(state, m)) continue;
    const Member& member = model_.members()[m];
    const auto* branch = dynamic_cast<const AssemblyBranch*>(member.component.get());
    if (!branch) continue;
    if (const std::string what = branch->wrong_branch(LocalState(state, slots()[m], environment)); !what.empty())
      return fmt::format("{}: {}", describe(member), what);
  }
  return {};
}

State System::start(double time) const {
  State state;
  state.time = time;
  kinematics_.start(state.nodes, time);
  unknowns_.start(state);
  return state;
}

void System::displace(State& state, const State& base, const Eigen::Ref<const VectorX>& dq) const {
  kinematics_.displace(state.nodes, base.nodes, dq.head(kinematics_.unknowns()), state.time, state.motion_factor);
  state.amplitude = base.amplitude + dq.tail(unknowns_.amplitudes());
}

void System::set_rates(State& state, const Eigen::Ref<const VectorX>& v, const Eigen::Ref<const VectorX>& a) const {
  const int n = kinematics_.unknowns(), amplitudes = unknowns_.amplitudes();
  kinematics_.set_rates(state.nodes, v.head(n), a.head(n), state.time);
  state.amplitude_rate = v.tail(amplitudes);
  state.amplitude_acceleration = a.tail(amplitudes);
}

void System::get_rates(const State& state, Eigen::Ref<VectorX> v, Eigen::Ref<VectorX> a) const {
  const int n = kinematics_.unknowns(), amplitudes = unknowns_.amplitudes();
  kinematics_.get_rates(state.nodes, v.head(n), a.head(n));
  v.tail(amplitudes) = state.amplitude_rate;
  a.tail(amplitudes) = state.amplitude_acceleration;
}

void System::residual(const State& state, const Environment& environment, Eigen::Ref<VectorX> r,
                      ResidualScale* scale) const {
  residual_.add_all(state, environment, r, scale);
  idle_.for_each(state,
                 [&](int multiplier) { r[unknowns_.first_multiplier() + multiplier] = state.multiplier[multiplier]; });
}

void System::tangent(const State& state, const Environment& environment, const TangentWeights& weights,
                     const VectorX* dq, std::vector<double>& values) const {
  if (tangent_.set_values(state, environment, weights, dq, values)) idle_.find_places(pattern());
  idle_.clear(state, values);
}

void System::constraint_rates(const State& state, const Environment& environment, Eigen::Ref<VectorX> velocity,
                              Eigen::Ref<VectorX> acceleration) const {
  velocity.setZero();
  acceleration.setZero();
  for (std::size_t m = 0; m < slots().size(); ++m) {
    const Slots& own = slots()[m];
    if (own.multipliers == 0 || !is_active(state, m)) continue;
    model_.members()[m].component->add_constraint_rates(LocalState(state, own, environment),
                                                        velocity.segment(own.multiplier_begin, own.multipliers),
                                                        acceleration.segment(own.multiplier_begin, own.multipliers));
  }
}

namespace {

bool is_finite(const Energy& e) {
  return std::isfinite(e.kinetic + e.elastic + e.gravity) && std::isfinite(e.dissipation) && std::isfinite(e.input);
}

/// Throws for the first component with an energy that is not finite, because an energy balance with it would be
/// meaningless.
[[noreturn]] void throw_without_energy(const System& system, const State& state, const Environment& environment) {
  const auto& members = system.model().members();
  for (std::size_t m = 0; m < members.size(); ++m) {
    if (!system.is_active(state, m)) continue;
    Energy energy;
    members[m].component->add_energy(LocalState(state, system.slots()[m], environment), energy);
    if (is_finite(energy)) continue;
    const auto bad = [](double value) { return !std::isfinite(value); };
    const char* what = bad(energy.kinetic)       ? "kinetic energy"
                       : bad(energy.elastic)     ? "stored energy"
                       : bad(energy.gravity)     ? "energy of gravity"
                       : bad(energy.dissipation) ? "dissipated power"
                                                 : "power";
    throw ComputationError(
        fmt::format("t = {:.6g} s: the {} of {} is too large for a number (overflow): its values are of incompatible "
                    "sizes; check them, and their units",
                    state.time, what, describe(members[m])));
  }
  throw ComputationError(fmt::format(
      "t = {:.6g} s: the energy of the mechanism is too large for a number (overflow), though that of each part is not",
      state.time));
}

}  // namespace

Energy System::energy(const State& state, const Environment& environment) const {
  thread_local std::vector<Energy> costly;
  costly.assign(work_.costly().size(), {});
  std::vector<Energy>& parts = costly;  // all threads use the buffer of the calling thread
  Energy energy;
  const auto add_one = [&](std::size_t m, Energy& sum) {
    if (!is_active(state, m)) return;
    model_.members()[m].component->add_energy(LocalState(state, slots()[m], environment), sum);
  };
  const auto add_small = [&] {
    for (std::size_t m = 0; m < slots().size(); ++m)
      if (!work_.is_costly(m)) add_one(m, energy);
  };
  work_.share([&](std::size_t k) { add_one(work_.costly()[k], parts[k]); }, add_small);
  for (const Energy& part : parts) energy += part;
  if (kinematics_.any_prescribed()) energy.input += residual_.support_power(state, environment);
  if (!is_finite(energy)) throw_without_energy(*this, state, environment);
  return energy;
}

std::vector<double> System::break_points() const {
  std::vector<double> times;
  for (const Member& member : model_.members()) member.component->add_break_points(times);
  for (const Node& node : model_.nodes())
    for (std::size_t k = 0; k < 6; ++k)
      if (node.freedom[k] == Freedom::prescribed)
        for (const double time : node.motion[k].break_points()) times.push_back(time);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

void System::begin_branch(State& state, const Environment& environment, const std::vector<int>& crossed) const {
  branches_.begin(state, environment, crossed);
  switch_constraints(state, environment);
}

bool System::begin_motion(State& state, const Environment& environment, bool known) const {
  branches_.begin_motion(state, environment, known);
  const std::vector<char> before = state.idle;
  const VectorX multiplier = state.multiplier;
  switch_constraints(state, environment);
  bool switched = false;
  for (std::size_t k = 0; k < state.idle.size(); ++k) {
    const bool was_off = k < before.size() && before[k] == Idle::switched_off;
    if (was_off != (state.idle[k] == Idle::switched_off)) switched = true;
  }
  if (switched || before.empty()) return switched;
  state.idle = before;  // includes the redundant constraints
  state.multiplier = multiplier;
  return false;
}

bool System::accept(State& state, const Environment& environment) const {
  const bool branches_left = branches_.accept(state, environment);
  // One Newton step of the polar decomposition removes the rounding errors that accumulate in products of rotations.
  for (NodeState& node : state.nodes) {
    const Matrix3 excess = node.R.transpose() * node.R;
    node.R = node.R * (1.5 * Matrix3::Identity() - 0.5 * excess);
  }
  return branches_left;
}

}  // namespace bielle::mechanism

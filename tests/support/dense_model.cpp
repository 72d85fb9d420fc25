#include "tests/support/dense_model.hpp"

#include <functional>
#include <stdexcept>

#include <Eigen/LU>

namespace bielle::test {

using mechanism::exp_so3;
using mechanism::LocalMatrix;
using mechanism::LocalState;
using mechanism::LocalTangent;
using mechanism::NodeState;

DenseModel::DenseModel(const Model& model, std::optional<std::size_t> only, bool carried_axes)
    : environment(model.environment), model_(model), nodes_(static_cast<int>(model.nodes().size())) {
  members_.reserve(model.members().size());
  for (std::size_t m = 0; m < model.members().size(); ++m) {
    if (only && *only != m) continue;
    const mechanism::Component& component = *model.members()[m].component;
    Declaration d;
    component.declare(d);
    auto& slots = slots_[&component] = std::make_unique<mechanism::Slots>();
    number(component, d, *slots, carried_axes);
    members_.push_back({&component, {}, {}});
    for (const auto& row : d.multipliers) constraint_kinds_.push_back(row.kind);
    declarations_.push_back(std::move(d));
  }
  own_multipliers_ = multipliers_;
  for (std::size_t k = 0; k < members_.size(); ++k) refer(k, declarations_[k], carried_axes);
  multiplier_begin_ = 6 * nodes_ + amplitudes_ + first_orders_;
  for (Placed& m : members_) {
    m.slots = *slots_.at(m.component);
    place(m.slots, m.place);
  }
}

void DenseModel::number(const mechanism::Component& /*component*/, const Declaration& d, mechanism::Slots& s,
                        bool carried_axes) {
  s.nodes = d.nodes;
  s.carried_axes = carried_axes;
  s.amplitude_begin = amplitudes_;
  amplitudes_ += s.amplitudes = static_cast<int>(d.amplitudes.size());
  s.first_order_begin = first_orders_;
  first_orders_ += s.first_orders = static_cast<int>(d.first_order.size());
  s.multiplier_begin = multipliers_;
  multipliers_ += s.multipliers = static_cast<int>(d.multipliers.size());
  s.memory_begin = memories_;
  memories_ += s.memories = static_cast<int>(d.memory.size());
  for (const auto& unknown : d.first_order) algebraic_.push_back(unknown.algebraic);
  all_declarations_.push_back(d);
}

/// Numbers the components to which a component refers, and their references in turn, and completes the slots.
void DenseModel::refer(std::size_t placed, const Declaration& declaration, bool carried_axes) {
  const std::function<void(mechanism::Slots&, const Declaration&)> complete = [&](mechanism::Slots& slots,
                                                                                  const Declaration& d) {
    for (const mechanism::Component* other : d.references) {
      Declaration of_other;
      other->declare(of_other);
      auto& theirs = slots_[other];
      if (!theirs) {
        theirs = std::make_unique<mechanism::Slots>();
        number(*other, of_other, *theirs, carried_axes);
      }
      if (theirs->references.empty() && !of_other.references.empty()) complete(*theirs, of_other);
      slots.refer_to(*slots_.at(other));
    }
  };
  mechanism::Slots& slots = *slots_.at(members_[placed].component);
  if (slots.references.empty()) complete(slots, declaration);
}

void DenseModel::place(const mechanism::Slots& slots, std::vector<int>& place) const {
  for (int node : slots.nodes)
    for (int i = 0; i < 6; ++i) place.push_back(6 * node + i);
  for (int i = 0; i < slots.amplitudes; ++i) place.push_back(amplitude_begin() + slots.amplitude_begin + i);
  for (int i = 0; i < slots.first_orders; ++i) place.push_back(first_order_begin() + slots.first_order_begin + i);
  for (int i = 0; i < slots.multipliers; ++i) place.push_back(multiplier_begin_ + slots.multiplier_begin + i);
  for (const mechanism::Slots* other : slots.references) this->place(*other, place);
}

State DenseModel::start() const {
  State state;
  for (const mechanism::Node& node : model_.nodes())
    state.nodes.push_back({node.frame.x, node.frame.R, node.velocity, node.angular_velocity, {0, 0, 0}, {0, 0, 0}});
  state.amplitude = state.amplitude_rate = state.amplitude_acceleration = VectorX::Zero(amplitudes_);
  state.first_order = state.first_order_rate = VectorX::Zero(first_orders_);
  state.multiplier = VectorX::Zero(multipliers_);
  state.memory = VectorX::Zero(memories_);
  int a = 0, y = 0, l = 0, m = 0;
  for (const Declaration& d : all_declarations_) {
    for (const auto& scalar : d.amplitudes) state.amplitude[a++] = scalar.start;
    for (const auto& scalar : d.first_order) state.first_order[y++] = scalar.start;
    for (const auto& scalar : d.multipliers) state.multiplier[l++] = scalar.start;
    for (double memory : d.memory) state.memory[m++] = memory;
  }
  return state;
}

void DenseModel::move(State& state, const VectorX& step) const {
  for (int k = 0; k < nodes_; ++k) {
    NodeState& n = state.nodes[static_cast<std::size_t>(k)];
    n.x += step.segment<3>(6 * k);
    n.R = n.R * exp_so3(step.segment<3>(6 * k + 3));
  }
  state.amplitude += step.segment(amplitude_begin(), amplitudes_);
  state.first_order += step.segment(first_order_begin(), first_orders_);
  state.multiplier += step.tail(multipliers_);
}

void DenseModel::move_rates(State& state, const VectorX& step) const {
  for (int k = 0; k < nodes_; ++k) {
    state.nodes[static_cast<std::size_t>(k)].v += step.segment<3>(6 * k);
    state.nodes[static_cast<std::size_t>(k)].Omega += step.segment<3>(6 * k + 3);
  }
  state.amplitude_rate += step.segment(amplitude_begin(), amplitudes_);
  state.first_order_rate += step.segment(first_order_begin(), first_orders_);
}

void DenseModel::move_accelerations(State& state, const VectorX& step) const {
  for (int k = 0; k < nodes_; ++k) {
    state.nodes[static_cast<std::size_t>(k)].a += step.segment<3>(6 * k);
    state.nodes[static_cast<std::size_t>(k)].Omegadot += step.segment<3>(6 * k + 3);
  }
  state.amplitude_acceleration += step.segment(amplitude_begin(), amplitudes_);
}

VectorX DenseModel::rates(const State& state) const {
  VectorX v = VectorX::Zero(size());
  for (int k = 0; k < nodes_; ++k) {
    const NodeState& n = state.nodes[static_cast<std::size_t>(k)];
    v.segment<6>(6 * k) << n.v, n.Omega;
  }
  v.segment(amplitude_begin(), amplitudes_) = state.amplitude_rate;
  v.segment(first_order_begin(), first_orders_) = state.first_order_rate;
  return v;
}

VectorX DenseModel::accelerations(const State& state) const {
  VectorX a = VectorX::Zero(size());
  for (int k = 0; k < nodes_; ++k) {
    const NodeState& n = state.nodes[static_cast<std::size_t>(k)];
    a.segment<6>(6 * k) << n.a, n.Omegadot;
  }
  a.segment(amplitude_begin(), amplitudes_) = state.amplitude_acceleration;
  return a;
}

State DenseModel::along_motion(const State& state, double s) const {
  // R(s) = R exp(s Omega + s^2/2 Omegadot) has the angular velocity Omega + s Omegadot up to s^2.
  State later = state;
  const VectorX v = rates(state), a = accelerations(state);
  move(later, s * v + s * s / 2 * a);
  move_rates(later, s * a);
  later.time += s;
  return later;
}

VectorX DenseModel::residual(const State& state) const {
  VectorX r = VectorX::Zero(size());
  for (const Placed& m : members_) {
    VectorX local = VectorX::Zero(m.slots.size());
    m.component->add_residual({state, m.slots, environment}, local);
    for (std::size_t i = 0; i < m.place.size(); ++i) r[m.place[i]] += local[static_cast<Eigen::Index>(i)];
  }
  return r;
}

MatrixX DenseModel::tangent(const State& state, Part part) const {
  MatrixX A = MatrixX::Zero(size(), size());
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const Placed& m = members_[k];
    const int n = m.slots.size();
    MatrixX K = MatrixX::Zero(n, n), C = MatrixX::Zero(n, n), M = MatrixX::Zero(n, n);
    const Declaration& d = declarations_[k];
    const auto target = [&](MatrixX& matrix) { return LocalMatrix(matrix, d.in_blocks); };
    LocalTangent tangent{target(K), target(C), target(M), part == Part::K, part == Part::C, part == Part::M};
    const bool declared = part == Part::K ? d.stiffness : part == Part::C ? d.damping : d.mass;
    if (!declared) continue;
    m.component->add_tangent({state, m.slots, environment}, tangent);
    MatrixX& asked = part == Part::K ? K : part == Part::C ? C : M;
    mechanism::LocalPattern pattern(n);
    m.component->add_pattern(m.slots, pattern);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        if (asked(i, j) != 0 && !pattern.has(i, j))
          throw std::logic_error("component '" + m.component->name() + "' wrote outside of its pattern");
        A(m.place[static_cast<std::size_t>(i)], m.place[static_cast<std::size_t>(j)]) += asked(i, j);
      }
    asked.setZero();
    if (!K.isZero(0) || !C.isZero(0) || !M.isZero(0))
      throw std::logic_error("component '" + m.component->name() + "' wrote a tangent that was not asked for");
  }
  return A;
}

void DenseModel::constraint_rates(const State& state, VectorX& velocity, VectorX& acceleration) const {
  velocity = acceleration = VectorX::Zero(multipliers_);
  for (const Placed& m : members_) {
    if (m.slots.multipliers == 0) continue;
    m.component->add_constraint_rates({state, m.slots, environment},
                                      velocity.segment(m.slots.multiplier_begin, m.slots.multipliers),
                                      acceleration.segment(m.slots.multiplier_begin, m.slots.multipliers));
  }
}

Energy DenseModel::energy(const State& state) const {
  Energy energy;
  for (const Placed& m : members_) m.component->add_energy({state, m.slots, environment}, energy);
  return energy;
}

int solve_static(const DenseModel& model, State& state, const std::vector<int>& free, double tolerance, int most) {
  for (int iteration = 0; iteration < most; ++iteration) {
    const VectorX r = model.residual(state)(free);
    if (r.cwiseAbs().maxCoeff() < tolerance) return iteration;
    const MatrixX K = model.tangent(state, DenseModel::Part::K)(free, free);
    VectorX step = VectorX::Zero(model.size());
    step(free) = -K.partialPivLu().solve(r);
    model.move(state, step);
  }
  return -1;
}

}  // namespace bielle::test

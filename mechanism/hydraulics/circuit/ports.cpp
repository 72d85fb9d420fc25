#include "mechanism/hydraulics/circuit/ports.hpp"

#include <fmt/format.h>

namespace bielle::mechanism {

int Ports::add(const PressureNode& node, References& references) {
  ports_.push_back({&node, references.add(node)});
  return count() - 1;
}

double Ports::pressure(const LocalState& state, int port) const {
  return node(port).pressure(state.of(at(port).reference));
}

int Ports::pressure_row(const LocalState& state, int port) const {
  return state.slots().reference_row(at(port).reference) + node(port).rows().pressure;
}

void Ports::add_one(const LocalState& state, int port, double Q, Eigen::Ref<VectorX> r) const {
  if (port == outside) return;
  const LocalState own = state.of(at(port).reference);
  if (!node(port).balances(own)) return;
  r[state.slots().reference_row(at(port).reference) + node(port).rows().balance] -= node(port).exchange(own).factor * Q;
}

void Ports::add_flow(const LocalState& state, int from, int to, double Q, Eigen::Ref<VectorX> r) const {
  add_one(state, from, -Q, r);
  add_one(state, to, Q, r);
}

void Ports::add_one_tangent(const LocalState& state, int port, double sign, FlowDerivatives& flow,
                            LocalTangent& tangent) const {
  if (port == outside) return;
  const LocalState own = state.of(at(port).reference);
  if (!node(port).balances(own)) return;
  const int begin = state.slots().reference_row(at(port).reference), row = begin + node(port).rows().balance;
  const PressureNode::Exchange exchange = node(port).exchange(own);
  if (tangent.wants_C) tangent.C.dense().row(row) -= sign * exchange.factor * flow.by.rate().transpose();
  if (!tangent.wants_K) return;
  auto K = tangent.K.dense();
  K.row(row) -= sign * exchange.factor * flow.by.position().transpose();
  for (int k = 0; k < own.slots().first_orders; ++k) K(row, begin + k) -= sign * flow.Q * exchange.by[k];
}

void Ports::add_tangent(const LocalState& state, int from, int to, FlowDerivatives& flow, LocalTangent& tangent) const {
  add_one_tangent(state, from, -1, flow, tangent);
  add_one_tangent(state, to, 1, flow, tangent);
}

void Ports::add_pattern(const Slots& slots, LocalPattern& pattern) const {
  for (const Port& port : ports_)
    pattern.add_block(slots.reference_row(port.reference) + port.node->rows().balance, 0, 1, slots.size());
}

double Ports::head(const LocalState& state, int port) const {
  return port == outside ? 0 : node(port).fluid().head(pressure(state, port)).e;
}

double Ports::power(const LocalState& state, int from, int to, double Q) const {
  return Q * (head(state, from) - head(state, to));
}

std::string Ports::describe(int from, int to) const {
  const auto name = [&](int port) { return port == outside ? std::string("outside") : "'" + node(port).name() + "'"; };
  return fmt::format("from {} to {}", name(from), name(to));
}

}  // namespace bielle::mechanism

#include "mechanism/elements/forces/support.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <set>

#include "mechanism/elements/forces/held_directions.hpp"

namespace bielle::mechanism {

Support::Support(std::string name, int node, std::vector<int> carried, std::vector<const Component*> acting)
    : Component("support", std::move(name)), node_(node), carried_(std::move(carried)), acting_(std::move(acting)) {}

void Support::declare(Declaration& declaration) const {
  declaration.passive = true;
  declaration.references = acting_;
}

void Support::gather(const State& state, const Slots& slots, const Eigen::Ref<const VectorX>& r, int begin,
                     Vector6& sum) const {
  for (std::size_t k = 0; k < slots.nodes.size(); ++k) {
    const int node = slots.nodes[k];
    if (node != node_ && std::find(carried_.begin(), carried_.end(), node) == carried_.end()) continue;
    const NodeState &here = state.nodes[static_cast<std::size_t>(node)],
                    &held = state.nodes[static_cast<std::size_t>(node_)];
    const Vector3 force = r.segment<3>(begin + 6 * static_cast<int>(k)),
                  moment = here.R * r.segment<3>(begin + 6 * static_cast<int>(k) + 3);
    sum.head<3>() += force;
    sum.tail<3>() += moment + (here.x - held.x).cross(force);
  }
  for (std::size_t k = 0; k < slots.references.size(); ++k)
    gather(state, *slots.references[k], r, begin + slots.reference_rows[k], sum);
}

Vector6 Support::reaction(const LocalState& state) const {
  // The reported reactions are used; if redundancy leaves them undetermined, these are the smallest ones.
  const State* reported = &state.global();
  State smallest;
  if (reported->reaction.size() > 0) {
    smallest = *reported;
    smallest.multiplier = smallest.reaction;
    reported = &smallest;
  }
  Vector6 sum = Vector6::Zero();
  VectorX r;
  for (std::size_t k = 0; k < acting_.size(); ++k) {
    const LocalState of(*reported, state.of(static_cast<int>(k)).slots(), state.environment());
    r.setZero(of.slots().size());
    acting_[k]->add_residual(of, r);
    gather(*reported, of.slots(), r, 0, sum);
  }
  return sum;
}

std::vector<OutputField> Support::output_fields() const {
  return {{"reaction",
           {6},
           "N, N m",
           "force and moment about the node that its support exerts on it, inertial components"}};
}

void Support::write_output(const LocalState& state, double* values) const {
  Eigen::Map<Vector6> result(values);
  result = reaction(state);
}

namespace {

/// Returns the nodes of a component and of all its references.
const std::set<int>& nodes_of(const Component& component, std::map<const Component*, std::set<int>>& known) {
  const auto found = known.find(&component);
  if (found != known.end()) return found->second;
  Declaration declaration;
  component.declare(declaration);
  std::set<int> nodes;
  if (!declaration.passive) nodes.insert(declaration.nodes.begin(), declaration.nodes.end());
  for (const Component* other : declaration.references)
    if (const std::set<int>& more = nodes_of(*other, known); !declaration.passive)
      nodes.insert(more.begin(), more.end());
  return known.emplace(&component, std::move(nodes)).first->second;
}

/// Returns whether only a node's rotations are held because the parts on it have no inertia: the support then has no
/// reaction.
/// @param held  directions held by constraints, or nullptr
bool holds_a_point_mass(const Node& node, const HeldDirections* held, const std::vector<const Component*>& acting) {
  const auto& freedom = node.freedom;
  if (held && held->holds_translations()) return false;
  return std::all_of(freedom.begin(), freedom.begin() + 3, [](Freedom f) { return f == Freedom::free; }) &&
         std::any_of(acting.begin(), acting.end(), [](const Component* c) { return c->type() == "point_mass"; });
}

}  // namespace

void add_supports(Model& model) {
  std::map<int, const HeldDirections*> constrained;
  for (const Member& member : model.members())
    if (const auto* held = dynamic_cast<const HeldDirections*>(member.component.get()))
      constrained.emplace(held->node(), held);
  std::map<int, int> held_by;  // the held node, for each node that is held or carried by a held one
  const int count = static_cast<int>(model.nodes().size());
  for (int k = 1; k < count; ++k) {
    const int top = model.root_carrier(k);
    const auto& freedom = model.node(top).freedom;
    if (top != 0 && !model.node(top).internal &&
        (constrained.contains(top) ||
         std::any_of(freedom.begin(), freedom.end(), [](Freedom f) { return f != Freedom::free; })))
      held_by[k] = top;
  }
  if (held_by.empty()) return;
  std::map<int, std::vector<int>> carried_by;
  for (const auto& [node, top] : held_by)
    if (node != top) carried_by[top].push_back(node);
  std::map<int, std::vector<const Component*>> acting;
  std::map<const Component*, std::set<int>> known;
  for (const Member& member : model.members()) {
    // These forces are part of the support's own.
    if (dynamic_cast<const HeldDirections*>(member.component.get())) continue;
    std::set<int> supports;
    for (const int node : nodes_of(*member.component, known))
      if (const auto held = held_by.find(node); held != held_by.end()) supports.insert(held->second);
    for (const int support : supports) acting[support].push_back(member.component.get());
  }
  for (auto& [node, components] : acting) {
    const auto held = constrained.find(node);
    if (holds_a_point_mass(model.node(node), held == constrained.end() ? nullptr : held->second, components)) continue;
    const std::string name = model.node(node).name;
    model.add(std::make_unique<Support>(name, node, std::move(carried_by[node]), std::move(components)),
              Entry{Section::supports, name});
  }
}

}  // namespace bielle::mechanism

#include "mechanism/session/results_rows.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>

#include "mechanism/math/so3.hpp"

namespace bielle::mechanism {

namespace {

std::size_t count_of(const std::vector<std::size_t>& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

void copy(const double* values, std::size_t count, double* to) { std::copy(values, values + count, to); }

bool alike(const std::vector<OutputField>& a, const std::vector<OutputField>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const OutputField& x, const OutputField& y) { return x.name == y.name && x.shape == y.shape; });
}

}  // namespace

ResultsRows::ResultsRows(const Model& model, Extent extent) : model_(model), extent_(extent) {
  add_nodes();
  add_chains();
  add_members();
  energy_ = size_;
  for (const char* name : {"kinetic", "elastic", "gravity"}) add_column(std::string("energy/") + name, {}, "J", "");
  add_column("energy/dissipated", {}, "J", "since the start of the analysis");
  add_column("energy/input", {}, "J", "of drives and loads, since the start of the analysis");
  add_column("energy/balance", {}, "J", "what is missing: stored - stored at the start - input + dissipated");
  solver_ = size_;
  add_column("solver/step", {}, "s", "");
  add_column("solver/newton_iterations", {}, "-", "");
  add_column("solver/error_estimate", {}, "-", "relative to the tolerance; 0 when the step is fixed");
  add_column("solver/worst_residual", {}, "-", "of all equations at the end of the step, relative to its tolerance");
  add_column("solver/worst_equation", {}, "-", "its line in /equations, from 0; -1: there was none");
  quaternions_.resize(nodes_.size());
}

std::size_t ResultsRows::add_column(const std::string& dataset, std::vector<std::size_t> shape,
                                    const std::string& units, const std::string& description, bool summed) {
  const auto [place, added] = column_of_.emplace(dataset, columns_.size());
  if (!added) {
    const ResultsColumn& column = columns_[place->second];
    if (summed && column.shape == shape) return column.begin;
    throw std::logic_error("two components record the results '" + dataset + "'");
  }
  const std::size_t begin = size_, size = count_of(shape);
  columns_.push_back({dataset, std::move(shape), units, description, begin, size});
  size_ += size;
  return begin;
}

void ResultsRows::add_attributes(const std::string& group,
                                 const std::vector<std::pair<std::string, std::string>>& attributes) {
  auto found = std::find_if(groups_.begin(), groups_.end(), [&](const ResultsGroup& g) { return g.name == group; });
  if (found == groups_.end()) found = groups_.insert(groups_.end(), {group, {}});
  for (const auto& [name, value] : attributes) {
    const auto same = [&, key = name](const auto& attribute) { return attribute.first == key; };
    if (std::none_of(found->attributes.begin(), found->attributes.end(), same))
      found->attributes.emplace_back(name, value);
  }
}

void ResultsRows::add_nodes() {
  constexpr int ground = 0;  // stands at the origin for ever
  for (int k = ground + 1; k < static_cast<int>(model_.nodes().size()); ++k) {
    const Node& node = model_.node(k);
    if (node.internal) continue;
    const std::string group = "nodes/" + node.name;
    if (!records(group)) continue;
    NodePlace place{k, 0, 0, nodes_.size(), true};
    place.position = add_column(group + "/position", {3}, "m", "inertial");
    place.rotation = add_column(group + "/rotation", {4}, "-", "unit quaternion w x y z: node axes -> inertial axes");
    add_column(group + "/velocity", {6}, "m/s, rad/s", "inertial translation; rotation in the node's axes");
    add_column(group + "/acceleration", {6}, "m/s^2, rad/s^2", "inertial translation; rotation in the node's axes");
    nodes_.push_back(place);
    add_attributes(group, {});
    if (node.carrier) add_attributes(group, {{"carrier", model_.node(*node.carrier).name}});
  }
}

void ResultsRows::add_chains() {
  for (const Chain& chain : model_.chains()) {
    if (!records(chain.group)) continue;
    const std::size_t count = chain.nodes.size();
    const std::size_t positions = add_column(chain.group + "/position", {count, 3}, "m", "inertial");
    const std::size_t rotations =
        add_column(chain.group + "/rotation", {count, 4}, "-", "unit quaternions w x y z: node axes -> inertial axes");
    for (std::size_t k = 0; k < count; ++k)
      nodes_.push_back({chain.nodes[k], positions + 3 * k, rotations + 4 * k, nodes_.size(), false});
  }
}

void ResultsRows::add_members() {
  std::vector<bool> placed(model_.members().size(), false);
  std::size_t largest = 0;
  for (std::size_t first = 0; first < placed.size(); ++first) {
    const Member& member = model_.members()[first];
    if (placed[first] || member.group.empty() || !records(member.group)) continue;
    // A component alone, or all the stacked ones of its group.
    std::vector<std::size_t> alike_members = {first};
    const std::vector<OutputField> fields = member.component->output_fields();
    for (std::size_t k = first + 1; member.stacked && k < placed.size(); ++k) {
      const Member& other = model_.members()[k];
      if (!other.stacked || other.group != member.group) continue;
      if (!alike(other.component->output_fields(), fields))
        throw std::logic_error("the stacked components of '" + member.group + "' record different results");
      alike_members.push_back(k);
    }
    std::vector<std::size_t> begins;
    for (const OutputField& field : fields) {
      std::vector<std::size_t> shape = field.shape;
      if (member.stacked) shape.insert(shape.begin(), alike_members.size());
      begins.push_back(
          add_column(member.group + "/" + field.name, std::move(shape), field.units, field.description, field.summed));
    }
    for (std::size_t row = 0; row < alike_members.size(); ++row) {
      MemberPlace place{alike_members[row], {}};
      std::size_t total = 0;
      for (std::size_t f = 0; f < fields.size(); ++f) {
        place.fields.push_back({begins[f] + row * fields[f].size(), fields[f].size(), fields[f].summed});
        total += fields[f].size();
      }
      largest = std::max(largest, total);
      placed[place.member] = true;
      members_.push_back(std::move(place));
    }
    add_attributes(member.group, {{"type", member.component->type()}});
    add_attributes(member.group, member.component->attributes());
  }
  output_.resize(largest);
}

void ResultsRows::exchange(Archive& archive) {
  for (Eigen::Vector4d& quaternion : quaternions_) archive(quaternion);
  archive(quaternions_known_);
}

const ResultsColumn* ResultsRows::find(const std::string& dataset) const {
  const auto place = column_of_.find(dataset);
  return place == column_of_.end() ? nullptr : &columns_[place->second];
}

void ResultsRows::fill(const State& state, const std::vector<Slots>& slots, const Environment& environment,
                       const StepRecord& step, double* values) {
  for (const NodePlace& place : nodes_) {
    const NodeState& node = state.nodes[static_cast<std::size_t>(place.node)];
    Eigen::Vector4d& before = quaternions_[place.quaternion];
    Eigen::Vector4d quaternion = quaternion_of(node.R);
    if (quaternions_known_ && before.dot(quaternion) < 0) quaternion = -quaternion;
    before = quaternion;
    fill_node(place, node, quaternion, values);
  }
  quaternions_known_ = true;
  for (const MemberPlace& place : members_)
    for (const FieldPlace& field : place.fields)
      if (field.summed) std::fill_n(values + field.begin, field.size, 0.0);
  for (const MemberPlace& place : members_) fill_member(place, state, slots, environment, output_.data(), values);
  fill_step(step, values);
}

std::vector<double> ResultsRows::read(const ResultsColumn& column, const State& state, const std::vector<Slots>& slots,
                                      const Environment& environment, const StepRecord& step) const {
  std::vector<double> row(size_), output(output_.size());
  const std::size_t end = column.begin + column.size;
  const auto within = [&](std::size_t begin, std::size_t size) { return begin < end && begin + size > column.begin; };
  for (const NodePlace& place : nodes_) {
    const std::size_t rates = place.rates ? 12 : 0;
    if (!within(place.position, 3) && !within(place.rotation, 4 + rates)) continue;
    const NodeState& node = state.nodes[static_cast<std::size_t>(place.node)];
    fill_node(place, node, quaternion_of(node.R), row.data());
  }
  for (const MemberPlace& place : members_)
    if (std::any_of(place.fields.begin(), place.fields.end(),
                    [&](const FieldPlace& field) { return within(field.begin, field.size); }))
      fill_member(place, state, slots, environment, output.data(), row.data());
  fill_step(step, row.data());
  return {row.begin() + static_cast<std::ptrdiff_t>(column.begin), row.begin() + static_cast<std::ptrdiff_t>(end)};
}

void ResultsRows::fill_member(const MemberPlace& place, const State& state, const std::vector<Slots>& slots,
                              const Environment& environment, double* output, double* values) const {
  if (place.fields.empty()) return;
  const LocalState local(state, slots[place.member], environment);
  model_.members()[place.member].component->write_output(local, output);
  for (const FieldPlace& field : place.fields) {
    double* to = values + field.begin;
    if (field.summed)
      std::transform(output, output + field.size, to, to, std::plus<>());
    else
      copy(output, field.size, to);
    output += field.size;
  }
}

void ResultsRows::fill_step(const StepRecord& step, double* values) const {
  const Energy& energy = step.energy;
  const double energies[] = {energy.kinetic,     energy.elastic, energy.gravity,
                             energy.dissipation, energy.input,   step.balance};
  copy(energies, 6, values + energy_);
  const double solver[] = {step.step, static_cast<double>(step.newton_iterations), step.error_estimate,
                           step.worst_residual, static_cast<double>(step.worst_equation)};
  copy(solver, std::size(solver), values + solver_);
}

void ResultsRows::fill_node(const NodePlace& place, const NodeState& node, const Eigen::Vector4d& quaternion,
                            double* values) {
  copy(node.x.data(), 3, values + place.position);
  copy(quaternion.data(), 4, values + place.rotation);
  if (!place.rates) return;
  double* rates = values + place.rotation + 4;
  copy(node.v.data(), 3, rates);
  copy(node.Omega.data(), 3, rates + 3);
  copy(node.a.data(), 3, rates + 6);
  copy(node.Omegadot.data(), 3, rates + 9);
}

}  // namespace bielle::mechanism

#include "mechanism/results/results_rows.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

#include "mechanism/math/so3.hpp"
#include "mechanism/model/mesh_fields.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {

namespace {

void copy(const double* values, std::size_t count, double* to) { std::copy(values, values + count, to); }

std::vector<double> rates(const Vector3& translation, const Vector3& rotation) {
  return {translation.x(), translation.y(), translation.z(), rotation.x(), rotation.y(), rotation.z()};
}

bool outputs_together(const Member& member) {
  const MeshFields* mesh = std::as_const(*member.component).mesh_fields();
  return mesh && mesh->outputs_together();
}

}  // namespace

const char* layout_name(ResultsLayout layout) { return layout == ResultsLayout::named ? "named" : "stacked"; }

ResultsRows::ResultsRows(const Model& model, Extent extent)
    : kinds_(model, extent == Extent::all), model_(model), activities_(model) {
  add_node_places();
  add_together();
  std::size_t largest = 0;
  for (const ResultsKind& kind : kinds_.kinds())
    for (const ResultsPart& part : kind.parts) {
      std::size_t total = 0;
      for (const ResultsTarget& target : part) total += target.size;
      largest = std::max(largest, total);
    }
  output_.resize(largest);
  add_totals();
  quaternions_.resize(nodes_.size());
}

void ResultsRows::add_node_places() {
  for (const ResultsEntry& entry : kinds_.entries()) {
    const ResultsKind& kind = kinds_.kinds()[entry.kind];
    const auto begin = [&](std::size_t field) {
      return kind.fields[field].begin + entry.number * kind.fields[field].size;
    };
    for (std::size_t k = 0; k < entry.nodes.size(); ++k) {
      const bool rates = entry.entry.section == Section::nodes;
      nodes_.push_back(
          {entry.nodes[k], begin(0) + 3 * k, begin(1) + 4 * k, rates ? begin(2) : 0, rates ? begin(3) : 0});
    }
  }
}

void ResultsRows::add_together() {
  for (const ResultsEntry& entry : kinds_.entries()) {
    const ResultsKind& kind = kinds_.kinds()[entry.kind];
    for (std::size_t p = 0; p < kind.parts.size(); ++p) {
      const ResultsPart& part = kind.parts[p];
      const std::size_t member = entry.members[p];
      if (!outputs_together(model_.members()[member])) continue;
      Together outputs{member, &part, {}, true, 0};
      for (const ResultsTarget& target : part) {
        const ResultsField& field = kind.fields[target.field];
        outputs.places.push_back(field.begin + entry.number * field.size + target.offset);
        outputs.adjoining = outputs.adjoining && outputs.places.back() == outputs.places.front() + outputs.size;
        outputs.size += target.size;
      }
      together_.push_back(std::move(outputs));
    }
  }
}

void ResultsRows::add_totals() {
  size_ = kinds_.size();
  const auto add = [&](const char* dataset, const char* units, const char* description) {
    totals_.push_back({dataset, {}, units, description, size_++, 1});
  };
  for (const char* dataset : {"energy/kinetic", "energy/elastic", "energy/gravity"}) add(dataset, "J", "");
  add("energy/dissipated", "J", "since the start of the analysis");
  add("energy/input", "J", "of drives and loads, since the start of the analysis");
  add("energy/balance", "J", "what is missing: stored - stored at the start - input + dissipated");
  add("solver/step", "s", "");
  add("solver/newton_iterations", "-", "");
  add("solver/error_estimate", "-", "relative to the tolerance; 0 when the step is fixed");
  add("solver/worst_residual", "-", "of all equations at the end of the step, relative to its tolerance");
  add("solver/worst_equation", "-", "its line in /equations, from 0; -1: there was none");
}

std::vector<ResultsColumn> ResultsRows::columns(ResultsLayout layout) const {
  std::vector<ResultsColumn> columns;
  if (layout == ResultsLayout::named) {
    columns.reserve(kinds_.datasets() + totals_.size());
    for (const ResultsEntry& entry : kinds_.entries())
      for (const ResultsField& field : kinds_.kinds()[entry.kind].fields)
        columns.push_back({kinds_.dataset(entry, field), field.shape, field.units, field.description,
                           field.begin + entry.number * field.size, field.size});
  } else {
    for (const ResultsKind& kind : kinds_.kinds())
      for (const ResultsField& field : kind.fields) {
        const std::size_t count = kind.entries.size();
        std::vector<std::size_t> shape = field.shape;
        shape.insert(shape.begin(), count);
        columns.push_back({results_path({kind.section, kind.name}) + "/" + field.name, std::move(shape), field.units,
                           field.description, field.begin, count * field.size});
      }
  }
  columns.insert(columns.end(), totals_.begin(), totals_.end());
  return columns;
}

std::optional<ResultsColumn> ResultsRows::find(const std::string& dataset) const {
  for (const ResultsColumn& total : totals_)
    if (total.dataset == dataset) return total;
  const auto found = kinds_.find(dataset);
  if (!found) return std::nullopt;
  const auto& [entry, number] = *found;
  const ResultsField& field = kinds_.kinds()[entry->kind].fields[number];
  return ResultsColumn{dataset,   field.shape, field.units, field.description, field.begin + entry->number * field.size,
                       field.size};
}

void ResultsRows::exchange(Archive& archive) {
  for (Eigen::Vector4d& quaternion : quaternions_) archive(quaternion);
  archive(quaternions_known_);
}

void ResultsRows::fill(const State& state, const std::vector<Slots>& slots, const Environment& environment,
                       const StepRecord& step, double* values) {
  const ResultsInstant instant{&state, &slots, &environment, &step};
  fill({&instant, 1}, values);
}

void ResultsRows::fill(std::span<const ResultsInstant> instants, double* values) {
  for (std::size_t k = 0; k < instants.size(); ++k) fill_apart(instants[k], values + k * size_);
  for (const Together& outputs : together_) fill_together(outputs, instants, values);
}

void ResultsRows::fill_together(const Together& outputs, std::span<const ResultsInstant> instants, double* values) {
  locals_.clear();
  targets_.clear();
  if (!outputs.adjoining) outputs_.resize(instants.size() * outputs.size);
  for (std::size_t k = 0; k < instants.size(); ++k) {
    locals_.emplace_back(*instants[k].state, (*instants[k].slots)[outputs.member], *instants[k].environment);
    targets_.push_back(outputs.adjoining ? values + k * size_ + outputs.places.front()
                                         : outputs_.data() + k * outputs.size);
  }
  std::as_const(*model_.members()[outputs.member].component).mesh_fields()->write_outputs(locals_, targets_);
  if (outputs.adjoining) return;
  for (std::size_t k = 0; k < instants.size(); ++k) {
    const double* from = targets_[k];
    for (std::size_t t = 0; t < outputs.places.size(); ++t) {
      const std::size_t count = (*outputs.part)[t].size;
      copy(from, count, values + k * size_ + outputs.places[t]);
      from += count;
    }
  }
}

void ResultsRows::fill_apart(const ResultsInstant& instant, double* values) {
  const State& state = *instant.state;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const NodePlace& place = nodes_[k];
    const NodeState& node = state.nodes[static_cast<std::size_t>(place.node)];
    Eigen::Vector4d quaternion = quaternion_of(node.R);
    if (quaternions_known_ && quaternions_[k].dot(quaternion) < 0) quaternion = -quaternion;
    quaternions_[k] = quaternion;
    copy(node.x.data(), 3, values + place.position);
    copy(quaternion.data(), 4, values + place.rotation);
    if (place.velocity == 0) continue;
    copy(node.v.data(), 3, values + place.velocity);
    copy(node.Omega.data(), 3, values + place.velocity + 3);
    copy(node.a.data(), 3, values + place.acceleration);
    copy(node.Omegadot.data(), 3, values + place.acceleration + 3);
  }
  quaternions_known_ = true;
  for (const ResultsKind& kind : kinds_.kinds()) {
    for (const ResultsField& field : kind.fields)
      if (field.summed) std::fill_n(values + field.begin, kind.entries.size() * field.size, 0.0);
    for (const std::size_t place : kind.entries) {
      const ResultsEntry& entry = kinds_.entries()[place];
      const auto to = [&](const ResultsTarget& target) {
        const ResultsField& field = kind.fields[target.field];
        return values + field.begin + entry.number * field.size + target.offset;
      };
      for (std::size_t p = 0; p < kind.parts.size(); ++p)
        if (!outputs_together(model_.members()[entry.members[p]]))
          write_member(entry.members[p], kind.parts[p], state, *instant.slots, *instant.environment, output_.data(),
                       to);
    }
  }
  fill_totals(*instant.step, values + kinds_.size());
}

std::vector<double> ResultsRows::read(const ResultsColumn& column, const State& state, const std::vector<Slots>& slots,
                                      const Environment& environment, const StepRecord& step) const {
  if (const auto found = kinds_.find(column.dataset))
    return read_entry(*found->first, found->second, state, slots, environment);
  std::vector<double> totals(totals_.size());
  fill_totals(step, totals.data());
  return {totals.at(column.begin - kinds_.size())};
}

std::vector<double> ResultsRows::read_entry(const ResultsEntry& entry, std::size_t field, const State& state,
                                            const std::vector<Slots>& slots, const Environment& environment) const {
  const ResultsKind& kind = kinds_.kinds()[entry.kind];
  const auto node_at = [&](int k) -> const NodeState& { return state.nodes[static_cast<std::size_t>(k)]; };
  if (entry.entry.section == Section::nodes && field > 1) {
    const NodeState& node = node_at(entry.nodes.front());
    return field == 2 ? rates(node.v, node.Omega) : rates(node.a, node.Omegadot);
  }
  std::vector<double> values, output(output_.size());
  if (!entry.nodes.empty() && field < 2) {
    for (const int k : entry.nodes) {
      const Eigen::Vector4d quaternion = quaternion_of(node_at(k).R);
      const double* begin = field == 0 ? node_at(k).x.data() : quaternion.data();
      values.insert(values.end(), begin, begin + (field == 0 ? 3 : 4));
    }
    return values;
  }
  values.resize(kind.fields[field].size);
  const auto to = [&](const ResultsTarget& target) {
    return target.field == field ? values.data() + target.offset : nullptr;
  };
  for (std::size_t p = 0; p < kind.parts.size(); ++p) {
    const auto wanted = [&](const ResultsTarget& target) { return target.field == field; };
    if (std::any_of(kind.parts[p].begin(), kind.parts[p].end(), wanted))
      write_member(entry.members[p], kind.parts[p], state, slots, environment, output.data(), to);
  }
  return values;
}

/// Writes the outputs of a released member: positions and rates as if it acted, forces zero. A member that cannot be
/// evaluated where it is now (a contact whose bodies have passed through each other) has no positions; NaN is written.
void ResultsRows::write_released(std::size_t member, const LocalState& local, double* output) const {
  const Component& component = *model_.members()[member].component;
  const std::vector<OutputField> fields = component.output_fields();
  try {
    component.write_output(local, output);
  } catch (const ComputationError&) {
    double* values = output;
    for (const OutputField& field : fields)
      values = std::fill_n(values, field.size(), std::numeric_limits<double>::quiet_NaN());
  }
  for (const OutputField& field : fields) {
    if (are_units_of_forces(field.units)) std::fill_n(output, field.size(), 0.0);
    output += field.size();
  }
}

template <class To>
void ResultsRows::write_member(std::size_t member, const ResultsPart& part, const State& state,
                               const std::vector<Slots>& slots, const Environment& environment, double* output,
                               const To& to) const {
  if (part.empty()) return;
  const LocalState local(state, slots[member], environment);
  if (activities_.is_active(state, slots, member))
    model_.members()[member].component->write_output(local, output);
  else
    write_released(member, local, output);
  for (const ResultsTarget& target : part) {
    if (double* values = to(target)) {
      if (target.summed)
        std::transform(output, output + target.size, values, values, std::plus<>());
      else
        copy(output, target.size, values);
    }
    output += target.size;
  }
}

void ResultsRows::fill_totals(const StepRecord& step, double* values) {
  const Energy& energy = step.energy;
  const double totals[] = {energy.kinetic,
                           energy.elastic,
                           energy.gravity,
                           energy.dissipation,
                           energy.input,
                           step.balance,
                           step.step,
                           static_cast<double>(step.newton_iterations),
                           step.error_estimate,
                           step.worst_residual,
                           static_cast<double>(step.worst_equation)};
  copy(totals, std::size(totals), values);
}

}  // namespace bielle::mechanism

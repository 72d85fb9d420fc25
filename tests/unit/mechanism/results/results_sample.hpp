// A small model whose results have known values in every place.
#pragma once

#include <string>
#include <vector>

#include "mechanism/model/model.hpp"
#include "mechanism/results/results_file.hpp"

namespace bielle::test {

/// Records numbers that tell component, field and time: 1000 id + 10 (index in the row) + time.
class NumberedComponent : public mechanism::Component {
 public:
  NumberedComponent(const std::string& type, const std::string& name, int id,
                    std::vector<mechanism::OutputField> fields)
      : Component(type, name), id_(id), fields_(std::move(fields)) {}
  void declare(mechanism::Declaration&) const override {}
  void add_residual(const mechanism::LocalState&, Eigen::Ref<mechanism::VectorX>) const override {}
  void add_tangent(const mechanism::LocalState&, mechanism::LocalTangent&) const override {}
  std::vector<mechanism::OutputField> output_fields() const override { return fields_; }
  void write_output(const mechanism::LocalState& state, double* values) const override {
    int index = 0;
    for (const mechanism::OutputField& field : fields_)
      for (std::size_t k = 0; k < field.size(); ++k) *values++ = 1000 * id_ + 10 * index++ + state.time();
  }
  std::vector<std::pair<std::string, std::string>> attributes() const override { return {{"id", std::to_string(id_)}}; }

 private:
  int id_;
  std::vector<mechanism::OutputField> fields_;
};

/// Nodes ground, pin, inner (internal) and tip (carried by pin); joint main; beam shaft of two stacked elements with a
/// chain; a component that records nothing.
struct ResultsSample {
  mechanism::Model model;
  std::vector<mechanism::Slots> slots;
  mechanism::State state;

  ResultsSample() {
    using mechanism::OutputField;
    const mechanism::Entry joint{mechanism::Section::joints, "main"}, shaft{mechanism::Section::elements, "shaft"};
    model.title = "a sample";
    add_node("pin", false);
    add_node("inner", true);
    add_node("tip", false);
    model.node(3).carrier = 1;
    add("hinge", "main", 1, joint, {{"coordinate", {1}, "rad", "of the hinge"}, {"reaction", {6}, "N, N m", ""}});
    for (int id : {2, 3})
      add("beam", "shaft", id, shaft, {{"strain", {6}, "-", ""}, {"energy", {}, "J", ""}},
          mechanism::Recorded::stacked);
    model.add_within(std::make_unique<NumberedComponent>("drive", "motor", 4,
                                                         std::vector<OutputField>{{"drive_force", {1}, "N m", ""}}),
                     {mechanism::Section::drives, "motor"}, joint);
    add("load", "weight", 5, {mechanism::Section::loads, "weight"}, {{"never", {}, "-", ""}}, mechanism::Recorded::no);
    model.add_chain(shaft, {1, 2, 3});
    state.nodes.resize(4);
    slots.resize(model.members().size());
  }

  /// State number `step`: time 0.5 step, position of node k (k, step, 0), rates from 1 to 12.
  void move_to(int step) {
    state.time = 0.5 * step;
    for (int k = 0; k < 4; ++k) {
      mechanism::NodeState& node = state.nodes[static_cast<std::size_t>(k)];
      node.x = {1.0 * k, 1.0 * step, 0};
      node.v = {1, 2, 3};
      node.Omega = {4, 5, 6};
      node.a = {7, 8, 9};
      node.Omegadot = {10, 11, 12};
    }
  }
  void record(mechanism::ResultsFile& results, int step) {
    move_to(step);
    mechanism::StepRecord row;
    row.energy.kinetic = 1.0 * step;
    row.energy.elastic = 2.0 * step;
    row.energy.gravity = 3.0 * step;
    row.energy.dissipation = 4.0 * step;
    row.energy.input = 5.0 * step;
    row.balance = 6.0 * step;
    row.step = 0.5;
    row.newton_iterations = 3;
    row.error_estimate = 0.25;
    results.record(state, slots, model.environment, row);
  }

 private:
  void add_node(const std::string& name, bool internal) {
    mechanism::Node node;
    node.name = name;
    node.internal = internal;
    model.add_node(node);
  }
  void add(const std::string& type, const std::string& name, int id, const mechanism::Entry& entry,
           std::vector<mechanism::OutputField> fields, mechanism::Recorded recorded = mechanism::Recorded::alone) {
    model.add(std::make_unique<NumberedComponent>(type, name, id, std::move(fields)), entry, recorded);
  }
};

}  // namespace bielle::test

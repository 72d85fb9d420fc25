#include "mechanism/elements/control/state_reader.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "mechanism/elements/control/block_reading.hpp"
#include "mechanism/elements/control/delay_reader.hpp"
#include "mechanism/elements/control/sampled_reader.hpp"
#include "mechanism/elements/control/state_equation.hpp"
#include "mechanism/elements/control/state_output.hpp"
#include "mechanism/measures/read_measure.hpp"

namespace bielle::mechanism {
namespace {

/// The contents of an entry.
struct StateSetup {
  std::string type;   ///< "filter"
  std::string about;  ///< description, before the inputs: "first-order filter, 0.01 s, of"
  LinearBlock block{};
  std::vector<YamlValue> inputs{};
  std::vector<std::string> unknowns{};              ///< names of the unknowns, for messages
  VectorX start{};                                  ///< start values of the unknowns
  bool starts_at_rest = false;                      ///< whether a start at rest is used instead
  std::optional<std::vector<std::string>> units{};  ///< for each output, one for all, or as the input
  struct Output {
    std::string name;
    VectorX c, d;
    bool recorded;
  };
  std::vector<Output> outputs{};
};

/// Returns whether the value is `start: equilibrium`.
bool says_equilibrium(const YamlValue& start) { return start.is_scalar() && start.text() == "equilibrium"; }

StateSetup read_rate(const std::string& name, const YamlValue& entry) {
  StateSetup setup{"state", "rate", integrator(), {entry.at("rate")}, {"value"}, VectorX::Zero(1)};
  setup.start[0] = entry.at("start").number();
  setup.outputs = {{name, VectorX::Ones(1), {}, true}};
  return setup;
}

StateSetup read_filter(const std::string& name, const YamlValue& entry) {
  if (entry.has("time_constant") == entry.has("frequency"))
    entry.fail(
        "a filter is of first order, with a `time_constant` [s], or of second order, with a `frequency` [Hz] and a "
        "`damping`: give one of the two");
  StateSetup setup{"filter", "", {}, {entry.at("filter")}, {"value"}, VectorX::Zero(1)};
  if (const auto time = entry.find("time_constant")) {
    if (const auto damping = entry.find("damping")) damping->fail("belongs to a filter with a `frequency`");
    const double T = time->number();
    setup.block = T > 0 ? first_order_filter(T) : no_filter();
    setup.about = fmt::format("first-order filter, {:.6g} s, of", T);
  } else {
    const double frequency = entry.at("frequency").number(), damping = entry.at("damping").number();
    setup.block = second_order_filter(frequency, damping);
    setup.about = fmt::format("second-order filter, {:.6g} Hz, damping {:.6g}, of", frequency, damping);
    setup.unknowns.emplace_back("rate/frequency");
    setup.start = VectorX::Zero(2);
  }
  for (Eigen::Index k = 0; k < setup.block.C.rows(); ++k)
    setup.outputs.push_back({k == 0 ? name : name + ".rate", setup.block.C.row(k).transpose(),
                             setup.block.D.isZero(0) ? VectorX() : VectorX(setup.block.D.row(k).transpose()), k == 0});
  const YamlValue start = entry.at("start");
  setup.starts_at_rest = says_equilibrium(start);
  if (!setup.starts_at_rest) setup.start[0] = start.number();
  return setup;
}

void name_unknowns(StateSetup& setup) {
  for (Eigen::Index k = 0; k < setup.block.A.rows(); ++k) setup.unknowns.push_back(fmt::format("x{}", k + 1));
}

StateSetup read_transfer_function(const std::string& name, const YamlValue& entry) {
  LinearBlock block =
      read_quotient(entry.at("transfer_function"), "s",
                    "such a function has derivatives of its input; add poles to the denominator (a filter)");
  StateSetup setup{"transfer_function", "", std::move(block), {entry.at("input")}, {}};
  setup.about = fmt::format("transfer function of order {} of", setup.block.A.rows());
  name_unknowns(setup);
  setup.start = VectorX::Zero(setup.block.A.rows());
  setup.outputs = {{name, setup.block.C.row(0).transpose(), setup.block.D.row(0).transpose(), true}};
  setup.starts_at_rest = entry.at("start").word() == "equilibrium";
  return setup;
}

StateSetup read_state_space(const std::string& name, const YamlValue& entry) {
  const YamlValue matrices = entry.at("state_space");
  StateSetup setup{"state_space", "", {}, entry.at("inputs").items(), {}};
  const auto inputs = static_cast<Eigen::Index>(setup.inputs.size());
  if (inputs == 0) entry.at("inputs").fail("expected at least one input");
  setup.block = read_matrices(matrices, inputs);
  const Eigen::Index n = setup.block.A.rows(), outputs = setup.block.C.rows();
  setup.about = fmt::format("state space of order {} of", n);
  name_unknowns(setup);
  for (Eigen::Index k = 0; k < outputs; ++k)
    setup.outputs.push_back(
        {name_of_output(name, outputs, k), setup.block.C.row(k).transpose(), setup.block.D.row(k).transpose(), true});
  for (Eigen::Index k = 0; k < n; ++k)
    setup.outputs.push_back({fmt::format("{}.x{}", name, k + 1), VectorX::Unit(n, k), {}, false});
  setup.start = VectorX::Zero(n);
  const auto start = entry.find("start");
  setup.starts_at_rest = start && says_equilibrium(*start);
  if (!start || setup.starts_at_rest) return setup;
  if (!start->is_sequence() || static_cast<Eigen::Index>(start->size()) != n)
    start->fail(fmt::format("expected a list of {} numbers, one for each state, or equilibrium", n));
  setup.start = start->vector();
  return setup;
}

/// Reads units: one text, or a list with one for each of the recorded outputs.
void read_units(const YamlValue& entry, StateSetup& setup) {
  if (setup.type == "filter" && !entry.has("units")) return;
  const auto recorded =
      std::count_if(setup.outputs.begin(), setup.outputs.end(), [](const auto& output) { return output.recorded; });
  setup.units = read_block_units(entry.at("units"), static_cast<std::size_t>(recorded));
}

std::string per_second(const std::string& units) { return units == "-" ? "1/s" : units + "/s"; }

/// Returns the units of the k-th output.
std::string units_of_output(const StateSetup& setup, std::size_t k) {
  if (!setup.units || setup.units->empty()) return "";
  if (!setup.outputs[k].recorded && setup.type == "filter") return per_second(setup.units->front());
  if (!setup.outputs[k].recorded) return setup.units->size() == 1 ? setup.units->front() : "-";
  return setup.units->size() == 1 ? setup.units->front() : (*setup.units)[k];
}

/// Announces the outputs as measures.
void announce_outputs(const Entry& entry, const StateSetup& setup, const StateUnknowns& unknowns, Model& model) {
  for (std::size_t k = 0; k < setup.outputs.size(); ++k) {
    const StateSetup::Output& output = setup.outputs[k];
    const std::string units = units_of_output(setup, k);
    // The units of a filter are those of its input, which may itself depend on those of the filter.
    const std::optional<YamlValue> as_input = setup.units ? std::nullopt : std::optional(setup.inputs.front());
    model.announce_measure(output.name, [=, &unknowns, &model, inputs = setup.inputs] {
      References references;
      references.add(unknowns);
      std::vector<StateOutput::Through> through;
      for (std::size_t j = 0; j < inputs.size() && output.d.size() > 0; ++j)
        if (const double factor = output.d[static_cast<Eigen::Index>(j)]; factor != 0)
          through.push_back({factor, read_state_formula(inputs[j], {"t"}, model, references)});
      auto measure = std::make_unique<StateOutput>(output.name, unknowns, std::move(references), output.c,
                                                   std::move(through), units);
      StateOutput& added = *measure;
      model.add_measure_of(entry, std::move(measure), output.recorded);
      if (!as_input) return;
      const std::string of_input = units_of_formula(*as_input, model);
      added.set_units(output.recorded || of_input.empty() ? of_input : per_second(of_input));
    });
  }
}

/// `entry` is bound to the keys of its kind.
StateSetup read_setup(const std::string& name, const YamlValue& entry) {
  if (entry.has("rate")) return read_rate(name, entry);
  if (entry.has("filter")) return read_filter(name, entry);
  if (entry.has("transfer_function")) return read_transfer_function(name, entry);
  if (entry.has("state_space")) return read_state_space(name, entry);
  entry.fail(
      "a state needs a `rate`, or it is `sampled`, a `delay`, a `filter`, a `transfer_function` or a "
      "`state_space`");
}

}  // namespace

void read_state(const std::string& name, const YamlValue& entry, Model& model) {
  check_measure_name(name, entry, model);
  if (entry.has("sampled") || entry.has("period")) return read_sampled(name, entry, model);
  if (entry.has("delayed")) return read_delay(name, entry, model);
  StateSetup setup = read_setup(name, entry);
  read_units(entry, setup);
  std::optional<MatrixX> rest;
  if (setup.starts_at_rest) {
    rest = rest_of(setup.block);
    if (!rest)
      entry.at("start").fail(
          "this block has no equilibrium of its own: it integrates (a root of its denominator is zero, its A is "
          "singular)");
  }
  double scale = std::max(1.0, setup.start.cwiseAbs().maxCoeff());
  if (const auto given = entry.find("scale")) scale = given->number();
  const std::string units = setup.type == "state_space" || !setup.units ? "-" : setup.units->front();
  const Entry own{Section::states, name};
  auto& unknowns = static_cast<StateUnknowns&>(model.add(
      std::make_unique<StateUnknowns>(setup.type, name, setup.unknowns, setup.start, units, scale), own, Recorded::no));
  auto& equation = static_cast<StateEquation&>(model.add(
      std::make_unique<StateEquation>(unknowns, setup.block, std::move(rest), setup.about), own, Recorded::no));
  announce_outputs(own, setup, unknowns, model);
  model.when_read(Model::Stage::formulas, [&equation, &model, inputs = setup.inputs] {
    for (const YamlValue& input : inputs) equation.read_input(input, model);
  });
}

}  // namespace bielle::mechanism

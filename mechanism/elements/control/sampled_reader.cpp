#include "mechanism/elements/control/sampled_reader.hpp"

#include <algorithm>
#include <complex>
#include <memory>
#include <optional>
#include <utility>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "mechanism/elements/control/block_reading.hpp"
#include "mechanism/elements/control/sampled_block.hpp"
#include "mechanism/measures/read_measure.hpp"
#include "mechanism/reading/pid_gains.hpp"

namespace bielle::mechanism {
namespace {

const KeyTable& pid_keys() {
  using namespace keys;
  static const KeyTable table{
      "`pid`",
      "A PID controller of sampled values, its integral by the trapezoidal rule and without wind-up at its limits.",
      pid_gain_keys("output", "input")};
  return table;
}

/// Warns of a block whose states grow from instant to instant without any input.
LinearBlock watched(LinearBlock block, const YamlValue& value, const std::string& what) {
  double largest = 0;
  for (const std::complex<double>& root : block.A.eigenvalues()) largest = std::max(largest, std::abs(root));
  constexpr double rounding = 1e-4;  // triple roots on the unit circle (three integrators) have errors of 1e-5
  if (largest > 1 + rounding)
    value.warn(
        fmt::format("{} of magnitude {:.6g}: the block grows by this factor from instant to instant", what, largest));
  return block;
}

/// Reads the law of a block with this number of inputs.
std::unique_ptr<SampledLaw> read_law(const YamlValue& entry, Eigen::Index inputs, double period) {
  const auto pid = entry.find("pid"), function = entry.find("transfer_function"), matrices = entry.find("state_space");
  if (static_cast<int>(pid.has_value()) + function.has_value() + matrices.has_value() > 1)
    entry.fail("expected one of `pid`, `transfer_function` and `state_space`, or none: then the input itself is held");
  if (inputs != 1 && !matrices)
    entry.at("sampled").fail("a list of inputs belongs to a `state_space`; expected one formula");
  if (pid) return std::make_unique<SampledPid>(read_pid_gains(*pid), period);
  if (function) {
    LinearBlock block =
        watched(read_quotient(*function, "z", "such a function would need later samples; add powers of z"),
                function->at("denominator"), "the polynomial has a root");
    std::string about = fmt::format("sampled transfer function of order {} of", block.A.rows());
    return std::make_unique<SampledLinear>(std::move(block), std::move(about));
  }
  if (matrices) {
    LinearBlock block = watched(read_matrices(*matrices, inputs), matrices->at("A"), "the matrix has an eigenvalue");
    std::string about = fmt::format("sampled state space of order {} of", block.A.rows());
    return std::make_unique<SampledLinear>(std::move(block), std::move(about));
  }
  LinearBlock block{MatrixX(0, 0), MatrixX(0, 1), MatrixX(1, 0), MatrixX::Ones(1, 1)};
  return std::make_unique<SampledLinear>(std::move(block), "sampled");
}

SampleClock read_clock(const YamlValue& entry) {
  SampleClock clock;
  clock.period = entry.at("period").number();
  clock.first = entry.at("first").number();
  clock.delay = entry.at("delay").number();
  constexpr double most = 1e5;
  if (clock.delay > most * clock.period)
    entry.at("delay").fail(fmt::format(
        "more than {:.6g} samples would wait for its end: expected at most {:.6g} s, so many periods of {:.6g} s", most,
        most * clock.period, clock.period));
  return clock;
}

OutputStage read_stage(const YamlValue& entry) {
  OutputStage stage;
  stage.quantum = entry.at("quantum").number();
  const auto limit = entry.find("limit");
  if (!limit) return stage;
  if (!limit->is_sequence()) {
    stage.most = limit->number();
    stage.least = -stage.most;
    return stage;
  }
  if (limit->size() != 2) limit->fail("expected a number, or [lower, upper]");
  const YamlValue lower = limit->at(std::size_t{0}), upper = limit->at(std::size_t{1});
  if (!lower.is_null()) stage.least = lower.number();
  if (!upper.is_null()) stage.most = upper.number();
  if (!(stage.least < stage.most)) limit->fail("expected the lower limit first, and a range between the two");
  if (lower.is_null() && upper.is_null()) limit->fail("both ends are open: this is no limit");
  return stage;
}

/// Returns the held values before the first instant, one for each output.
VectorX read_held_start(const YamlValue& entry, Eigen::Index outputs) {
  const YamlValue start = entry.at("start");
  if (!start.is_sequence()) return VectorX::Constant(outputs, start.number());
  if (static_cast<Eigen::Index>(start.size()) != outputs)
    start.fail(fmt::format("expected a number, or a list of {}, one for each output", outputs));
  return start.vector();
}

}  // namespace

Key sampled_key() {
  using namespace keys;
  return {"sampled",
          {state_formula("any", {"t"}), list_of(state_formula("any", {"t"})).items_at_least(1)},
          required,
          "Formula of the input, which is evaluated at each instant of the block's clock; a list for a `state_space`."};
}

const KeyTable& sampled_keys() {
  using namespace keys;
  static const KeyTable table{
      "a sampled state", "A value that is computed at the instants of a clock, and keeps its value between them.", [] {
        const KeyForms end = {number("any"), null()};
        std::vector<Key> laws = {{"pid", nested(pid_keys), required, "Gains of a PID controller of the input."},
                                 transfer_function_key(),
                                 state_space_key()};
        for (Key& law : laws) law.presence = optional;
        return joined(
            {{sampled_key(),
              {"period", number("s").at_least(1e-9), required, "Time from one instant to the next."},
              {"first", number("s").non_negative(), otherwise("0"), "Time of the first instant."},
              {"delay", number("s").non_negative(), otherwise("0"),
               "Time from an instant to the change of the outputs; it may be longer than the period."}},
             std::move(laws),
             {{"quantum", number("any").non_negative(), otherwise("0"),
               "Outputs are rounded to whole multiples of it (before the limits); 0: they are not."},
              {"limit",
               {number("any").positive(), tuple({end, end})},
               optional,
               "Largest amount of the outputs, or their lower and upper limit, one of which may be open (`~`)."},
              {"start",
               {number("any"), list_of(number("any"))},
               otherwise("0"),
               "Value of the outputs before the first instant, or in analyses other than motions."},
              {"units",
               {text(), list_of(text())},
               computed("those of the input, '-' of a block"),
               "Recorded units; a list for several outputs."}}});
      }()};
  return table;
}

void read_sampled(const std::string& name, const YamlValue& entry, Model& model) {
  const YamlValue sampled = entry.at("sampled");
  if (sampled.is_map()) sampled.fail("expected a formula of the input, or a list of formulas");
  const std::vector<YamlValue> inputs = sampled.is_sequence() ? sampled.items() : std::vector<YamlValue>{sampled};
  const SampleClock clock = read_clock(entry);
  auto law = read_law(entry, static_cast<Eigen::Index>(inputs.size()), clock.period);
  const Eigen::Index outputs = law->outputs();
  const bool plain = law->states() == 0;
  const VectorX start = read_held_start(entry, outputs);
  std::optional<std::vector<std::string>> units;
  if (entry.has("units")) units = read_block_units(entry.at("units"), static_cast<std::size_t>(outputs));
  const Entry own{Section::states, name};
  auto& block = static_cast<SampledBlock&>(
      model.add(std::make_unique<SampledBlock>(name, clock, read_stage(entry), std::move(law)), own, Recorded::no));
  std::vector<std::string> names;
  for (Eigen::Index k = 0; k < outputs; ++k) {
    names.push_back(name_of_output(name, outputs, k));
    const std::string unit = !units ? "-" : units->size() == 1 ? units->front() : (*units)[static_cast<std::size_t>(k)];
    model.announce_measure(names.back(), [=, &model, of = names.back(), input = inputs.front()] {
      auto measure = std::make_unique<HeldValue>(of, start[k], unit);
      HeldValue& added = *measure;
      model.add_measure_of(own, std::move(measure), true);
      if (plain && !units) added.set_units(units_of_formula(input, model));
    });
  }
  model.when_read(Model::Stage::formulas, [&block, &model, inputs, names] {
    for (const std::string& each : names) block.add_output(*model.find_measure(each));
    for (const YamlValue& input : inputs) block.read_input(input, model);
  });
}

}  // namespace bielle::mechanism

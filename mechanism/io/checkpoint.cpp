#include "mechanism/io/checkpoint.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>

#include <fmt/format.h>

#include "mechanism/solvers/model_length.hpp"
#include "mechanism/system/system.hpp"
#include "reduce/common/hdf5_file.hpp"

namespace bielle::mechanism {
namespace {

const std::string root = "/checkpoints";

/// Of the numbers in a checkpoint: one more whenever what is exchanged with the Archive, or its order, changes.
constexpr int format = 3;

std::string analysis_name(int analysis) { return fmt::format("/analysis_{}", analysis); }

/// Calls `act` with every dataset below a group.
void for_each_dataset(const Hdf5File& file, const std::string& group,
                      const std::function<void(const std::string&)>& act) {
  for (const std::string& name : file.names_in(group)) {
    const std::string object = group + "/" + name;
    if (file.is_group(object))
      for_each_dataset(file, object, act);
    else
      act(object);
  }
}

/// A little off the start, and moving: what forces depend on shows.
State displaced(const System& system, const State& start) {
  const double length = model_length(start);
  State state = start;
  state.time = 0.01;
  const auto pattern = [](int size, double scale) {
    VectorX v(size);
    for (int i = 0; i < size; ++i) v[i] = scale * std::cos(1 + 2.4 * i);
    return v;
  };
  const int n = system.dofs();
  VectorX dq = pattern(n, 1e-3);
  for (int i = 0; i < n; ++i)
    if (system.kind(i) == Kind::translation) dq[i] *= length;
  system.displace(state, start, dq);
  system.set_rates(state, 100 * dq, 1e4 * dq);
  state.first_order *= 1.01;
  state.multiplier.setOnes();
  return state;
}

/// What a component's forces are in short.
std::string forces(const Component& component, const LocalState& state) {
  VectorX r = VectorX::Zero(state.slots().size());
  try {
    component.add_residual(state, r);
  } catch (const ComputationError&) {
    return "refuses";
  }
  std::string text = fmt::format("{:.10g}", r.norm());
  // What forces do not show yet: crossings to come, and times at which something begins.
  Declaration declaration;
  component.declare(declaration);
  if (!declaration.crossings.empty()) {
    VectorX values(static_cast<Eigen::Index>(declaration.crossings.size()));
    component.calc_crossings(state, values);
    for (const double value : values) text += fmt::format(" {:.10g}", value);
  }
  std::vector<double> times;
  component.add_break_points(times);
  for (const double time : times) text += fmt::format(" {:.10g}", time);
  return text;
}

/// The first thing of a model that differs between two fingerprints: "rigid_body 'rod'".
std::string difference(const std::string& one, const std::string& other) {
  std::istringstream lines(one), other_lines(other);
  std::string line, other_line;
  while (true) {
    const bool more = static_cast<bool>(std::getline(lines, line)),
               other_more = static_cast<bool>(std::getline(other_lines, other_line));
    if (more && other_more && line == other_line) continue;
    const std::string& differs = more ? line : other_line;
    const std::size_t quote = differs.rfind('\'');
    return quote == std::string::npos ? differs.substr(0, differs.find(' ')) : differs.substr(0, quote + 1);
  }
}

/// @throws InputError when a checkpoint with the fingerprint `found` cannot go on with the model of `wanted`
void check_fingerprint(const std::string& file, const std::string& found, const std::string& wanted) {
  if (found == wanted) return;
  const auto first_line = [](const std::string& text) { return text.substr(0, text.find('\n')); };
  if (first_line(found) != first_line(wanted))
    throw InputError(fmt::format(
        "{}: its checkpoints were written by another version of bielle-mechanism ({} in place of {}), which this one "
        "cannot go on from: run the model anew, or go on with the version that wrote them (`created_by` in the file)",
        file, first_line(found).rfind("checkpoint format", 0) == 0 ? first_line(found) : "no format",
        first_line(wanted)));
  throw InputError(
      fmt::format("{}: is of another model: {} differs; gravity, parameters, nodes, elements, joints, drives and loads "
                  "have to be the same",
                  file, difference(wanted, found)));
}

}  // namespace

std::string fingerprint(const Model& model) {
  const System system(model);
  const State start = system.start(0);
  std::string text = fmt::format(
      "checkpoint format {}\nstate nodes {}, dofs {}, first-order unknowns {}, multipliers {}, memory {}\n", format,
      start.nodes.size(), system.dofs(), system.first_orders(), system.multipliers(), start.memory.size());
  const auto numbers = [](const auto& matrix) {
    std::string list;
    for (const double value : matrix.reshaped()) list += fmt::format(" {}", value);
    return list;
  };
  text += fmt::format("gravity{}\n", numbers(model.environment.gravity));
  for (const auto& [name, value] : model.parameters) text += fmt::format("parameter '{}' {}\n", name, value);
  for (const Node& node : model.nodes())
    text += fmt::format("node '{}'{}{}\n", node.name, numbers(node.frame.x), numbers(node.frame.R));
  const State probe = displaced(system, start);
  for (std::size_t m = 0; m < model.members().size(); ++m) {
    const Component& component = *model.members()[m].component;
    text += fmt::format("{} '{}' {}\n", component.type(), component.name(),
                        forces(component, LocalState(probe, system.slots()[m], model.environment)));
  }
  return text;
}

Checkpoint read_checkpoint(const std::string& results_path, const Model& model) {
  const Hdf5File file = Hdf5File::open(results_path);
  Checkpoint checkpoint;
  if (file.has(root))
    for (int k = 1; file.has(analysis_name(k)); ++k)
      if (const std::string rows = root + analysis_name(k) + "/rows"; file.has(rows) && file.shape(rows)[0] > 0)
        checkpoint.analysis = k;
  if (checkpoint.analysis == 0)
    throw InputError(
        fmt::format("{}: holds no checkpoint to go on from; a run writes them with `output: {{checkpoint: "
                    "STEPS}}`, when it is interrupted and at the end of each dynamic analysis",
                    results_path));
  check_fingerprint(results_path, file.read_text(root + "/model"), fingerprint(model));
  const std::string group = root + analysis_name(checkpoint.analysis);
  const std::vector<double> rows = file.read(group + "/rows");
  checkpoint.rows = static_cast<std::size_t>(rows.back());
  const Shape shape = file.shape(group + "/state");
  const std::vector<double> states = file.read(group + "/state");
  const auto begin = states.begin() + static_cast<std::ptrdiff_t>((rows.size() - 1) * shape[1]);
  checkpoint.values.assign(begin, begin + static_cast<std::ptrdiff_t>(shape[1]));
  return checkpoint;
}

void append_checkpoint(Hdf5File& file, const Model& model, const Checkpoint& checkpoint) {
  const std::string group = root + analysis_name(checkpoint.analysis), state = group + "/state", rows = group + "/rows";
  if (!file.has(root + "/model")) file.write_text(root + "/model", fingerprint(model));
  if (!file.has(rows)) {
    constexpr std::size_t together = 16;
    file.create_rows(state, {checkpoint.values.size()}, "-", "all that a run goes on from", together);
    file.create_rows(rows, {}, "-", "of the analysis's results that belong to each checkpoint", 1024);
  }
  file.append_rows(state, checkpoint.values);
  file.flush();
  const auto count = static_cast<double>(checkpoint.rows);
  file.append_rows(rows, {&count, 1});
  file.flush();
}

void rewind_to(Hdf5File& file, const Checkpoint& checkpoint) {
  for (int k = checkpoint.analysis + 1; file.has(analysis_name(k)); ++k) file.remove(analysis_name(k));
  const std::string group = analysis_name(checkpoint.analysis);
  // The times first: what they do not count does not exist.
  file.truncate_rows(group + "/time", checkpoint.rows);
  file.flush();
  // Events are no rows over time; how many there were stands in the checkpoint (ResultsFile::exchange).
  // What an analysis says at its end (`reaction_unique`) it will say again.
  std::vector<std::string> of_the_end;
  for_each_dataset(file, group, [&](const std::string& dataset) {
    if (file.shape(dataset).empty())
      of_the_end.push_back(dataset);
    else if (dataset.rfind(group + "/events/", 0) != 0)
      file.truncate_rows(dataset, checkpoint.rows);
  });
  for (const std::string& dataset : of_the_end) file.remove(dataset);
  const std::string checkpoints = root + group;
  file.truncate_rows(checkpoints + "/state", file.shape(checkpoints + "/rows")[0]);
  file.flush();
}

}  // namespace bielle::mechanism

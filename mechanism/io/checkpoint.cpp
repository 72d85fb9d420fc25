#include "mechanism/io/checkpoint.hpp"

#include <algorithm>
#include <functional>

#include <fmt/format.h>

#include "mechanism/system/model.hpp"
#include "reduce/common/hdf5_file.hpp"

namespace bielle::mechanism {
namespace {

const std::string root = "/checkpoints";

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

}  // namespace

std::string fingerprint(const Model& model) {
  std::string text;
  const auto numbers = [](const auto& matrix) {
    std::string list;
    for (const double value : matrix.reshaped()) list += fmt::format(" {}", value);
    return list;
  };
  text += fmt::format("gravity{}\n", numbers(model.environment.gravity));
  for (const auto& [name, value] : model.parameters) text += fmt::format("parameter {} {}\n", name, value);
  for (const Node& node : model.nodes())
    text += fmt::format("node {}{}{}\n", node.name, numbers(node.frame.x), numbers(node.frame.R));
  for (const Member& member : model.members())
    text += fmt::format("{} {}\n", member.component->type(), member.component->name());
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
  if (file.read_text(root + "/model") != fingerprint(model))
    throw InputError(fmt::format(
        "{}: is of another model: gravity, parameters, nodes, elements, joints, drives and loads have to be the same",
        results_path));
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
  for_each_dataset(file, group, [&](const std::string& dataset) { file.truncate_rows(dataset, checkpoint.rows); });
  const std::string checkpoints = root + group;
  file.truncate_rows(checkpoints + "/state", file.shape(checkpoints + "/rows")[0]);
  file.flush();
}

}  // namespace bielle::mechanism

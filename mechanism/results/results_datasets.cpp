#include "mechanism/results/results_datasets.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include <fmt/format.h>

#include "reduce/common/files/hdf5_file.hpp"

namespace bielle::mechanism {

namespace {

/// A dataset needs some 0.12 ms, 40 kB of memory and 3 kB of the file (performance_mechanism_results): this limit
/// corresponds to half a second and 160 MB.
constexpr std::size_t most_named_datasets = 4000;

std::string units_or_number(const std::string& units) { return units.empty() ? "-" : units; }

/// Returns the path of a kind in the stacked layout: "joints/hinge".
std::string place_of(const ResultsKind& kind) { return results_path({kind.section, kind.name}); }

std::vector<std::string> names_of(const ResultsKind& kind, const ResultsKinds& kinds) {
  std::vector<std::string> names;
  names.reserve(kind.entries.size());
  for (const std::size_t entry : kind.entries) names.push_back(kinds.entries()[entry].entry.name);
  return names;
}

void describe_named(Hdf5File& file, const std::string& group, const ResultsKinds& kinds) {
  for (const ResultsEntry& entry : kinds.entries()) {
    if (entry.entry.section == Section::measures) continue;  // these are single datasets
    const std::string place = group + "/" + results_path(entry.entry);
    file.make_group(place);  // groups exist also for entries without records
    for (const auto& [name, value] : kinds.attributes(entry)) file.write_attribute(place, name, value);
  }
}

/// Writes the names of a kind's entries, and their attributes as one list for each.
void describe_kind(Hdf5File& file, const std::string& group, const ResultsKind& kind, const ResultsKinds& kinds) {
  const std::string place = group + "/" + place_of(kind);
  file.make_group(place);
  file.write_attribute(place, "type", kind.type);
  file.write_names(place + "/name", names_of(kind, kinds));
  std::map<std::string, std::vector<std::string>> lists;
  for (const std::size_t number : kind.entries) {
    const ResultsEntry& entry = kinds.entries()[number];
    for (auto& [name, value] : kinds.attributes(entry)) {
      if (name == "type") continue;
      std::vector<std::string>& list = lists[name];
      list.resize(kind.entries.size());
      list[entry.number] = value;
    }
  }
  for (const auto& [name, list] : lists) file.write_names(place + "/attributes/" + name, list);
}

[[noreturn]] void fail_missing(const Hdf5File& file, const std::string& name) {
  throw InputError(
      fmt::format("{}: '{}' is not in it: a run goes on with the outputs that it began with", file.path(), name));
}

[[noreturn]] void fail_left_out(const Hdf5File& file, const Entry& entry) {
  throw InputError(
      fmt::format("{}: holds '{}', which `only` leaves out now: a run goes on with the outputs that it began with",
                  file.path(), results_path(entry)));
}

constexpr Section chosen_by_only[] = {Section::nodes, Section::joints, Section::elements};

void check_named(const Hdf5File& file, const std::string& group, const Model& model,
                 const std::vector<ResultsColumn>& columns) {
  for (const ResultsColumn& column : columns)
    if (const std::string dataset = group + "/" + column.dataset; !file.has(dataset)) fail_missing(file, dataset);
  for (const Section section : chosen_by_only) {
    const std::string place = group + "/" + section_name(section);
    if (!file.has(place)) continue;
    for (const std::string& name : file.names_in(place))
      if (!model.records({section, name})) fail_left_out(file, {section, name});
  }
}

void check_stacked(const Hdf5File& file, const std::string& group, const Model& model, const ResultsRows& rows,
                   const std::vector<ResultsColumn>& columns) {
  for (const Section section : chosen_by_only) {
    const std::string place = group + "/" + section_name(section);
    if (!file.has(place)) continue;
    for (const std::string& kind : file.names_in(place))
      for (const std::string& name : file.read_names(place + "/" + kind + "/name"))
        if (!model.records({section, name})) fail_left_out(file, {section, name});
  }
  const ResultsKinds& kinds = rows.kinds();
  for (const ResultsKind& kind : kinds.kinds()) {
    const std::string place = group + "/" + place_of(kind) + "/name";
    const std::vector<std::string> now = names_of(kind, kinds);
    if (!file.has(place)) fail_missing(file, results_path({kind.section, now.front()}));
    const std::vector<std::string> then = file.read_names(place);
    if (now == then) continue;
    const std::set<std::string> known(then.begin(), then.end());
    const auto added = std::find_if(now.begin(), now.end(), [&](const auto& name) { return !known.contains(name); });
    fail_missing(file, results_path({kind.section, added == now.end() ? now.front() : *added}));
  }
  for (const ResultsColumn& column : columns)
    if (const std::string dataset = group + "/" + column.dataset; !file.has(dataset)) fail_missing(file, dataset);
}

}  // namespace

ResultsLayout layout_for(const ResultsRows& rows, std::optional<ResultsLayout> wanted) {
  if (wanted) return *wanted;
  return rows.kinds().datasets() > most_named_datasets ? ResultsLayout::stacked : ResultsLayout::named;
}

void create_dataset(Hdf5File& file, const std::string& group, const ResultsColumn& column, std::size_t rows_per_chunk) {
  file.create_rows(group + "/" + column.dataset, column.shape, units_or_number(column.units), column.description,
                   rows_per_chunk);
}

void describe_entries(Hdf5File& file, const std::string& group, const ResultsRows& rows, ResultsLayout layout) {
  if (layout == ResultsLayout::named) return describe_named(file, group, rows.kinds());
  for (const ResultsKind& kind : rows.kinds().kinds()) describe_kind(file, group, kind, rows.kinds());
}

void check_same_datasets(const Hdf5File& file, const std::string& group, const Model& model, const ResultsRows& rows,
                         ResultsLayout layout, const std::vector<ResultsColumn>& columns) {
  if (layout == ResultsLayout::named)
    check_named(file, group, model, columns);
  else
    check_stacked(file, group, model, rows, columns);
  for (const ResultsColumn& column : columns) {
    const std::string dataset = group + "/" + column.dataset;
    const std::vector<std::size_t> shape = file.shape(dataset);
    if (shape.empty() || !std::equal(shape.begin() + 1, shape.end(), column.shape.begin(), column.shape.end()))
      throw InputError(fmt::format("{}: {}: its rows have another shape than those of this model: the file is damaged",
                                   file.path(), dataset));
  }
}

void write_numbers(Hdf5File& file, const std::string& group, const ResultsKinds& kinds, ResultsLayout layout,
                   const EntryNumbers& numbers) {
  const std::string units = units_or_number(numbers.units);
  if (layout == ResultsLayout::named) {
    for (const auto& [entry, value] : numbers.values)
      if (kinds.find(entry))
        file.write(group + "/" + results_path(entry) + "/" + numbers.name, value, units, numbers.description);
    return;
  }
  std::map<std::size_t, std::vector<double>> by_kind;
  for (const auto& [entry, value] : numbers.values) {
    const ResultsEntry* found = kinds.find(entry);
    if (!found) continue;
    std::vector<double>& values = by_kind[found->kind];
    values.resize(kinds.kinds()[found->kind].entries.size(), std::numeric_limits<double>::quiet_NaN());
    values[found->number] = value;
  }
  for (const auto& [kind, values] : by_kind)
    file.write(group + "/" + place_of(kinds.kinds()[kind]) + "/" + numbers.name, values, {values.size()}, units,
               numbers.description);
}

}  // namespace bielle::mechanism

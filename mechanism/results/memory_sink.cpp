#include "mechanism/results/memory_sink.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "reduce/common/error.hpp"

namespace bielle::mechanism {

void MemorySink::begin_analysis(const std::string& type, std::size_t expected_rows) {
  analyses_.push_back({type, {}, {}, {}, {}, {}});
  // A long run may end early: memory beyond this number of values is allocated when it is needed.
  constexpr std::size_t most_numbers = 1'000'000;
  const std::size_t rows = std::min(expected_rows, most_numbers / std::max<std::size_t>(rows_.size(), 1));
  analyses_.back().time.reserve(rows);
  analyses_.back().values.reserve(rows * rows_.size());
  rows_.restart();
}

void MemorySink::record(const State& state, const std::vector<Slots>& slots, const Environment& environment,
                        const StepRecord& step) {
  Recorded& now = analyses_.back();
  now.values.resize(now.values.size() + rows_.size());
  rows_.fill(state, slots, environment, step, now.values.data() + now.values.size() - rows_.size());
  now.time.push_back(step.time.value_or(state.time));
}

void MemorySink::write(const ResultArray& array) { analyses_.back().arrays[array.dataset] = array; }

void MemorySink::write(const EntryNumbers& numbers) {
  for (const auto& [entry, value] : numbers.values)
    write({results_path(entry) + "/" + numbers.name, {}, {value}, numbers.units, numbers.description});
}

std::vector<double> MemorySink::read(std::size_t analysis, const std::string& dataset) const {
  const Recorded& recorded = analyses_.at(analysis);
  if (dataset == "time") return recorded.time;
  if (const auto array = recorded.arrays.find(dataset); array != recorded.arrays.end()) return array->second.values;
  const std::optional<ResultsColumn> column = rows_.find(dataset);
  if (!column) throw InputError(fmt::format("nothing was recorded as '{}'", dataset));
  std::vector<double> values;
  values.reserve(recorded.time.size() * column->size);
  for (std::size_t row = 0; row < recorded.time.size(); ++row) {
    const auto begin = recorded.values.begin() + static_cast<std::ptrdiff_t>(row * rows_.size() + column->begin);
    values.insert(values.end(), begin, begin + static_cast<std::ptrdiff_t>(column->size));
  }
  return values;
}

}  // namespace bielle::mechanism

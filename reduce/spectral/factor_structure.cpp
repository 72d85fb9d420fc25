#include "reduce/spectral/factor_structure.hpp"

#include <chrono>
#include <vector>

#include "reduce/spectral/fill_reducing_order.hpp"

namespace bielle {

FactorStructure::FactorStructure(const BlockGraph& graph) {
  using Clock = std::chrono::steady_clock;
  const auto seconds = [](Clock::duration time) { return std::chrono::duration<double>(time).count(); };
  const Clock::time_point start = Clock::now();
  const std::vector<int> order = fill_reducing_order(graph);
  const Clock::time_point ordered = Clock::now();
  supernodes_ = find_supernodes(graph, order);
  view_ = {graph.unknowns(),
           static_cast<std::int64_t>(supernodes_.columns.size()) - 1,
           supernodes_.columns.data(),
           supernodes_.row_starts.data(),
           supernodes_.value_starts.data(),
           supernodes_.rows.data(),
           supernodes_.order.data()};
  ordering_seconds_ = seconds(ordered - start);
  analysis_seconds_ = seconds(Clock::now() - ordered);
}

double FactorStructure::bytes() const {
  return 8.0 * (static_cast<double>(values()) + static_cast<double>(supernodes_.rows.size()));
}

}  // namespace bielle

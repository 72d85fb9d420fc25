#include "reduce/sparse/factor_structure.hpp"

#include <chrono>
#include <vector>

#include "reduce/sparse/fill_reducing_order.hpp"

namespace bielle {

namespace {

/// Pattern of a matrix: the lower triangle by columns.
struct Pattern {
  std::vector<std::int64_t> starts{0}, rows;

  explicit Pattern(const BlockGraph& graph) {
    starts.reserve(static_cast<std::size_t>(graph.unknowns()) + 1);
    for (int b = 0; b < graph.size(); ++b) {
      const auto at = [&](int k) { return graph.first[static_cast<std::size_t>(k)]; };
      for (std::int64_t j = at(b); j < at(b + 1); ++j) {
        for (int p = graph.starts[static_cast<std::size_t>(b)]; p < graph.starts[static_cast<std::size_t>(b) + 1];
             ++p) {
          const int other = graph.rows[static_cast<std::size_t>(p)];
          for (std::int64_t i = other == b ? j : at(other); i < at(other + 1); ++i) rows.push_back(i);
        }
        starts.push_back(static_cast<std::int64_t>(rows.size()));
      }
    }
  }
};

std::vector<std::int64_t> order_of_unknowns(const BlockGraph& graph) {
  std::vector<std::int64_t> order;
  order.reserve(static_cast<std::size_t>(graph.unknowns()));
  for (const std::int64_t b : fill_reducing_order(graph))
    for (std::int64_t k = graph.first[static_cast<std::size_t>(b)]; k < graph.first[static_cast<std::size_t>(b) + 1];
         ++k)
      order.push_back(k);
  return order;
}

}  // namespace

FactorStructure::FactorStructure(const BlockGraph& graph) {
  using Clock = std::chrono::steady_clock;
  const auto seconds = [](Clock::duration time) { return std::chrono::duration<double>(time).count(); };
  const Clock::time_point start = Clock::now();
  std::vector<std::int64_t> order = order_of_unknowns(graph);
  const Clock::time_point ordered = Clock::now();
  const Pattern pattern(graph);
  cholmod_sparse view = cholmod_view(graph.unknowns(), pattern.starts.data(), pattern.rows.data(), nullptr);
  workspace_->supernodal = CHOLMOD_SUPERNODAL;
  factor_ = {cholmod_l_analyze_p(&view, order.data(), nullptr, 0, workspace_.get()), {workspace_.get()}};
  workspace_.check("the analysis of the stiffness matrix");
  nonzeros_ = static_cast<std::int64_t>(workspace_->lnz);
  flops_ = workspace_->fl;
  entries_ = static_cast<std::int64_t>(pattern.rows.size());
  ordering_seconds_ = seconds(ordered - start);
  analysis_seconds_ = seconds(Clock::now() - ordered);
}

std::span<const std::int64_t> FactorStructure::order() const {
  return {static_cast<const std::int64_t*>(factor_->Perm), factor_->n};
}

std::int64_t FactorStructure::values() const { return static_cast<std::int64_t>(factor_->xsize); }

double FactorStructure::bytes() const {
  // Further memory: the rows of the supernodes, one update of a supernode, and six or so lists of unknowns.
  const double numbers = static_cast<double>(factor_->xsize + factor_->ssize + factor_->maxcsize + 6 * factor_->n);
  return 8 * numbers + 16 * static_cast<double>(entries_);
}

}  // namespace bielle

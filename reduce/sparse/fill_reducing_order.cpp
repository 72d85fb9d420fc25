#include "reduce/sparse/fill_reducing_order.hpp"

#include "reduce/sparse/cholmod_objects.hpp"

namespace bielle {

std::vector<std::int64_t> fill_reducing_order(const BlockGraph& graph) {
  constexpr int small_graph = 200;  // blocks below which minimum degree orders as well as nested dissection
  const std::vector<std::int64_t> starts(graph.starts.begin(), graph.starts.end()),
      rows(graph.rows.begin(), graph.rows.end());
  cholmod_sparse pattern = cholmod_view(graph.size(), starts.data(), rows.data(), nullptr);
  std::vector<std::int64_t> order(static_cast<std::size_t>(graph.size()));
  CholmodWorkspace workspace;
  if (graph.size() < small_graph)
    cholmod_l_amd(&pattern, nullptr, 0, order.data(), workspace.get());
  else
    cholmod_l_metis(&pattern, nullptr, 0, 1, order.data(), workspace.get());
  workspace.check("the ordering of the stiffness matrix");
  return order;
}

}  // namespace bielle

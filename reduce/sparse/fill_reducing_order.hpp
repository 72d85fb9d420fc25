// A fill-reducing elimination order: nested dissection (METIS), or minimum degree (AMD) for small graphs.
#pragma once

#include <cstdint>
#include <vector>

#include "reduce/sparse/block_graph.hpp"

namespace bielle {

/// Returns the blocks in the order of elimination. The order is reproducible for the same graph, as long as no other
/// thread calls std::rand, which METIS does.
/// @throws ComputationError when memory does not suffice
std::vector<std::int64_t> fill_reducing_order(const BlockGraph& graph);

}  // namespace bielle

// In which order to eliminate, so that little fills in: nested dissection (METIS), or minimum degree (AMD) for small
// graphs.
#pragma once

#include <cstdint>
#include <vector>

#include "reduce/sparse/block_graph.hpp"

namespace bielle {

/// The blocks as they are eliminated. The same for the same graph, as long as no other thread calls std::rand, which
/// METIS does.
/// @throws ComputationError when memory does not suffice
std::vector<std::int64_t> fill_reducing_order(const BlockGraph& graph);

}  // namespace bielle

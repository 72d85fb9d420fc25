// The structure of L in L L^T = P A P^T: what can be known of a factor before the numbers are.
//
// The order is found on the graph of blocks, and so is all else: unknowns of a block have columns of the same structure
// in L, so that a block counts for as many as it has.
#pragma once

#include <cstdint>

#include "reduce/spectral/block_graph.hpp"
#include "reduce/spectral/supernodal_solver.hpp"
#include "reduce/spectral/supernodes.hpp"

namespace bielle {

class FactorStructure {
 public:
  /// @throws ComputationError when memory does not suffice
  explicit FactorStructure(const BlockGraph& graph);
  FactorStructure(const FactorStructure&) = delete;
  FactorStructure& operator=(const FactorStructure&) = delete;

  const SupernodalFactor& supernodes() const { return view_; }             ///< without values
  std::int64_t values() const { return supernodes_.value_starts.back(); }  ///< of L, padding and all
  std::int64_t nonzeros() const { return supernodes_.nonzeros; }           ///< of L
  double flops() const { return supernodes_.flops; }                       ///< of the factorisation
  double bytes() const;                                                    ///< of L and its row numbers
  double ordering_seconds() const { return ordering_seconds_; }            ///< wall time
  double analysis_seconds() const { return analysis_seconds_; }

 private:
  Supernodes supernodes_;
  SupernodalFactor view_;
  double ordering_seconds_ = 0, analysis_seconds_ = 0;
};

}  // namespace bielle

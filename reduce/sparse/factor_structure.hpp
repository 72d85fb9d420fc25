// The structure of L in L L^T = P A P^T: the properties of a factor that are known before the numerical factorisation.
// CHOLMOD computes it for an order that is found on the graph of blocks.
#pragma once

#include <cstdint>
#include <span>

#include "reduce/sparse/block_graph.hpp"
#include "reduce/sparse/cholmod_objects.hpp"

namespace bielle {

class FactorStructure {
 public:
  /// @throws ComputationError when memory does not suffice
  explicit FactorStructure(const BlockGraph& graph);
  FactorStructure(const FactorStructure&) = delete;
  FactorStructure& operator=(const FactorStructure&) = delete;

  const cholmod_factor& symbolic() const { return *factor_; }
  std::span<const std::int64_t> order() const;                   ///< the unknowns as they are eliminated
  std::int64_t values() const;                                   ///< stored values of L, including padding
  std::int64_t nonzeros() const { return nonzeros_; }            ///< entries of L
  double flops() const { return flops_; }                        ///< operations of the factorisation
  double bytes() const;                                          ///< to factorise: L, and the matrix in its order
  double ordering_seconds() const { return ordering_seconds_; }  ///< wall time
  double analysis_seconds() const { return analysis_seconds_; }

 private:
  CholmodWorkspace workspace_;
  CholmodFactor factor_;
  std::int64_t nonzeros_ = 0, entries_ = 0;  // entries of L, of the matrix
  double flops_ = 0, ordering_seconds_ = 0, analysis_seconds_ = 0;
};

}  // namespace bielle

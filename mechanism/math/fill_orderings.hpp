// Fill-reducing orderings of a pattern by KLU.
#pragma once

#include <mutex>

#include <klu.h>

#include "mechanism/math/sparse_pattern.hpp"

namespace bielle::mechanism {

/// Parameters of KLU for all matrices.
klu_common klu_parameters();

// KLU's interface takes pointers to non-const, but does not write through them.
inline int* klu_starts(const SparsePattern& pattern) { return const_cast<int*>(pattern.column_start().data()); }
inline int* klu_rows(const SparsePattern& pattern) { return const_cast<int*>(pattern.row().data()); }

/// KLU's analyses of a pattern, which the factorisation only reads.
class FillOrderings {
 public:
  enum Method { minimum_degree = 0, column_minimum_degree = 1 };

  FillOrderings() = default;
  FillOrderings(const FillOrderings&) = delete;
  FillOrderings& operator=(const FillOrderings&) = delete;
  ~FillOrderings();
  /// Returns the analysis, which is made at the first call, in any thread.
  /// @param pattern  pattern that these orderings belong to
  /// @throws ComputationError if there are too many equations
  klu_symbolic* get(const SparsePattern& pattern, Method method) const;

 private:
  struct Analysis {
    std::once_flag once;
    klu_symbolic* symbolic = nullptr;
  };
  mutable Analysis analyses_[2];
};

}  // namespace bielle::mechanism

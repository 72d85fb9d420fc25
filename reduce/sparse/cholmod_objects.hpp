// CHOLMOD with 64-bit integers: its settings and workspace, owners of its objects, and views of Bielle's matrices.
//
// Y. Chen, T. A. Davis, W. W. Hager, S. Rajamanickam, Algorithm 887: CHOLMOD, supernodal sparse Cholesky factorization
// and update/downdate, ACM Trans. Math. Softw. 35 (2008) 22.
#pragma once

#include <memory>
#include <string>

#include <cholmod.h>

#include "reduce/sparse/symmetric_matrix.hpp"

namespace bielle {

/// A workspace serves one thread at a time. It must outlive the objects that were made with it.
class CholmodWorkspace {
 public:
  CholmodWorkspace();
  ~CholmodWorkspace();
  CholmodWorkspace(const CholmodWorkspace&) = delete;
  CholmodWorkspace& operator=(const CholmodWorkspace&) = delete;

  cholmod_common* operator->() { return &common_; }
  cholmod_common* get() { return &common_; }
  /// @param work  description of the last call, "the ordering of a matrix"
  /// @throws ComputationError if it failed; a matrix that is not positive definite is not a failure
  void check(const std::string& work) const;

 private:
  cholmod_common common_;
};

struct CholmodDeleter {
  cholmod_common* common = nullptr;
  void operator()(cholmod_factor* factor) const { cholmod_l_free_factor(&factor, common); }
  void operator()(cholmod_sparse* matrix) const { cholmod_l_free_sparse(&matrix, common); }
};
using CholmodFactor = std::unique_ptr<cholmod_factor, CholmodDeleter>;
using CholmodSparse = std::unique_ptr<cholmod_sparse, CholmodDeleter>;

/// Returns a view that CHOLMOD only reads. @param values  nullptr: the pattern alone
cholmod_sparse cholmod_view(std::int64_t size, const std::int64_t* starts, const std::int64_t* rows,
                            const double* values);
cholmod_sparse cholmod_view(const SymmetricMatrix& a);

}  // namespace bielle

#include "reduce/sparse/pivot_signs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reduce/common/error.hpp"
#include "reduce/common/process/free_memory.hpp"
#include "reduce/sparse/cholmod_objects.hpp"

namespace bielle {

namespace {

constexpr const char* too_large = "not enough memory to count the signs of a matrix; leave the proof out";

PivotSigns signs_of(const cholmod_factor& factor, const std::vector<double>& scale) {
  const auto* starts = static_cast<const std::int64_t*>(factor.p);
  const auto* counts = static_cast<const std::int64_t*>(factor.nz);
  const auto* rows = static_cast<const std::int64_t*>(factor.i);
  const auto* values = static_cast<const double*>(factor.x);
  const auto* order = static_cast<const std::int64_t*>(factor.Perm);
  PivotSigns signs;
  for (std::size_t j = 0; j < factor.n; ++j) {
    const double pivot = values[starts[j]];  // L_jj is 1, and D_jj stands in its place
    signs.negative += pivot < 0;
    for (std::int64_t p = starts[j]; p < starts[j] + counts[j]; ++p) {
      const double entry = p == starts[j] ? 1 : values[p];
      const double growth = entry * entry * std::abs(pivot) / scale[static_cast<std::size_t>(order[rows[p]])];
      if (std::isnan(growth)) return {signs.negative, std::numeric_limits<double>::infinity()};
      signs.growth = std::max(signs.growth, growth);
    }
  }
  return signs;
}

}  // namespace

PivotSigns pivot_signs(const SymmetricMatrix& a, std::span<const std::int64_t> order,
                       const std::vector<double>& scale) {
  CholmodWorkspace workspace;
  workspace->supernodal = CHOLMOD_SIMPLICIAL;
  workspace->final_ll = 0;
  cholmod_sparse view = cholmod_view(a);
  const CholmodFactor factor(
      cholmod_l_analyze_p(&view, const_cast<std::int64_t*>(order.data()), nullptr, 0, workspace.get()),
      {workspace.get()});
  if (!factor || 16e-6 * workspace->lnz > free_memory_MB()) throw ComputationError(too_large);
  cholmod_l_factorize(&view, factor.get(), workspace.get());
  if (workspace->status == CHOLMOD_NOT_POSDEF) return {0, std::numeric_limits<double>::infinity()};
  if (workspace->status < 0) throw ComputationError(too_large);
  return signs_of(*factor, scale);
}

}  // namespace bielle

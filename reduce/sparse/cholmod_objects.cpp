#include "reduce/sparse/cholmod_objects.hpp"

#include <fmt/format.h>

#include "reduce/common/error.hpp"

namespace bielle {

CholmodWorkspace::CholmodWorkspace() {
  cholmod_l_start(&common_);
  common_.print = 0;
  common_.nmethods = 1;
  common_.method[0].ordering = CHOLMOD_GIVEN;
  common_.quick_return_if_not_posdef = 1;
}

CholmodWorkspace::~CholmodWorkspace() { cholmod_l_finish(&common_); }

void CholmodWorkspace::check(const std::string& work) const {
  if (common_.status == CHOLMOD_OUT_OF_MEMORY || common_.status == CHOLMOD_TOO_LARGE)
    throw ComputationError(fmt::format("not enough memory for {}; a coarser mesh needs less", work));
  if (common_.status < 0) throw ComputationError(fmt::format("CHOLMOD failed in {} (status {})", work, common_.status));
}

cholmod_sparse cholmod_view(std::int64_t size, const std::int64_t* starts, const std::int64_t* rows,
                            const double* values) {
  cholmod_sparse view{};
  view.nrow = view.ncol = static_cast<std::size_t>(size);
  view.nzmax = static_cast<std::size_t>(starts[size]);
  view.p = const_cast<std::int64_t*>(starts);
  view.i = const_cast<std::int64_t*>(rows);
  view.x = const_cast<double*>(values);
  view.stype = -1;
  view.itype = CHOLMOD_LONG;
  view.xtype = values == nullptr ? CHOLMOD_PATTERN : CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = view.packed = 1;
  return view;
}

cholmod_sparse cholmod_view(const SymmetricMatrix& a) {
  return cholmod_view(a.size, a.starts.data(), a.rows.data(), a.values.data());
}

}  // namespace bielle

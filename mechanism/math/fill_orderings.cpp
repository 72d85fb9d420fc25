#include "mechanism/math/fill_orderings.hpp"

#include <new>

#include <fmt/format.h>

#include "reduce/common/error.hpp"

namespace bielle::mechanism {

klu_common klu_parameters() {
  klu_common common;
  klu_defaults(&common);
  common.scale = -1;   // the factors scale the rows themselves
  common.btf = 0;      // permuting constraint rows off the diagonal causes more fill than the block form saves
  common.initmem = 2;  // factors have about as many entries as the matrix; KLU allocates more when necessary
  return common;
}

FillOrderings::~FillOrderings() {
  klu_common common = klu_parameters();
  for (Analysis& analysis : analyses_) klu_free_symbolic(&analysis.symbolic, &common);
}

klu_symbolic* FillOrderings::get(const SparsePattern& pattern, Method method) const {
  Analysis& analysis = analyses_[method];
  std::call_once(analysis.once, [&] {
    klu_common common = klu_parameters();
    common.ordering = method;
    analysis.symbolic = klu_analyze(pattern.size(), klu_starts(pattern), klu_rows(pattern), &common);
    if (common.status == KLU_OUT_OF_MEMORY) throw std::bad_alloc();
    if (!analysis.symbolic)
      throw ComputationError(fmt::format(
          "the sparse solver could not order the equations: they are too many (KLU returned {})", common.status));
  });
  return analysis.symbolic;
}

}  // namespace bielle::mechanism

#include "reduce/sparse/factor.hpp"

#include <fmt/format.h>

namespace bielle {

NotPositiveDefinite::NotPositiveDefinite(std::int64_t unknown)
    : ComputationError(fmt::format("the matrix is not positive definite at unknown {}", unknown)), unknown_(unknown) {}

}  // namespace bielle

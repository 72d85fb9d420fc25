// The report about verified matrices that bielle-reduce prints on standard output.
#pragma once

#include <string>

#include "reduce/matrices/verification.hpp"

namespace bielle::reduce {

/// Returns the verdict with the faults, the worst first; then each subject with its numbers.
std::string describe(const Verification& verification);

}  // namespace bielle::reduce

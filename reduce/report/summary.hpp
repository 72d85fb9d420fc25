// The report about a body that bielle-reduce prints on standard output.
#pragma once

#include <string>
#include <vector>

#include "reduce/common/progress.hpp"
#include "reduce/reduction/reduce_body.hpp"

namespace bielle::reduce {

/// Interfaces, mass properties, fixed-boundary modes with their effective masses, residual vectors, free-free
/// frequencies, load patterns, points and recoverable fields.
std::string describe(const Superelement& body);

/// One line for each check with its result.
std::string describe(const std::vector<Check>& checks);

/// Returns the cost of the reduction: factorisation, solutions, time and memory of each phase.
std::string describe(const ReductionReport& report, const std::vector<PhaseReport>& phases);

}  // namespace bielle::reduce

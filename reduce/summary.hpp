// What bielle-reduce tells about a superelement: after a reduction, and of a file (`--inspect`).
#pragma once

#include <string>
#include <vector>

#include "reduce/common/progress.hpp"
#include "reduce/reduction/reduce_body.hpp"
#include "reduce/superelement/superelement.hpp"

namespace bielle::reduce {

/// Size, interfaces, mass properties, frequencies with effective masses, and the given checks with their verdicts.
std::string format_superelement(const Superelement& body, const std::vector<Check>& checks);

/// Time and memory of each phase, and the speed of the factorisation.
std::string format_cost(const ReductionReport& report, const std::vector<PhaseReport>& phases);

}  // namespace bielle::reduce

// The sentences about the masses of a body that a run prints.
#pragma once

#include <string>
#include <vector>

#include "reduce/fe/solid.hpp"
#include "reduce/reduction/added_masses.hpp"
#include "reduce/reduction/options.hpp"

namespace bielle::reduce {

/// Sentences about the masses and coatings of a body, each with its kilograms; and one for each mass whose place is
/// outside of the mesh by more than half a cell.
/// @param masses  those of the options
std::vector<std::string> told_masses(const Solid& solid, const AddedMasses& masses, const ReductionOptions& options);

}  // namespace bielle::reduce

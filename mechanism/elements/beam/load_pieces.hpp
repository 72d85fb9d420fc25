// Pieces of a beam's element between the places at which a load jumps or has a kink; the load is integrated over each
// piece.
#pragma once

#include <span>
#include <vector>

#include "mechanism/measures/state_formula.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Returns the ends of the pieces, from 0 to 1 of the element. @param places  boundaries of the pieces, 0 to 1 along
/// the beam
/// @param s_A,s_B  ends of the element along the beam
std::vector<double> pieces_between(const std::vector<double>& places, double s_A, double s_B);
/// Returns the ends of the pieces, from 0 to 1 of the element. @param components  formulas of `span_variables`
std::vector<double> load_pieces(std::span<const StateFormula> components, double s_A, double s_B);

/// Tells whether a formula of `span_variables` depends on the motion of the beam.
bool reads_span_motion(const StateFormula& formula);

/// Rejects a formula of s and t that the integration points of the elements do not integrate accurately: a part of the
/// load would be lost without a message. A formula of the state is not examined: its values are not known in advance.
/// @param components  all formulas of the load, whose kinks divide the elements @throws InputError
void check_load_integral(const YamlValue& value, const StateFormula& formula, std::span<const StateFormula> components,
                         int elements);

}  // namespace bielle::mechanism

// The verdict on a reduction for engineers: the frequency up to which it is accurate, the errors due to the mesh and
// the ties, and the most useful change.
#pragma once

#include <string>

#include "reduce/superelement/cut_body.hpp"

namespace bielle::reduce {

/// Lines that begin with "verdict: "; empty if the reduction measured nothing.
std::string verdict(const Superelement& body);

/// The verdict on a body in pieces: its mesh, and whether the pieces have the frequencies of the uncut body, if it was
/// compared.
std::string verdict(const CutBody& body);

}  // namespace bielle::reduce

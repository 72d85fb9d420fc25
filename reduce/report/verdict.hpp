// The verdict on a reduction, in an engineer's words: up to which frequency it is good, what the mesh and the ties do
// to it, and what to change first.
#pragma once

#include <string>

#include "reduce/superelement/cut_body.hpp"

namespace bielle::reduce {

/// Some lines that begin with "verdict: "; empty when its reduction measured nothing.
std::string verdict(const Superelement& body);

/// The same of a body in pieces: its mesh, and whether the pieces have the frequencies of the uncut body, where it was
/// compared.
std::string verdict(const CutBody& body);

}  // namespace bielle::reduce

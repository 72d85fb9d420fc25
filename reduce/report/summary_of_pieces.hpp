// The report about a body in pieces that bielle-reduce prints.
#pragma once

#include <string>

#include "reduce/superelement/cut_body.hpp"

namespace bielle::reduce {

/// Pieces, cuts and the distance of the cuts from their planes, frequencies of all pieces together, effect of the cuts
/// on the body.
std::string describe(const CutBody& body);

/// "the cuts raise the first free frequency by 0.3 %"; empty if the body was not compared with the uncut one.
std::string describe_effect(const CutBody& body);

}  // namespace bielle::reduce

// What bielle-reduce prints about a body in pieces.
#pragma once

#include <string>

#include "reduce/superelement/cut_body.hpp"

namespace bielle::reduce {

/// Pieces, cuts and where these follow faces of elements, frequencies of all together, what the cuts do to the body.
std::string describe(const CutBody& body);

/// "the cuts raise the first free frequency by 0.3 %"; empty when the body was not compared with the uncut one.
std::string describe_effect(const CutBody& body);

}  // namespace bielle::reduce

// Words of other programs for sections, types and keys, with the words of the input files here.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace bielle {

/// Returns the candidates that mean the same as a word of other programs: "hinge" for "revolute". The list is empty if
/// the word is unknown or its meaning is not among the candidates.
std::vector<std::string> names_here(const std::string& foreign, std::span<const std::string> candidates);

/// Returns "; here it is called 'hinge'"; for a word without a known meaning here, the result of did_you_mean().
std::string called_here(const std::string& word, std::span<const std::string> candidates);

/// Returns "; here it is called 'rate' or 'speed'". @param names  at least one
std::string called_here_clause(std::span<const std::string> names);

}  // namespace bielle

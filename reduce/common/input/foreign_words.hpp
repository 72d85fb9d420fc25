// Words of other programs for sections, types and keys, with the words of the input files here.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace bielle {

/// Returns the candidates by which a word of other programs goes here: "hinge" for "revolute"; none if it is no such
/// word, or none of its candidates fits.
std::vector<std::string> names_here(const std::string& foreign, std::span<const std::string> candidates);

/// Returns "; here it is called 'hinge'", or with another word did_you_mean().
std::string called_here(const std::string& word, std::span<const std::string> candidates);

/// Returns "; here it is called 'rate' or 'speed'". @param names  at least one
std::string called_here_clause(std::span<const std::string> names);

}  // namespace bielle

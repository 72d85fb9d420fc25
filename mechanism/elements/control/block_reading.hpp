// Parts of entries of `states` that continuous and sampled blocks share.
#pragma once

#include <string>
#include <vector>

#include "mechanism/elements/control/linear_block.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Reads `{numerator, denominator}`, coefficients in descending powers of a variable, as a realisation.
/// @param variable  "s" or "z" @param so_rises  the effect of a numerator of too high a degree, for the message
LinearBlock read_quotient(const YamlValue& function, const std::string& variable, const std::string& so_rises);
/// Reads the matrices `{A, B, C, D}` of a block with this number of inputs.
LinearBlock read_matrices(const YamlValue& matrices, Eigen::Index inputs);
/// Returns "name" for one output, "name.y1", "name.y2" for several.
std::string name_of_output(const std::string& name, Eigen::Index outputs, Eigen::Index k);
/// Reads the key `units`: one text, or a list with one for each of the recorded outputs.
std::vector<std::string> read_block_units(const YamlValue& units, std::size_t recorded);

}  // namespace bielle::mechanism

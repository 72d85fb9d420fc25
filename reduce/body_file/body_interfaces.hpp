// Keys that interfaces of the body file, interfaces made by cuts and points have in common.
#pragma once

#include <array>
#include <string>

#include "reduce/reduction/options.hpp"

namespace bielle {
class YamlValue;
}

namespace bielle::reduce {

/// Checks a name that becomes a path in the superelement file. @throws InputError
void check_name(const std::string& name, const YamlValue& value);

/// `rigid`, `average` or `free`. @throws InputError for other words
Tie read_tie(const YamlValue& value);

/// A list of x, y, z, rx, ry, rz. @param tie  nodes of free ones have no rotations
std::array<bool, 6> read_directions(const YamlValue& value, Tie tie = Tie::rigid);

}  // namespace bielle::reduce

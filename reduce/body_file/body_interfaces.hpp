// The `interfaces` of a body file, and the keys that they share with cuts and points.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "reduce/common/input/key_table.hpp"
#include "reduce/mesh/mesh_request.hpp"
#include "reduce/reduction/options.hpp"

namespace bielle {
class YamlValue;
}

namespace bielle::reduce {

class DeckReader;

/// Checks a name that becomes a path in the superelement file. @throws InputError
void check_name(const std::string& name, const YamlValue& value);

/// Returns the form of a tie.
KeyForm tie_form();

/// Returns the form of a list of directions.
KeyForm directions_form();

/// Reads the word of a tie: `rigid`, `average` or `free`. @throws InputError for other words
Tie read_tie(const YamlValue& value);

/// Reads a list of x, y, z, rx, ry, rz. @param tie  the nodes of a free tie have no rotations
std::array<bool, 6> read_directions(const YamlValue& value, Tie tie = Tie::rigid);

/// Returns the words of directions: x, y, z, rx, ry, rz.
std::vector<std::string> direction_names(const std::array<bool, 6>& directions);

/// Returns the keys of an interface.
const KeyTable& interface_keys();

/// @param mesh  gets the surface @param deck  the ties of its file, for `from`
/// @throws InputError `file:line: key: what was expected`
InterfaceRequest read_interface(const std::string& name, const YamlValue& value, MeshRequest& mesh, DeckReader& deck);

}  // namespace bielle::reduce

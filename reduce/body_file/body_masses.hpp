// The `masses` of a body file: rigid masses on surfaces or at places of the body, and mass per area.
#pragma once

#include "reduce/body_file/deck_ties.hpp"
#include "reduce/mesh/mesh_request.hpp"
#include "reduce/reduction/options.hpp"

namespace bielle {
class YamlValue;
struct KeyTable;
}  // namespace bielle

namespace bielle::reduce {

/// Returns the keys of a mass.
const KeyTable& mass_keys();

/// @param value      the map of all masses, or `from_file`
/// @param kilograms  per unit of mass of the deck @param deck  the masses of the body's file, for `from`
/// @param mesh       gets the surfaces @param options  gets the masses and coatings
/// @throws InputError `file:line: key: what was expected`
void read_masses(const YamlValue& value, double kilograms, MeshRequest& mesh, DeckReader& deck,
                 ReductionOptions& options);

}  // namespace bielle::reduce

// `pieces` in a body file: the planes at which a body is cut.
//
//   pieces: {planes: [{point: [..], normal: [..], name: ..}, {axis: x, at: 0.2}, {axis: x, at: [0.4, 0.6]}]}
//   pieces: {count: 4, line: {from: [..], to: [..]}}
//   pieces: {count: 5, arc: {from: [..], centre: [..], axis: [..], angle: "pi/4"}}
#pragma once

#include <vector>

#include "reduce/mesh/mesh_request.hpp"
#include "reduce/reduction/piece_options.hpp"

namespace bielle {
class YamlValue;
struct KeyTable;
}  // namespace bielle

namespace bielle::reduce {

/// Returns the keys of `pieces`.
const KeyTable& pieces_keys();

/// @param cuts  gets the planes
/// @throws InputError `file:line: key: what was expected`
PiecesRequest read_pieces(const YamlValue& value, std::vector<CutPlane>& cuts);

}  // namespace bielle::reduce

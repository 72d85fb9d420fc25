// `matrices` in a body file: a body as another program computed it.
//
//   body: blade
//   matrices: {file: blade.op4, nodes: blade.bdf, units: mm-t-s}
//   interfaces:
//     root: {nodes: [101, 102, 103, 104]}
//     tip:  {node: 977, directions: [x, y, z]}
//   modes: {count: 20}
#pragma once

#include "reduce/body_file/body_file.hpp"

namespace bielle {
class YamlValue;
struct KeyTable;
}  // namespace bielle

namespace bielle::reduce {

/// Returns the keys of `matrices`.
const KeyTable& matrices_keys();
/// Returns the keys of an entry of `matrices: {quantities: ..}`.
const KeyTable& quantity_keys();

/// @param root  the body file, which has the key `matrices` @throws InputError `file:line: key: what was expected`
MatrixBody read_matrix_body(const YamlValue& root);

}  // namespace bielle::reduce

// Whether the parts of a superelement fit together.
#pragma once

#include <string>

namespace bielle {

struct Superelement;

/// Checks shapes, symmetry, finite values and the numbers of nodes in the mesh.
/// @returns the first fault in a sentence that names the dataset of the file, or nothing
std::string fault_of(const Superelement& superelement);

}  // namespace bielle

// A check that the parts of a superelement are consistent.
#pragma once

#include <string>

namespace bielle {

struct Superelement;

/// Checks shapes, symmetry, finite values and the numbers of nodes in the mesh.
/// @returns the first fault as a sentence that names the dataset of the file, or nothing
std::string fault_of(const Superelement& superelement);

}  // namespace bielle

// Bodies of the same file share its matrices in memory.
#pragma once

#include <memory>

#include "mechanism/elements/superelement/superelement_body_matrices.hpp"

namespace bielle::mechanism {

/// The matrices of a superelement that was read from a file, in memory once for as long as a body uses them. A file
/// that was written again since has matrices of its own.
/// @throws InputError as the matrices do
std::shared_ptr<const SuperelementMatrices> shared_matrices(const SuperelementPlace& place, const Superelement& body);

}  // namespace bielle::mechanism

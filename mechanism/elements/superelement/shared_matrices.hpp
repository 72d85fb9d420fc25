// Matrices of superelements, which bodies of the same file share in memory.
#pragma once

#include <memory>

#include "mechanism/elements/superelement/superelement_body_matrices.hpp"

namespace bielle::mechanism {

/// Returns the matrices of a superelement that was read from a file; they exist once in memory as long as a body uses
/// them. A file that was written again in between has its own matrices.
/// @throws InputError as the matrices do
std::shared_ptr<const SuperelementMatrices> shared_matrices(const SuperelementPlace& place, const Superelement& body);

}  // namespace bielle::mechanism

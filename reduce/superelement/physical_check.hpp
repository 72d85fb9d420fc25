// A check that the matrices of a superelement can be those of an elastic body.
#pragma once

#include <string>

namespace bielle {

struct Superelement;

/// Checks what holds for every free body, to rounding of files of other programs: M~ is positive definite; K~, C~,
/// S_11, S_22, S_33 and the inertia are semidefinite; K~ gives fixed-boundary mode k the stiffness (2 pi f_k)^2 M~_kk.
/// Shapes and symmetry are checked before.
/// @returns the first fault in a sentence that names the dataset of the file, or nothing
std::string physical_fault_of(const Superelement& body);

/// Returns the first fault of a single part (superelement_check.hpp), otherwise that of the body as a whole, or
/// nothing.
std::string first_fault_of(const Superelement& body);

}  // namespace bielle

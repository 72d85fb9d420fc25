// The conditions A^T q = 0 that tie a body's frame to its interfaces, and what speaks for each.
//
// mean       A = W U, W diagonal in the kept directions: 1 for translations, l^2 = sum |X_i - X_mean|^2 / n_i for
//            rotations: the mean of the interfaces (l = 1 for a single one; where interfaces coincide, the body's
//            radius of gyration). The default: a slender curved body does not roll in it when it bends, so that
//            coordinates stay small and elastic forces exact to third order.
// mean axes  A = M~ U: no first-order coupling of rigid and elastic velocities. The same motion to the order of the
//            linear theory; a curved body rolls by a few tenths of its bending angle.
// carried    the frame of one interface, U restricted to it: as in programs that have no better; for comparison.
#pragma once

#include <cstddef>

#include "mechanism/elements/superelement/superelement_body_matrices.hpp"

namespace bielle::mechanism {

MatrixX6 mean_conditions(const SuperelementMatrices& body);
MatrixX6 mean_axes_conditions(const SuperelementMatrices& body);
/// @throws InputError when the interface does not keep all its directions
MatrixX6 carried_conditions(const SuperelementMatrices& body, std::size_t interface);

}  // namespace bielle::mechanism

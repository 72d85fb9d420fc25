// The conditions A^T q = 0 that define a body's frame by its interfaces, and their properties.
//
// mean       A = W U, W diagonal in the kept directions: 1 for translations, l^2 = sum |X_i - X_mean|^2 / n_i for
//            rotations: the mean of the interfaces (l = 1 for a single one; if they coincide, the body's radius of
//            gyration). The default: a slender curved body does not roll in it when it bends, so that coordinates stay
//            small and elastic forces exact to third order.
// mean axes  A = M~ U: no first-order coupling of rigid and elastic velocities. Motions agree to the order of the
//            linear theory; a curved body rolls by a few tenths of its bending angle.
// carried    the frame of one interface, with U restricted to it: as in simple programs, for comparison.
#pragma once

#include <cstddef>

#include "mechanism/elements/superelement/superelement_body_matrices.hpp"

namespace bielle::mechanism {

MatrixX6 mean_conditions(const SuperelementMatrices& body);
MatrixX6 mean_axes_conditions(const SuperelementMatrices& body);
/// @throws InputError if the interface does not keep all its directions
MatrixX6 carried_conditions(const SuperelementMatrices& body, std::size_t interface);

}  // namespace bielle::mechanism

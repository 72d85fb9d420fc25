// Directions of contact of the teeth of two wheels, from their axes, the pitch point, and the helix angle.
//
// At the pitch point P the pitch surfaces move with v_i = z_i x (P - c_i) per unit of rate. If v_1 and v_2 are parallel
// (parallel axes, intersecting axes), the pitch surfaces roll on each other, along the line
//     g = z_1/a_1 - z_2/a_2,   a_i = v_i . v_1/|v_1|,   the axis of their relative rotation,
// and the pitch plane contains v_1 and g. For crossed axes (worms, screw gears) the pitch plane contains v_1 and v_2.
// The tooth trace is rotated by the helix angle beta from g (in crossed gears: from z_1 in the pitch plane); a
// right-handed helix on wheel 1 has beta > 0. With v^ = v_1/|v_1| and the unit vector g^ along g on the side of z_1:
//     t = cos(beta) v^ - sin(beta) g^.
#pragma once

#include "mechanism/joints/gears/tooth_contact.hpp"

namespace bielle::mechanism {

/// Sets `t` and `nu` from the axes, centres and P. @param helix  beta [rad] of wheel 1
/// @param inside  wheel 1 is the ring, whose teeth point inwards
/// @throws std::domain_error with the error of P, as a clause
void set_tooth_directions(ToothGeometry& geometry, double helix, bool inside);

}  // namespace bielle::mechanism

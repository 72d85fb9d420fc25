// Elastic contact of two bodies that touch at a point (Hertz): force Q = K delta^(3/2).
//
// With the principal radii R_x (along rolling) and R_y (across) of the equivalent surface, curvature sum
// 1/R = 1/R_x + 1/R_y and difference F = |1/R_x - 1/R_y| R, the ratio k >= 1 of the axes of the contact ellipse solves
//     F = ((k^2 + 1) E - 2 F_1)/((k^2 - 1) E),
// E and F_1 the complete elliptic integrals of second and first kind with the modulus sqrt(1 - 1/k^2), and
//     K = pi k E' sqrt(R E/(4.5 F_1^3)),   2/E' = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2.
// Reference: B. J. Hamrock, B. O. Jacobson, S. R. Schmid, Fundamentals of Fluid Film Lubrication (2004), chapter 17.
#pragma once

namespace bielle::mechanism {

/// Returns K [N/m^1.5]. @param R_x,R_y  radii [m], positive @param modulus  E' [Pa]
double hertz_constant(double R_x, double R_y, double modulus);

}  // namespace bielle::mechanism

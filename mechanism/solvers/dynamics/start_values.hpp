// Algorithmic start values, which make multipliers and accelerations of second order from the first step on.
//
//   A_0 = a_0 + delta h j,   v_0 <- v_0 + h^2 w,   [M B^T; B 0][w; mu] = [0; B c],
//   c = C_q j + [0; Omega x Omegadot]/12,   delta = alpha_m - alpha_f,   C_q = -(1 + 3 delta^2)/12,
// Here j is the rate of the consistent acceleration. A change of the step size from h to h' is treated similarly:
//   A_n += delta (h' - h) j,   v_n += (h'^2 - h^2) w,   j = (A_n - A_{n-1})/h.
//
// The corrections are terms of a series in h. If the accelerations change by their own size within a step (stiff bodies
// that are started suddenly), the corrections would add errors that the scheme then has to damp, and are omitted.
//
// M. Arnold, O. Bruls, A. Cardona, Numer. Math. 129 (2015) 149.
#pragma once

#include "mechanism/solvers/dynamics/velocity_correction.hpp"

namespace bielle::mechanism {

/// Sets the start values for steps of size h from a consistent state. @param correction  valid factors of its saddle
/// matrix are used
void set_start_values(SchemeStep& step, const Environment& environment, VelocityCorrection& correction, double h);

/// Sets the values for steps of another size than before, from the last accepted time on.
void change_step_size(SchemeStep& step, VelocityCorrection& correction, double h);

}  // namespace bielle::mechanism

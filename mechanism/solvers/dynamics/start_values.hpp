// Algorithmic start values: what makes multipliers and accelerations of second order from the first step on.
//
//   A_0 = a_0 + delta h j,   v_0 <- v_0 + h^2 w,   [M B^T; B 0][w; mu] = [0; B c],
//   c = C_q j + [0; Omega x Omegadot]/12,   delta = alpha_m - alpha_f,   C_q = -(1 + 3 delta^2)/12,
// j the rate of the consistent acceleration. Across a change of the step from h to h' likewise:
//   A_n += delta (h' - h) j,   v_n += (h'^2 - h^2) w,   j = (A_n - A_{n-1})/h.
//
// The corrections are terms of a series in h. Where the accelerations change by their own size within a step (stiff
// bodies set off suddenly), they would add what the scheme then has to damp, and are left out.
//
// M. Arnold, O. Bruls, A. Cardona, Numer. Math. 129 (2015) 149.
#pragma once

#include "mechanism/solvers/dynamics/velocity_correction.hpp"

namespace bielle::mechanism {

/// For steps of size h from a consistent state. @param correction  factors of its saddle that serve are used
void set_start_values(SchemeStep& step, const Environment& environment, VelocityCorrection& correction, double h);

/// For steps of another size than before, from the last accepted time on.
void change_step_size(SchemeStep& step, VelocityCorrection& correction, double h);

}  // namespace bielle::mechanism

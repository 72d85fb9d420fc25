// How the held body gives way under its own inertia, and what of that its modes have.
//
// An acceleration field that is linear in space, a(x) = sum over i, j of c_(4i+j) e_i f_j, f = 1, x, y, z from the
// centre of mass, loads the body with -M a: every rigid acceleration (a constant, and alpha x x) and every centrifugal
// field (omega x (omega x x)) is one. With all interfaces held, the answer to L c, L = M times the fields, has the
// energy
//     c^T W c / 2,   W = L^T K_ii^-1 L,
// of which kept modes and residual vectors Phi have c^T V c / 2, V = L^T Phi Omega^-2 Phi^T L. Both answers and what
// the interfaces do are orthogonal in K: W - V is what a quasi-static deformation lacks, whatever the interfaces do.
#pragma once

#include "reduce/reduction/residual_vectors.hpp"
#include "reduce/superelement/superelement.hpp"

namespace bielle::reduce {

InertiaAnswer inertia_answer_energies(const Basis& basis);

/// The loads L, as a request for residual vectors: with them nothing is missing. If the modes have all of it
/// already, none are made.
/// @param located  put before messages
ResidualRequest inertia_relief(const LinearFields& linear, std::string located);

}  // namespace bielle::reduce

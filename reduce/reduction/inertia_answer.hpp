// Deformation of the held body under its own inertia, and the part of it that its modes represent.
//
// An acceleration field that is linear in space, a(x) = sum over i, j of c_(4i+j) e_i f_j, f = 1, x, y, z from the
// centre of mass, loads the body with -M a: every rigid acceleration (a constant, and alpha x x) and every centrifugal
// field (omega x (omega x x)) is such a field. With all interfaces held, the answer to L c, L = M times the fields, has
// the energy
//     c^T W c / 2,   W = L^T K_ii^-1 L,
// The part of kept modes and residual vectors Phi is c^T V c / 2, V = L^T Phi Omega^-2 Phi^T L. Both answers are
// orthogonal in K to the motions of the interfaces: W - V is the energy that a quasi-static deformation lacks, whatever
// the interfaces do.
#pragma once

#include "reduce/reduction/residual_vectors.hpp"
#include "reduce/superelement/superelement.hpp"

namespace bielle::reduce {

InertiaAnswer inertia_answer_energies(const Basis& basis);

/// The loads L, as a request for residual vectors: with these the answer is complete. If the modes represent it
/// completely, no residual vectors are made.
ResidualRequest inertia_relief(const LinearFields& linear);

}  // namespace bielle::reduce

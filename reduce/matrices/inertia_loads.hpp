// Loads of the body's own inertia on foreign matrices (reduction/inertia_answer.hpp describes the fields): M times the
// displacements of accelerations that are linear in space.
//
// Matrices of nodes alone know the fields: node a moves by e_i f_j(x_a) and turns by half the curl, grad f_j x e_i / 2.
// Amplitudes of modes follow the nodes only in rigid motions, so that a reduced file with scalars has the loads of the
// six rigid accelerations and none of centrifugal fields.
#pragma once

#include "reduce/matrices/held_matrices.hpp"
#include "reduce/matrices/matrix_basis.hpp"
#include "reduce/superelement/superelement.hpp"

namespace bielle::reduce {

/// Loads (n, 12) from `origin` in the order of InertiaAnswer, or (n, 6) of rigid motions if the set has scalars.
Eigen::MatrixXd inertia_loads(const MatrixSet& set, const NodeTies& ties, const MatrixBasis& basis,
                              const Eigen::Vector3d& origin);

/// Returns the held body's answers to the loads of a set without scalars, and the part that the basis lacks. Empty for
/// other sets.
InertiaAnswer inertia_answer_of(const MatrixSet& set, const NodeTies& ties, const HeldMatrices& held,
                                const MatrixBasis& basis, const Eigen::Vector3d& centre);

}  // namespace bielle::reduce

// The subjects of the verification, one function for each.
#pragma once

#include "reduce/matrices/matrix_study.hpp"
#include "reduce/matrices/verification.hpp"

namespace bielle::reduce {

/// Adds a check, with its fault if it fails.
void add_finding(VerifiedSubject& subject, Check check, const std::string& fault);

/// Symmetry and definiteness of K, M and C; unknowns without stiffness or mass.
VerifiedSubject verify_entries(const MatrixStudy& study);
/// Returns the first `most` names of unknowns, and the number of the others: "node 1 x, node 1 y and 12 more".
std::string names_of(const MatrixSet& set, const Unknowns& unknowns, std::size_t most = 4);

/// Forces of rigid motions, the distance between the three kinds of them, and their frequencies.
VerifiedSubject verify_rigid_motions(const MatrixStudy& study);
/// Tells whether rigid motions by the stiffness alone cause force at their references: the body is held to the ground.
bool is_grounded(const MatrixStudy& study);

/// Positions of nodes that the stiffness implies against those of the set.
/// @param scale  becomes the factor from the set's positions to the implied ones, 1 if they agree
VerifiedSubject verify_positions(const MatrixStudy& study, double& scale);

/// Mass, centre and inertia along each direction, against stated ones and those of point masses.
VerifiedSubject verify_mass(const MatrixStudy& study);

/// Plausibility of SI units, if no units were declared.
VerifiedSubject verify_units(const MatrixStudy& study);

/// Free and held frequencies with effective masses, and properties of scalars.
VerifiedSubject verify_modes(const MatrixStudy& study);

/// Damping matrix and inertia components.
VerifiedSubject verify_parts(const MatrixStudy& study);

/// Stress and forces of recovered rows under rigid motions.
VerifiedSubject verify_recovery(const MatrixStudy& study);

}  // namespace bielle::reduce

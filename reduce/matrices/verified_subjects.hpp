// The subjects of the verification, one function for each.
#pragma once

#include "reduce/matrices/matrix_study.hpp"
#include "reduce/matrices/verification.hpp"

namespace bielle::reduce {

/// Adds a check, with its fault if it fails.
void add_finding(VerifiedSubject& subject, Check check, const std::string& fault);

/// Checks symmetry and definiteness of K, M and C, and finds unknowns without stiffness or mass.
VerifiedSubject verify_entries(const MatrixStudy& study);
/// Returns the first `most` names of unknowns, and the number of the others: "node 1 x, node 1 y and 12 more".
std::string names_of(const MatrixSet& set, const Unknowns& unknowns, std::size_t most = 4);

/// Checks the forces of rigid motions, the distance between the three kinds of them, and their frequencies.
VerifiedSubject verify_rigid_motions(const MatrixStudy& study);
/// Tells whether rigid motions by the stiffness alone cause force at their references: the body is held to the ground.
bool is_grounded(const MatrixStudy& study);

/// Compares the positions of nodes that the stiffness implies with those of the set.
/// @param scale  becomes the factor from the set's positions to the implied ones, 1 if they agree
VerifiedSubject verify_positions(const MatrixStudy& study, double& scale);

/// Compares mass, centre and inertia along each direction with stated ones and with those of point masses.
VerifiedSubject verify_mass(const MatrixStudy& study);

/// Checks that SI units are plausible, if no units were declared.
VerifiedSubject verify_units(const MatrixStudy& study);

/// Reports free and held frequencies with effective masses, and checks properties of scalars.
VerifiedSubject verify_modes(const MatrixStudy& study);

/// Checks the damping matrix and the inertia components.
VerifiedSubject verify_parts(const MatrixStudy& study);

/// Checks that recovered stresses and forces vanish under rigid motions.
VerifiedSubject verify_recovery(const MatrixStudy& study);

}  // namespace bielle::reduce

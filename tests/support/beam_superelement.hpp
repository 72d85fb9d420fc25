// Superelements for tests: a chain of straight Euler-Bernoulli elements (cubic bending, linear extension and torsion)
// reduced to some of its nodes and fixed-boundary modes by dense algebra, without the program's own reduction.
//
// Translational inertia is that of mass points, four Gauss points per element (exact for the cubic field): the reduced
// displacement of every one of them is known, so that energies and forces can be computed from positions in space
// alone. Rotary inertia about the axis is in M~ only. Prestress: of the forces and moments of the free body's sections,
// by the second variation of the strains of a geometrically exact beam (rotations are rotation vectors),
//     Gamma_2 = -theta x u' + theta x (theta x e_1) / 2,   kappa_2 = -theta x theta' / 2.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mechanism/math/types.hpp"
#include "reduce/superelement/superelement.hpp"

namespace bielle::test {

struct BeamInterface {
  int node = 0;
  std::array<bool, 6> kept = {true, true, true, true, true, true};
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< interface axes -> body axes
};

/// The beam of the published comparison: length 1, mass 1, first free-free frequencies 22.373 (y) and 25.510 (z) rad/s.
struct BeamProperties {
  double mass_per_length = 1, EA = 1e5, EIy = 1.3, EIz = 1, GJ = 0.8, rotary_inertia = 1e-4;
};

struct BeamSuperelement {
  Superelement body;
  Eigen::Matrix3Xd points;                    ///< mass points of the undeformed body [m]
  Eigen::VectorXd masses;                     ///< [kg]
  Eigen::MatrixXd field;                      ///< (3p,n): displacement of the mass points, body axes
  Eigen::MatrixXd rotary;                     ///< (n,n): rotary inertia in M~
  Eigen::MatrixXd full_stiffness, full_mass;  ///< matrices of the chain, 6 unknowns per node in body axes
  Eigen::MatrixXd basis;                      ///< (6 nodes, n): reduction basis
};

struct BeamLoad {
  std::string pattern;
  int node = 0;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
};

struct BeamChain {
  std::vector<Eigen::Vector3d> nodes;                      ///< vertices of the chain
  Eigen::Vector3d y_direction = Eigen::Vector3d::UnitY();  ///< its part normal to an element is the section's y axis
  BeamProperties properties;
  std::vector<BeamInterface> interfaces;
  std::vector<BeamLoad> loads;
  double damping = 0;  ///< C~ = damping K~ [s]
  int modes = 4;
  bool prestress = true;

  BeamSuperelement reduced() const;
};

/// Gives the body a mesh to recover displacements at: four nodes around each node of the chain, that far away, moving
/// with its section.
void add_mesh(const BeamChain& chain, double distance, BeamSuperelement& reduced);

/// Returns the straight free-free beam of length 1 along x from the origin, 20 elements, its end nodes as interfaces
/// "a" and "b".
BeamChain straight_beam(const BeamProperties& properties = {}, int modes = 4);

/// Returns a bent body in space with three interfaces, two of them with turned axes, 5 modes, damping, prestress, and
/// the load patterns "push" (one point) and "spread" (two).
BeamChain bent_chain();

/// Returns the bent body with different kept directions of its interfaces: all; only forces at one; all but one
/// rotation at one and a single moment at another; two translations and two rotations; only forces at all three.
std::vector<BeamChain> bent_chains();

}  // namespace bielle::test

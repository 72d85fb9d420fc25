// Motion of each node in a mode, and the distribution of the mode's energy over the parts of the mechanism.
#pragma once

#include <vector>

#include "mechanism/solvers/linearised/modes.hpp"

namespace bielle::mechanism {

/// Complex amplitudes of all nodes, including carried and inner ones.
struct NodeShapes {
  Eigen::Matrix3Xcd displacement;  ///< (3, nodes) inertial components [m]
  Eigen::Matrix3Xcd rotation;      ///< (3, nodes) rotation vectors, inertial components [rad]
};
NodeShapes node_shapes(const System& system, const State& state, const Mode& mode);

/// Returns the factor that makes the largest displacement of a node 1 m, or the largest rotation 1 rad if that is
/// larger relative to the mechanism's size; the largest component becomes real and positive. If no node moves, the
/// largest amplitude or first-order unknown becomes 1.
std::complex<double> unit_factor(const System& system, const State& state, const Mode& mode);

/// Energies of modes in each member of the model, averaged over a period: (dv^H M dv)/4 and (u^H K u)/4, with M and the
/// symmetric part of K of the member alone. K contains the geometric stiffness of its forces, for a joint that of its
/// reactions, for a body that of its weight. A rigid mode moves by its shape within a second. All are (members, modes)
/// [J] for unscaled amplitudes.
struct MemberEnergies {
  MatrixX kinetic, potential;                        ///< potential ones may be negative
  MatrixX turning;                                   ///< kinetic energy of rotations of nodes alone
  MatrixX extension, torsion, bending_y, bending_z;  ///< of slender members (SlenderComponent); of others zero
  MemberEnergies(Eigen::Index members, Eigen::Index modes);
  MemberEnergies() = default;
  MemberEnergies& operator+=(const MemberEnergies& other);
};
MemberEnergies member_energies(const System& system, const Environment& environment, const State& state,
                               const std::vector<Mode>& modes);

}  // namespace bielle::mechanism

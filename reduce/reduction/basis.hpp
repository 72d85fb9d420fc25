// The Craig-Bampton basis, and the held body's answer to inertia loads, computed with one factorisation.
//
// u = T q, T = [Psi Phi]: constraint modes Psi (one kept direction of an interface moved by one, the others held) and
// fixed-boundary (fixed-interface) modes Phi, K_ii phi = omega^2 M_ii phi with every kept direction held and i the
// interior degrees of freedom, Phi^T M Phi = I.
// Residual vectors may follow the modes (residual_vectors.hpp).
// Rigid motions are put into Psi exactly: with A the rigid motion nearest to interface coordinates q_b, Psi q_b is the
// rigid motion A q_b plus the solution for the rest q_b - U A q_b. (The factor of a slender body would leave errors of
// 1e-9.) Reference: R. R. Craig, M. C. C. Bampton, AIAA J. 6 (1968) 1313.
#pragma once

#include <optional>
#include <string>

#include "reduce/common/progress.hpp"
#include "reduce/reduction/fixed_interface_body.hpp"
#include "reduce/reduction/mode_request.hpp"

namespace bielle::reduce {

/// Loads and fields that are linear in space: column 4 i + j is direction i times 1, x, y, z (j = 0..3), with
/// coordinates relative to the centre of mass. Every rigid acceleration and every centrifugal field is a linear
/// combination of them.
struct LinearFields {
  static constexpr int count = 12;
  RowMatrix inertia;  ///< (3 points, 12) M times the field [kg, kg m]
  RowMatrix held;     ///< (3 points, 12) displacement of the held body under these loads
};

struct Basis {
  RowMatrix shapes;                   ///< T (3 points, n)
  Eigen::MatrixXd released;           ///< (released directions, n): their values in T
  Eigen::VectorXd eigenvalues;        ///< omega^2 of Phi, then of the residual vectors [rad^2/s^2]
  Eigen::VectorXd residuals;          ///< relative residuals of the eigenpairs; residual vectors have none
  Eigen::Index residual_vectors = 0;  ///< number of residual vectors, the last of the modes
  std::optional<double> next;         ///< omega^2 of the first mode left out [rad^2/s^2]; absent: not sought, or none
  LinearFields linear;
  int solves = 0;      ///< columns that the eigenvalue iteration solved for
  int sweeps = 0;      ///< calls that it took: each reads the factor once
  std::string method;  ///< in words, see Eigenpairs

  Eigen::Index modes() const { return eigenvalues.size(); }
  Eigen::Index kept() const { return shapes.cols() - modes(); }
};

/// Radius of gyration of the body [m], which scales rotations to comparable displacements.
double radius_of_gyration(const MassProperties& body);

/// If modes are requested, one more is computed, to know the frequency of the first omitted mode.
/// @throws InputError if more modes are requested than the interior has degrees of freedom; ComputationError if they do
/// not converge
Basis make_basis(const Solid& solid, const BodyMatrices& matrices, const Ties& ties, const FixedInterfaceBody& held,
                 const MassProperties& body, const ModeRequest& modes, Progress& progress, int threads);

}  // namespace bielle::reduce

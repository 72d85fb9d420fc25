#include "reduce/matrices/matrix_study.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "reduce/dense/dense_products.hpp"
#include "reduce/dense/orthogonal_factors.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "reduce/reduction/rigid_motions.hpp"

namespace bielle::reduce {

namespace {

constexpr double independent = 1e-10;  // least eigenvalue of the Gram matrix of six independent motions, largest 1

void measure_box(MatrixStudy& study) {
  const MatrixSet& set = study.set;
  const Eigen::Index nodes = set.positions.cols(), points = set.shapes ? set.shapes->points.cols() : 0;
  Eigen::Matrix3Xd places(3, nodes + points);
  places.leftCols(nodes) = set.positions;
  if (points > 0) places.rightCols(points) = set.shapes->points;
  if (places.cols() == 0) return;
  const Eigen::Vector3d least = places.rowwise().minCoeff(), most = places.rowwise().maxCoeff();
  study.middle = (least + most) / 2;
  if ((most - least).norm() > 0) {
    study.length = (most - least).norm();
    return;
  }
  double masses = 0, inertias = 0;  // a single node: the arm of its inertia is the only length
  const Eigen::VectorXd diagonal = study.mass.diagonal();
  for (Eigen::Index k = 0; k < set.size(); ++k) {
    const NodalUnknown& u = set.unknowns[static_cast<std::size_t>(k)];
    if (!u.is_scalar()) (u.is_rotation() ? inertias : masses) += diagonal(k);
  }
  if (masses > 0 && inertias > 0) study.length = std::sqrt(inertias / masses);
}

/// Sets the scalars to their static response to the motions of the nodes.
void condense_scalars(const MatrixStudy& study, Eigen::MatrixXd& motions) {
  Unknowns nodal, scalar;
  for (Eigen::Index k = 0; k < study.size(); ++k)
    (study.set.unknowns[static_cast<std::size_t>(k)].is_scalar() ? scalar : nodal).push_back(k);
  if (scalar.empty()) return;
  const Eigen::MatrixXd forces =
      submatrix(study.stiffness, scalar, nodal) * Eigen::MatrixXd(motions(nodal, Eigen::all));
  if (forces.isZero(0)) return;
  motions(scalar, Eigen::all) =
      -definite_factor(submatrix(study.stiffness, scalar, scalar), study.threads)->solve(forces);
}

bool are_independent(const Eigen::MatrixXd& observed) {
  const Eigen::VectorXd norms = observed.colwise().norm();
  if (!(norms.minCoeff() > 0)) return false;
  const Eigen::MatrixXd unit = observed * norms.cwiseInverse().asDiagonal();
  return symmetric_eigenpairs(transposed_product(unit, unit)).values(0) > independent;
}

void find_geometric(MatrixStudy& study) {
  const MatrixSet& set = study.set;
  if (set.scalars() < set.size()) {
    Eigen::MatrixXd motions = nodal_rigid_motions(set, study.middle);
    if (!are_independent(study.observed(motions))) {
      study.no_geometric = "the unknowns of its nodes cannot follow all six rigid motions";
      return;
    }
    try {
      condense_scalars(study, motions);
      study.geometric = std::move(motions);
    } catch (const NotPositiveDefinite&) {
      study.no_geometric =
          "with its nodes held the body is not stiff in its scalars, which therefore do not follow nodes";
    }
    return;
  }
  if (!set.shapes) {
    study.no_geometric = "it has neither nodes nor shapes";
    return;
  }
  const Eigen::MatrixXd wanted = rigid_motions(set.shapes->points, study.middle);
  study.geometric = product(pseudo_inverse(set.shapes->displacement), wanted);
}

/// Finds six unknowns that determine a combination of six motions best: by pivoting, so that they are far apart.
Unknowns find_references(const MatrixStudy& study, const Eigen::MatrixXd& motions) {
  const bool nodal = study.set.scalars() < study.size();
  const Eigen::VectorXd diagonal = study.stiffness.diagonal(), mass = study.mass.diagonal();
  Eigen::MatrixXd rows = nodal ? study.observed(motions) : mass.cwiseAbs().cwiseSqrt().asDiagonal() * motions;
  const Eigen::VectorXd sizes = rows.colwise().norm().cwiseMax(1e-300);
  // A node without stiffness is not used as a reference, unless the interfaces move the body without deformation.
  const bool stiff = nodal && (rows.rowwise().squaredNorm().array() > 0 && diagonal.array() > 0).count() >= 6;
  for (Eigen::Index k = 0; k < study.size(); ++k)
    if (stiff && !(diagonal(k) > 0)) rows.row(k).setZero();
  Unknowns order = pivoted_columns(sizes.cwiseInverse().asDiagonal() * rows.transpose());
  order.resize(6);
  std::sort(order.begin(), order.end());
  return order;
}

/// Estimates the least eigenvalue of the held body by a few steps of inverse iteration.
double least_held_eigenvalue(const Factor& factor, const SparseColumns& mass) {
  Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(mass.cols(), 1, 2);
  double eigenvalue = 0;
  for (int step = 0; step < 8; ++step) {
    const Eigen::VectorXd momentum = mass * x;
    const Eigen::VectorXd answer = factor.solve(momentum);
    const double energy = answer.dot(momentum), answer_mass = answer.dot(mass * answer);
    if (!(energy > 0) || !(answer_mass > 0)) return 0;
    eigenvalue = energy / answer_mass;
    x = answer / std::sqrt(answer_mass);
  }
  return eigenvalue;
}

/// @param rigid  (n,6) rigid motions by which the references are chosen
/// @returns an estimate of the least eigenvalue of the body held at the references; 0: unknown
double find_statical(MatrixStudy& study, const Eigen::MatrixXd& rigid) {
  study.references = find_references(study, rigid);
  const Eigen::VectorXd diagonal = study.stiffness.diagonal();
  Unknowns rest;
  for (Eigen::Index k = 0; k < study.size(); ++k)
    if (diagonal(k) != 0 && !std::binary_search(study.references.begin(), study.references.end(), k)) rest.push_back(k);
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(study.size(), 6);
  for (Eigen::Index k = 0; k < 6; ++k) motions(study.references[static_cast<std::size_t>(k)], k) = 1;
  if (rest.empty()) {
    study.statical = std::move(motions);
    return 0;
  }
  try {
    const std::unique_ptr<Factor> factor = definite_factor(submatrix(study.stiffness, rest, rest), study.threads);
    motions(rest, Eigen::all) = -factor->solve(Eigen::MatrixXd(submatrix(study.stiffness, rest, study.references)));
    study.statical = std::move(motions);
    return least_held_eigenvalue(*factor, submatrix(study.mass, rest, rest));
  } catch (const NotPositiveDefinite& error) {
    study.no_statical = fmt::format(
        "held in six unknowns that fix every rigid motion, the body still moves without stiffness at {}, or its "
        "stiffness is negative there",
        study.set.name_of(rest[static_cast<std::size_t>(error.unknown())]));
    return 0;
  }
}

/// Returns a shift for a body of which nothing else is known: far below the highest omega^2.
double shift_by_diagonals(const MatrixStudy& study) {
  const Eigen::VectorXd k = study.stiffness.diagonal(), m = study.mass.diagonal();
  std::vector<double> ratios;
  for (Eigen::Index i = 0; i < k.size(); ++i)
    if (k(i) > 0 && m(i) > 0) ratios.push_back(k(i) / m(i));
  if (ratios.empty()) return 0;
  std::nth_element(ratios.begin(), ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2), ratios.end());
  return 1e-6 * ratios[ratios.size() / 2];
}

void find_modes(MatrixStudy& study, double shift) {
  const auto with_mass = static_cast<int>((Eigen::VectorXd(study.mass.diagonal()).array() > 0).count());
  const int count = std::min(6 + elastic_modes, with_mass);
  if (!(shift > 0)) shift = shift_by_diagonals(study);
  if (count == 0 || shift == 0) {
    study.no_modes = "no unknown has both mass and stiffness";
    return;
  }
  for (int trial = 0; trial < 4; ++trial, shift *= 100) try {
      study.modes = natural_modes(study.stiffness, study.mass, count, shift, study.threads);
      return;
    } catch (const NotPositiveDefinite&) {
      study.no_modes = "stiffness and mass together are not positive definite";
    } catch (const ComputationError& error) {
      study.no_modes = error.what();
      return;
    }
}

}  // namespace

Eigen::MatrixXd MatrixStudy::observed(const Eigen::MatrixXd& motions) const {
  if (set.scalars() == set.size()) return set.shapes ? product(set.shapes->displacement, motions) : motions;
  Eigen::MatrixXd result = motions;
  for (Eigen::Index k = 0; k < size(); ++k) {
    const NodalUnknown& u = set.unknowns[static_cast<std::size_t>(k)];
    if (u.is_scalar()) result.row(k).setZero();
    if (u.is_rotation()) result.row(k) *= length;
  }
  return result;
}

Eigen::MatrixXd MatrixStudy::relative_forces(const Eigen::MatrixXd& motions) const {
  Eigen::VectorXd root = Eigen::VectorXd(stiffness.diagonal()).cwiseMax(0).cwiseSqrt();
  // Rigid amplitudes have no stiffness of their own. A small one is used instead, because their motion would otherwise
  // have no size.
  constexpr double small = 1e-4;
  const double largest = std::max(root.maxCoeff(), 1e-300);
  root = Eigen::VectorXd((root.array() > 0).select(root, small * largest));
  const Eigen::VectorXd sizes = (root.asDiagonal() * motions).cwiseAbs().colwise().maxCoeff();
  const Eigen::MatrixXd forces = stiffness * motions;
  return root.cwiseInverse().asDiagonal() * forces * sizes.cwiseMax(1e-300).cwiseInverse().asDiagonal();
}

MatrixStudy study_matrices(const MatrixSet& set, int threads) {
  MatrixStudy study{set,
                    threads,
                    symmetric_part(set.stiffness),
                    symmetric_part(set.mass),
                    1,
                    Eigen::Vector3d::Zero(),
                    {},
                    "",
                    {},
                    {},
                    "",
                    {},
                    ""};
  measure_box(study);
  find_geometric(study);
  study.no_statical = study.no_geometric;
  find_modes(study, study.geometric ? find_statical(study, *study.geometric) : 0);
  // Positions may be wrong, so that the references do not determine the rigid motion: the modes choose others.
  const bool nodal = set.scalars() < set.size();
  if (nodal && !study.statical && study.modes && study.modes->eigenvalues.size() >= 6)
    find_statical(study, study.modes->vectors.leftCols(6));
  return study;
}

}  // namespace bielle::reduce

#include "reduce/matrices/reduce_matrices.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "reduce/common/build.hpp"
#include "reduce/common/counted.hpp"
#include "reduce/common/error.hpp"
#include "reduce/dense/dense_products.hpp"
#include "reduce/dense/symmetric_factors.hpp"
#include "reduce/fe/elasticity.hpp"
#include "reduce/matrices/held_matrices.hpp"
#include "reduce/matrices/inertia_loads.hpp"
#include "reduce/matrices/matrix_basis.hpp"
#include "reduce/matrices/node_interfaces.hpp"
#include "reduce/matrices/rigid_boundary.hpp"
#include "reduce/matrices/set_algebra.hpp"
#include "reduce/matrices/set_points.hpp"
#include "reduce/matrices/set_recovery.hpp"
#include "reduce/matrices/verification.hpp"
#include "reduce/reduction/basis.hpp"
#include "reduce/reduction/reduced_matrices.hpp"
#include "reduce/reduction/rigid_motions.hpp"
#include "reduce/superelement/physical_check.hpp"

namespace bielle::reduce {

namespace {

/// |a_ij - a_ji| <= this times sqrt(a_ii a_jj): text formats have at least eight digits.
constexpr double symmetric_digits = 1e-6;
/// Replaces a matrix by its symmetric part. @throws InputError that names the worst pair
void make_symmetric(const MatrixSet& set, const char* name, SparseColumns& matrix) {
  if (matrix.size() == 0) return;
  const SparseColumns difference = matrix - SparseColumns(matrix.transpose());
  const Eigen::VectorXd diagonal = matrix.diagonal().cwiseAbs();
  const double least = diagonal.size() > 0 ? 1e-12 * diagonal.maxCoeff() : 0;
  for (Eigen::Index j = 0; j < difference.outerSize(); ++j)
    for (SparseColumns::InnerIterator entry(difference, j); entry; ++entry) {
      const double scale = std::sqrt(std::max(diagonal(entry.row()), least) * std::max(diagonal(j), least));
      if (!(std::abs(entry.value()) > symmetric_digits * scale)) continue;
      throw InputError(
          fmt::format("{}: the {} is not symmetric: its entries ({}, {}) and ({}, {}) are {:.9g} and {:.9g}; a file "
                      "with one triangle "
                      "alone must say so in its header",
                      set.source, name, set.name_of(entry.row()), set.name_of(j), set.name_of(j),
                      set.name_of(entry.row()), matrix.coeff(entry.row(), j), matrix.coeff(j, entry.row())));
    }
  matrix = symmetric_part(matrix);
}

std::string told_mass(const MatrixSet& set, double mass) {
  return fmt::format("{}: moved as a whole, the body has the mass {:.6g} kg; a mass matrix is needed", set.source,
                     mass);
}

/// @throws InputError for a mass without entries, or with a negative entry on its diagonal that is no rounding
void check_mass_entries(const MatrixSet& set) {
  const Eigen::VectorXd sizes = largest_entries(set.mass);
  if (sizes.isZero(0)) throw InputError(told_mass(set, 0));
  const Eigen::VectorXd diagonal = set.mass.diagonal();
  for (Eigen::Index k = 0; k < set.size(); ++k)
    if (diagonal(k) < -text_rounding * sizes(k))
      throw InputError(fmt::format("{}: the mass has a negative entry on its diagonal, {:.6g} at {}", set.source,
                                   diagonal(k), set.name_of(k)));
}

void prepare(MatrixSet& set, Progress& progress) {
  clear_rounding(set);
  make_symmetric(set, "stiffness", set.stiffness);
  make_symmetric(set, "mass", set.mass);
  make_symmetric(set, "damping", set.damping);
  make_symmetric(set, "geometric stiffness", set.geometric_stiffness);
  if (const Eigen::Index removed = remove_empty_unknowns(set); removed > 0)
    progress.note(fmt::format("{} without any stiffness and mass {} left out", counted(removed, "unknown"),
                              removed == 1 ? "is" : "are"));
  if (set.size() == 0) throw InputError(fmt::format("{}: stiffness and mass are zero", set.source));
  check_mass_entries(set);
}

constexpr double least_mass = 1e-100;  ///< [kg]; squares and products of smaller ones vanish

/// Mass properties of M~ under rigid motions. Masses along x, y and z that differ in their last digits need iterations.
MassProperties mass_of(const MatrixSet& set, Superelement body) {
  body.centre.setZero();
  for (int iteration = 0; iteration < 4; ++iteration) {
    const ReducedMassProperties found = reduced_mass_properties(body);
    if (!(found.mass > least_mass)) throw InputError(told_mass(set, found.mass));
    body.total_mass = found.mass;
    body.centre = found.centre;
    body.inertia = (found.inertia + found.inertia.transpose()) / 2;
  }
  return mass_properties(body);
}

/// @throws InputError for a reduced mass that is not positive: no mechanism can be moved with it
void check_reduced_mass(const MatrixSet& set, const Eigen::MatrixXd& mass, int threads) {
  const std::optional<LeastEigenvalue> least = least_scaled_eigenvalue(mass.sparseView(), threads);
  if (least && least->value < -text_rounding)
    throw InputError(fmt::format(
        "{}: the mass is not positive: reduced and scaled to a unit diagonal, its least eigenvalue is {:.3g}",
        set.source, least->value));
}

/// Adds inertia to coordinates without any: a mechanism needs it in every coordinate. Lumped masses leave rotations of
/// nodes without any: these get a hundred-millionth of the body's own.
void add_missing_inertia(const MassProperties& whole, Superelement& body, Progress& progress) {
  constexpr double share = 1e-8;
  const Eigen::VectorXd scale = body.mass.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  if (body.mass.diagonal().minCoeff() > 0 &&
      is_positive_definite(scale.asDiagonal() * body.mass * scale.asDiagonal() -
                           1e-13 * Eigen::MatrixXd::Identity(body.size(), body.size())))
    return;
  Eigen::Index row = 0;
  for (const Interface& interface : body.interfaces)
    for (std::size_t axis = 0; axis < 6; ++axis)
      if (interface.kept[axis]) {
        body.mass(row, row) += share * (axis < 3 ? whole.mass : whole.inertia.trace() / 3);
        ++row;
      }
  progress.note(
      fmt::format("some directions of interfaces move no mass, as with lumped masses: each direction gets "
                  "{:.0e} of the mass or inertia of the body",
                  share));
}

void add_recovery(const PointMotions& motions, const Eigen::MatrixXd& shapes, Superelement& body) {
  body.mesh.points = motions.points;
  body.mesh.cells = motions.cells;
  body.displacement_recovery = motions.displacement * shapes;
  if (body.mesh.points.cols() > 0)
    put_exact_rigid_motions(body.interfaces, mass_properties(body), body.mesh.points, body.displacement_recovery);
}

/// Returns the damping. That of the file acts on deformation alone, as all damping of a superelement.
Eigen::MatrixXd damping_of(const MatrixSet& set, const MatrixOptions& options, const Eigen::MatrixXd& shapes,
                           const FreeModes& free, const Superelement& body, const Eigen::MatrixXd& rigid) {
  if (options.rayleigh) return (*options.rayleigh)[0] * body.mass + (*options.rayleigh)[1] * body.stiffness;
  if (!options.damping_ratios.empty() || set.damping.size() == 0)
    return modal_damping(free, body.mass, options.damping_ratios);
  const Eigen::Index kept = body.interface_directions();
  Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(body.size(), body.size());
  rest.topLeftCorner(kept, kept) -=
      product(rigid.topRows(kept),
              nearest_rigid_motion(body.interfaces, body.centre, radius_of_gyration(mass_properties(body))));
  const Eigen::MatrixXd whole = congruent(transposed_product(shapes, set.damping * shapes), rest);
  return (whole + whole.transpose()) / 2;
}

void add_spin_stiffness(const MatrixSet& set, const MatrixOptions& options, const Eigen::MatrixXd& shapes,
                        Superelement& body, Progress& progress) {
  if (!options.spin) {
    progress.note(
        set.geometric_stiffness.size() > 0
            ? "the geometric stiffness of the file is left out, since its load is not known: `spin` tells the "
              "angular velocity it belongs to"
            : "geometric stiffness is left out: the matrices do not have it, so that neither spin nor load "
              "stiffens or softens the body");
    return;
  }
  if (set.geometric_stiffness.size() == 0)
    throw InputError("spin", "the file has no geometric stiffness that could belong to it");
  Eigen::Index axis = 0;
  const double rate = options.spin->cwiseAbs().maxCoeff(&axis);
  if (!(rate > 0) || std::abs(options.spin->norm() - rate) > 1e-9 * rate)
    throw InputError("spin", "expected an angular velocity along one axis of the body, e.g. [0, 0, 100]");
  const Eigen::MatrixXd reduced = transposed_product(shapes, set.geometric_stiffness * shapes) / (rate * rate);
  for (Eigen::MatrixXd& matrix : body.spin_stiffness) matrix.setZero(body.size(), body.size());
  body.spin_stiffness[static_cast<std::size_t>(axis)] = (reduced + reduced.transpose()) / 2;
}

Eigen::MatrixXd relief_loads(const MatrixSet& set, const MatrixOptions& options, const NodeTies& ties,
                             const MatrixBasis& basis) {
  if (!options.inertia_relief) return {};
  return inertia_loads(set, ties, basis, set.positions.rowwise().mean());
}

std::string told_relief(const MatrixSet& set, Eigen::Index residual_vectors) {
  if (set.scalars() > 0)
    return "inertia_relief: amplitudes of modes do not tell how centrifugal fields act on them, so that only the six "
           "rigid accelerations are relieved, as far as the modes of the file allow";
  if (residual_vectors == 0)
    return "inertia_relief: no residual vectors are needed, the modes represent the response to all accelerations";
  return fmt::format("inertia_relief: with {}, the answer to all accelerations is complete",
                     counted(residual_vectors, "residual vector"));
}

std::vector<Check> checks_of(const Superelement& body) {
  std::vector<Check> checks;
  for (const Check& check : check_superelement(body))
    if (check.name.find("spin") == std::string::npos && check.name.find("geometric") == std::string::npos)
      checks.push_back(check);
  return checks;
}

}  // namespace

Superelement reduce_matrices(MatrixSet& set, const MatrixOptions& options, Progress& progress, int threads,
                             ReductionReport* report) {
  progress.start("matrices");
  prepare(set, progress);
  name_rows(options.quantity_rows, set.quantities);
  const NodeTies ties = tie_nodes(set, options.interfaces.empty() ? default_interfaces(set) : options.interfaces);
  progress.start("factorisation");
  const HeldMatrices held(set, ties, threads);
  MatrixBasis basis = matrix_basis(set, ties, held, options, progress, threads);
  const PointMotions motions = point_motions(set);
  const std::vector<SetPoint> points = set_points(set, motions, options.points);
  const Eigen::Index residual_vectors =
      add_residual_vectors(set, ties, held, points, relief_loads(set, options, ties, basis), basis);
  if (options.inertia_relief) progress.note(told_relief(set, residual_vectors));

  progress.start("reduced matrices");
  const Eigen::MatrixXd& T = basis.shapes;
  const Eigen::Index kept = ties.carry.cols(), modes = basis.eigenvalues.size(), size = kept + modes;
  Superelement body;
  body.name = options.name.empty() ? set.name : options.name;
  body.created_by = created_by("bielle-reduce");
  body.input = options.input_text.empty() ? fmt::format("# from {}\n", set.source) : options.input_text;
  body.interfaces = ties.interfaces;
  body.frequencies = basis.eigenvalues.cwiseSqrt() / (2 * std::numbers::pi);
  body.residual_vectors = residual_vectors;
  body.stiffness.setZero(size, size);
  const Eigen::MatrixXd mass = transposed_product(T, set.mass * T);
  body.mass = (mass + mass.transpose()) / 2;
  const MassProperties entered = mass_of(set, body);
  check_reduced_mass(set, body.mass, threads);
  add_missing_inertia(entered, body, progress);
  const MassProperties properties = mass_of(set, body);
  body.total_mass = properties.mass;
  body.centre = properties.centre;
  body.inertia = properties.inertia;
  const Eigen::MatrixXd boundary = T.leftCols(kept);
  body.stiffness.topLeftCorner(kept, kept) =
      boundary_stiffness(set, ties, transposed_product(boundary, set.stiffness * boundary), properties);
  body.stiffness.bottomRightCorner(modes, modes) = basis.eigenvalues.asDiagonal();

  const Eigen::MatrixXd rigid = rigid_coordinates(body, body.centre);
  const FreeModes free = free_modes(body.stiffness, body.mass, rigid);
  const BodyInertia inertia = body_inertia(set, T, body.interfaces, body.mass, properties, rigid, free.vectors);
  body.inertia_components = inertia.components;
  body.inertia_answer = inertia_answer_of(set, ties, held, basis, body.centre);
  body.effective_mass = (body.mass.bottomLeftCorner(modes, kept) * rigid.topRows(kept)).cwiseAbs2();
  body.damping = about(
      "damping", [&] { return damping_of(set, options, T, free, body, rigid); }, Subject::hidden);
  add_spin_stiffness(set, options, T, body, progress);
  progress.note(inertia.told());
  progress.start("points and recovery");
  add_recovery(motions, T, body);
  add_set_recovery(set, T, body);
  if (body.stress_recovery.size() == 0)
    progress.note(
        "no stress is recovered at nodes: the file has no matrix for it, and stiffness and mass do not tell it");
  for (const SetPoint& point : points)
    body.points[point.request.name] = {point.position, product(point.rows, T), point.request.residual};

  if (const std::string fault = physical_fault_of(body); !fault.empty())
    throw InputError(fmt::format("{}: the matrices make no superelement: {}", set.source, fault));

  progress.start("checks");
  const std::vector<Check> checks = checks_of(body);
  for (const Check& check : checks) body.checks[check.name] = check.value;
  body.checks["unknown_inertia_share"] = inertia.unknown_share;
  progress.finish();
  fail_when_a_check_does(checks, "the reduced body");
  if (report) {
    report->points = set.positions.cols();
    report->factor = held.statistics();
    report->method = basis.method;
    report->solves = basis.solves;
    report->sweeps = basis.sweeps;
    report->checks = checks;
  }
  return body;
}

}  // namespace bielle::reduce

#include "reduce/reduction/reduce_body.hpp"

#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "reduce/common/build.hpp"
#include "reduce/common/counted.hpp"
#include "reduce/common/error.hpp"
#include "reduce/dense/dense_products.hpp"
#include "reduce/mesh/checks.hpp"
#include "reduce/reduction/adequacy.hpp"
#include "reduce/reduction/basis.hpp"
#include "reduce/reduction/free_body.hpp"
#include "reduce/reduction/inertia_answer.hpp"
#include "reduce/reduction/integration_checks.hpp"
#include "reduce/reduction/load_patterns.hpp"
#include "reduce/reduction/missed_modes.hpp"
#include "reduce/reduction/mode_turns.hpp"
#include "reduce/reduction/point_ties.hpp"
#include "reduce/reduction/recovery.hpp"
#include "reduce/reduction/reduced_matrices.hpp"
#include "reduce/reduction/residual_vectors.hpp"
#include "reduce/reduction/rigid_motions.hpp"
#include "reduce/reduction/told_masses.hpp"

namespace bielle::reduce {

namespace {

constexpr Eigen::Index most_load_stiffnesses = 60;  // their memory grows with the cube of the number of directions

/// K~ = T^T K T: Psi^T K Psi and omega^2. Psi^T K Phi = 0 and Psi^T K U = 0 hold by construction; the numerical errors
/// are returned.
struct ReducedStiffness {
  Eigen::MatrixXd matrix;
  double rigid_force = 0;     ///< largest entry of Psi^T K U before it was set to zero, over the root of the diagonals
  double coupling = 0;        ///< largest entry of Psi^T K Phi over omega^2 and the root of the diagonal of M~
  double mode_stiffness = 0;  ///< largest relative difference between phi^T K phi and omega^2
};

ReducedStiffness reduce_stiffness(const BodyMatrices& matrices, const Basis& basis,
                                  const std::vector<Interface>& interfaces, const MassProperties& body,
                                  const Eigen::MatrixXd& mass) {
  const Eigen::Index n = basis.shapes.cols(), kept = basis.kept(), modes = basis.modes();
  const Eigen::MatrixXd full = inner_products(basis.shapes, matrices.stiffness_times(basis.shapes));
  ReducedStiffness result{Eigen::MatrixXd::Zero(n, n)};
  const Eigen::MatrixXd boundary = full.topLeftCorner(kept, kept);
  const Eigen::MatrixXd rigid = interface_rigid_motions(interfaces, body.centre);
  const Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(kept, kept) -
                               product(rigid, nearest_rigid_motion(interfaces, body.centre, radius_of_gyration(body)));
  const Eigen::MatrixXd elastic = congruent(boundary, rest);
  result.matrix.topLeftCorner(kept, kept) = (elastic + elastic.transpose()) / 2;
  if (kept > rigid.cols()) {
    result.rigid_force = relative_force(boundary, mass.topLeftCorner(kept, kept), rigid);
  } else {
    result.matrix.topLeftCorner(kept, kept).setZero();  // six directions move the body rigidly, and no rounding is left
  }
  result.matrix.bottomRightCorner(modes, modes) = basis.eigenvalues.asDiagonal();
  for (Eigen::Index k = 0; k < modes; ++k) {
    const double omega2 = basis.eigenvalues(k);
    result.mode_stiffness = std::max(result.mode_stiffness, std::abs(full(kept + k, kept + k) / omega2 - 1));
    for (Eigen::Index b = 0; b < kept; ++b) {
      result.coupling = std::max(result.coupling, std::abs(full(b, kept + k)) / (omega2 * std::sqrt(mass(b, b))));
    }
  }
  return result;
}

/// Returns (phi^T M U)^2, U rigid motions about the centre.
Eigen::MatrixXd effective_masses(const Superelement& body) {
  const Eigen::Index kept = body.interface_directions(), modes = body.modes();
  const Eigen::MatrixXd participation =
      body.mass.bottomLeftCorner(modes, kept) * interface_rigid_motions(body.interfaces, body.centre);
  return participation.cwiseAbs2();
}

void warn_about_rigid_ties(const Ties& ties, Progress& progress) {
  std::string names;
  for (std::size_t i = 0; i < ties.interfaces.size(); ++i) {
    if (ties.surfaces[i].tie == Tie::rigid) {
      names += (names.empty() ? "" : ", ") + ties.interfaces[i].name;
    }
  }
  if (!names.empty()) {
    progress.note(
        fmt::format("rigid ties ({}) stiffen the body, and its free-free frequencies come out too high; where the "
                    "surface is not backed by something stiff, 'tie: average' leaves it flexible",
                    names));
  }
}

/// Warns if the full matrices need much memory: stiffness, mass, damping, six inertia components and six geometric
/// stiffnesses.
void warn_about_size(Eigen::Index coordinates, Progress& progress) {
  const double gigabytes = 15 * 8e-9 * static_cast<double>(coordinates) * static_cast<double>(coordinates);
  if (gigabytes > 1) {
    progress.warn(
        fmt::format("the superelement gets {} coordinates, and its matrices {:.0f} GB; free ties cost three for "
                    "each node of their surface",
                    coordinates, gigabytes));
  }
}

/// Returns a superelement without its matrices: names, interfaces, frequencies and mass properties.
Superelement described_body(const ReductionOptions& options, const MassProperties& properties, const Ties& ties,
                            const Basis& basis) {
  Superelement body;
  body.name = options.name;
  body.created_by = created_by("bielle-reduce");
  body.input = options.input_text;
  body.interfaces = ties.interfaces;
  body.frequencies = basis.eigenvalues.cwiseSqrt() / (2 * std::numbers::pi);
  body.residual_vectors = basis.residual_vectors;
  body.total_mass = properties.mass;
  body.centre = properties.centre;
  body.inertia = properties.inertia;
  return body;
}

Eigen::MatrixXd damping_matrix(const ReductionOptions& options, const Superelement& body) {
  if (options.rayleigh) return (*options.rayleigh)[0] * body.mass + (*options.rayleigh)[1] * body.stiffness;
  Eigen::MatrixXd rigid = Eigen::MatrixXd::Zero(body.size(), 6);
  rigid.topRows(body.interface_directions()) = interface_rigid_motions(body.interfaces, body.centre);
  return modal_damping(free_modes(body.stiffness, body.mass, rigid), body.mass, options.damping_ratios);
}

/// Runs the checks of every superelement, and those that need the mesh.
std::vector<Check> check_reduction(const Superelement& body, const ReducedStiffness& reduced, const Basis& basis) {
  std::vector<Check> checks = check_superelement(body);
  checks.push_back(
      {"rigid_motion_force_on_mesh", reduced.rigid_force, 1e-4, "moved as a whole, the mesh feels no force"});
  checks.push_back({"stiffness_coupling", reduced.coupling, 1e-4, "moving interfaces does not strain the modes"});
  if (basis.modes() > 0) {
    checks.push_back(
        {"mode_stiffness", reduced.mode_stiffness, 1e-4, "the energy of each mode is that of its frequency"});
  }
  if (basis.residuals.size() > 0) {
    checks.push_back({"mode_residual", basis.residuals.maxCoeff(), 1e-6, "each mode is one of the mesh"});
  }
  return checks;
}

/// Reports the count of the modes, or that it was impossible.
std::optional<ModeCount> prove_modes(const BodyMatrices& matrices, const FixedInterfaceBody& held, const Basis& basis,
                                     Progress& progress) {
  if (basis.modes() == 0) return std::nullopt;
  progress.start("count of the modes");
  const std::optional<ModeCount> count = count_modes(matrices, held, basis);
  if (!count) {
    progress.warn("modes.proof",
                  "that no mode was missed could not be proven, since the modes are too close to each other or the "
                  "pivots too small; with another count it may be possible");
  } else if (count->counted == count->found) {
    progress.note(fmt::format("{} below {:.6g} Hz, counted by the signs of the pivots, and as many were found",
                              counted(count->counted, "mode"), count->below));
  }
  return count;
}

Check missed_modes(const ModeCount& count) {
  return {"missed_modes", static_cast<double>(std::abs(count.counted - count.found)), 0,
          fmt::format("of the {} below {:.6g} Hz, all were found", counted(count.counted, "mode"), count.below)};
}

void warn_of_hourglass_modes(const Solid& solid, const Basis& basis, Progress& progress, int threads) {
  constexpr double most = 2;  // times the energy of the mode; modes that the mesh resolves have at most 1.2
  const std::optional<HourglassMode> worst = worst_hourglass_mode(solid, basis, threads);
  if (!worst || worst->ratio <= most) return;
  progress.warn(
      "integration",
      fmt::format("fixed-boundary mode {} at {:.6g} Hz is an hourglass mode: with full integration it would "
                  "have {:.3g} times its strain energy; leave 'integration: reduced' out",
                  worst->mode + 1, std::sqrt(basis.eigenvalues(worst->mode)) / (2 * std::numbers::pi), worst->ratio));
}

/// Adds the vectors that loads and points request, and those for the body's own inertia.
void add_all_residual_vectors(const ReductionOptions& options, std::vector<ResidualRequest> requests,
                              const BodyMatrices& matrices, const FixedInterfaceBody& held, Basis& basis,
                              Progress& progress) {
  const bool relieved = options.inertia_relief;
  if (relieved) requests.push_back(inertia_relief(basis.linear));
  if (requests.empty()) return;
  progress.start("residual vectors");
  add_residual_vectors(requests, matrices, held, basis);
  if (relieved && basis.residual_vectors == 0)
    progress.note(
        "inertia_relief: no residual vectors are needed, the modes represent the response to all accelerations");
}

}  // namespace

Superelement reduce_body(const Mesh& mesh, const ReductionOptions& options, Progress& progress, int threads,
                         ReductionReport* report, const MatrixMaker& make) {
  progress.start("stiffness and mass");
  check_connected(mesh);
  const Solid solid = requested_solid(mesh, options);
  AddedMasses masses(solid, options.masses, options.name);
  for (const std::string& text : told_masses(solid, masses, options)) progress.note(text);
  const MassProperties properties = with_masses(mass_properties(solid, threads), masses);
  const Ties ties = make_ties(solid, options.interfaces);
  const std::vector<TiedPoint> points = tie_points(solid, options.points, options.name);
  std::vector<ResidualRequest> residual = residual_requests(solid, options.loads, points);
  warn_about_rigid_ties(ties, progress);
  warn_about_size(static_cast<Eigen::Index>(ties.kept.size()) + options.modes.count.value_or(0), progress);
  HeldFreedoms freedoms(solid, ties);
  const std::unique_ptr<BodyMatrices> kept_matrices = make(solid, freedoms.interior(), threads);
  kept_matrices->put_on(std::move(masses));
  const BodyMatrices& matrices = *kept_matrices;

  if (options.modes_proven && !matrices.can_count_signs())
    throw InputError("modes", "proof: modes are counted by bielle-reduce alone, not on ranks", Subject::hidden);

  progress.start("factorisation");
  const FixedInterfaceBody held(std::move(freedoms), solid, matrices, ties, threads);
  Basis basis = about(
      "modes", [&] { return make_basis(solid, matrices, ties, held, properties, options.modes, progress, threads); },
      Subject::hidden);
  if (options.integration == Integration::reduced) warn_of_hourglass_modes(solid, basis, progress, threads);
  const std::optional<ModeCount> count =
      options.modes_proven ? prove_modes(matrices, held, basis, progress) : std::nullopt;
  add_all_residual_vectors(options, std::move(residual), matrices, held, basis, progress);

  progress.start("reduced matrices");
  Superelement body = described_body(options, properties, ties, basis);
  body.inertia_components = inertia_components(basis.shapes, matrices);
  body.mass = body.inertia_components[0] + body.inertia_components[1] + body.inertia_components[2];
  const ReducedStiffness reduced = reduce_stiffness(matrices, basis, ties.interfaces, properties, body.mass);
  body.stiffness = reduced.matrix;
  body.effective_mass = effective_masses(body);
  body.damping = about(
      "damping", [&] { return damping_matrix(options, body); }, Subject::hidden);
  body.inertia_answer = inertia_answer_energies(basis);

  progress.start("geometric stiffness");
  GeometricStiffness geometric = geometric_stiffness(solid, matrices, ties, basis, properties, body.stiffness,
                                                     basis.kept() <= most_load_stiffnesses, progress);
  body.spin_stiffness = std::move(geometric.spin);
  body.load_stiffness = std::move(geometric.load);
  body.surface_rotations = std::move(geometric.rotations);
  if (body.load_stiffness.empty()) {
    progress.note(
        fmt::format("{} kept directions are more than {}: the geometric stiffness of interface loads is left out, "
                    "that of spins is not",
                    basis.kept(), most_load_stiffnesses));
  }

  progress.start("loads and recovery");
  body.loads = reduce_loads(solid, options.loads, basis.shapes);
  body.points = named_points(points, basis.shapes);
  body.mode_turns = mode_turns(solid, basis.shapes, basis.kept(), options.name);
  body.strains = place_strains(solid, basis.shapes, options.name);
  add_recovery(solid, options, basis.shapes, threads, body);

  if (options.judged) {
    progress.start("range of validity");
    body.adequacy = measure_adequacy({solid, matrices, ties, held, basis}, body, geometric.load_fields, threads);
    body.adequacy->wanted = options.modes.below.value_or(0);
  }

  progress.start("checks");
  std::vector<Check> checks = check_reduction(body, reduced, basis);
  if (count) checks.push_back(missed_modes(*count));
  for (const Check& check : checks) {
    body.checks[check.name] = check.value;
  }
  progress.finish();
  fail_when_a_check_does(checks, "the reduced body");
  if (report) {
    *report = {
        mesh.point_count(), solid.cells.size(), held.statistics(), basis.method, basis.solves, basis.sweeps, checks};
  }
  return body;
}

}  // namespace bielle::reduce

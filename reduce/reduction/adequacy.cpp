#include "reduce/reduction/adequacy.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reduce/fe/mesh_error.hpp"
#include "reduce/mesh/checks.hpp"
#include "reduce/mesh/wall_thickness.hpp"
#include "reduce/reduction/checks.hpp"
#include "reduce/reduction/enrichment.hpp"
#include "reduce/reduction/tie_release.hpp"

namespace bielle::reduce {

namespace {

constexpr Eigen::Index most_examined = 16, least_examined = 3, most_meshed = 6, most_released = 6;
constexpr double hertz = 2 * std::numbers::pi;

/// Returns the number of the lowest free modes that are examined: those below the first omitted mode, but at least a
/// few.
Eigen::Index examined(const Eigen::VectorXd& omega, double next_mode) {
  const Eigen::Index below = next_mode > 0 ? (omega.array() < hertz * next_mode).count() : omega.size();
  return std::min(omega.size(), std::clamp(below, least_examined, most_examined));
}

/// Returns the relative excess of frequencies over others. A negative value, which rounding may cause, is replaced by
/// 0.
Eigen::VectorXd excess(const Eigen::VectorXd& lambda, const Eigen::VectorXd& lower) {
  return (lambda.array() / lower.array()).sqrt().cwiseMax(1) - 1;
}

/// Returns the share of the modes in the energy of the held body under accelerations along x, y and z.
Eigen::Vector3d inertia_answer(const Basis& basis) {
  Eigen::Vector3d share = Eigen::Vector3d::Ones();
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::VectorXd load = basis.linear.inertia.col(4 * axis);
    const double all = load.dot(basis.linear.held.col(4 * axis));
    if (!(all > 0)) continue;
    const Eigen::VectorXd participation = basis.shapes.rightCols(basis.modes()).transpose() * load;
    share(axis) = (participation.array().square() / basis.eigenvalues.array()).sum() / all;
  }
  return share;
}

void measure_frequencies(const FullModel& model, const Superelement& body, RowMatrix& lowest, Adequacy& result) {
  const FreeModes free = free_modes(body.stiffness, body.mass, rigid_coordinates(body, body.centre));
  const Eigen::Index count = examined(free.omega, result.next_mode);
  result.frequencies = free.omega.head(count) / hertz;
  if (count == 0) return;
  const Eigen::MatrixXd amplitudes = free.vectors.leftCols(count);
  const Eigen::VectorXd lambda = free.omega.head(count).cwiseAbs2();
  const RowMatrix modes = model.basis.shapes * amplitudes;
  RowMatrix forces = model.matrices.stiffness_times(modes);
  forces -= model.matrices.mass_times(modes) * lambda.asDiagonal();
  const RowMatrix answers = model.held.expand(model.held.solve(model.held.restrict(forces)));
  const EnrichedModes enriched = enriched_modes(model, body, free, answers, count);
  result.mode_error = excess(lambda, enriched.eigenvalues);
  result.mode_mac = enriched.assurance;
  lowest = modes.leftCols(std::min(count, most_meshed));
  const Eigen::Index few = std::min(count, most_released);
  const RowMatrix released = deformation_without_rigid_ties(model, forces.leftCols(few));
  if (released.cols() > 0)
    result.tie_error = excess(lambda.head(few), enriched_modes(model, body, free, released, few).eigenvalues);
}

}  // namespace

Adequacy measure_adequacy(const FullModel& model, const Superelement& body, const RowMatrix& load_fields, int threads) {
  Adequacy result;
  result.next_mode = model.basis.next ? std::sqrt(*model.basis.next) / hertz : 0;
  const bool plain = model.solid.integration == Integration::plain;
  const auto& ranges = model.solid.cells.ranges();
  const bool locks = std::any_of(ranges.begin(), ranges.end(), [&](const SolidCells::Range& range) {
    return cell_info(range.type).locks || (plain && range.type == CellType::hex8);
  });
  result.order = locks ? 1 : 2;
  result.one_element_thick = share_one_element_thick(model.solid.mesh);
  result.least_jacobian = mesh_quality(model.solid.mesh).least_scaled_jacobian;
  for (std::size_t i = 0; i < model.ties.interfaces.size(); ++i)
    if (model.ties.surfaces[i].tie == Tie::rigid) result.rigid_ties.push_back(model.ties.interfaces[i].name);
  result.inertia_answer = inertia_answer(model.basis);
  RowMatrix lowest(3 * model.solid.points(), 0);
  measure_frequencies(model, body, lowest, result);

  const Eigen::Index modes = lowest.cols(), loads = load_fields.cols();
  RowMatrix fields(lowest.rows(), modes + loads);
  fields.leftCols(modes) = lowest;
  if (loads > 0) fields.rightCols(loads) = load_fields;
  const MeshError mesh = estimate_mesh_error(model.solid, fields, threads);
  result.mesh_error = (1 / (1 - mesh.relative.head(modes).array().square()).sqrt() - 1).matrix();
  result.stress_error = mesh.relative.tail(loads);
  result.worst_place = mesh.worst_place;
  return result;
}

}  // namespace bielle::reduce

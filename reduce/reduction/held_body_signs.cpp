// The pivots of K - sigma M of the held body: its inside as it was factorised, bordered by what the factor leaves out.
#include <cmath>

#include "reduce/reduction/held_body.hpp"
#include "reduce/spectral/dense_products.hpp"

namespace bielle::reduce {

namespace {

/// K_ii - sigma M_ii. @param kept  unknowns x y z of points, ascending
void subtract_inertia(SymmetricMatrix& matrix, const std::vector<std::int64_t>& kept, const NodeMatrix& mass,
                      double sigma, int threads) {
#pragma omp parallel for schedule(dynamic, 1024) num_threads(threads)
  for (std::int64_t j = 0; j < matrix.size; ++j) {
    const std::int64_t column = kept[static_cast<std::size_t>(j)], a = column / 3;
    for (std::int64_t p = matrix.starts[j]; p < matrix.starts[j + 1]; ++p) {
      const std::int64_t row = kept[static_cast<std::size_t>(matrix.rows[p])];
      if (row % 3 != column % 3) continue;
      const std::int64_t at = mass.graph->place(static_cast<int>(a), static_cast<int>(row / 3));
      matrix.values[p] -= sigma * mass.values[static_cast<std::size_t>(at)];
    }
  }
}

}  // namespace

std::optional<PivotSigns> HeldBody::count_below(const BodyMatrices& matrices, double eigenvalue, int threads) const {
  if (!factor_) return PivotSigns{};
  if (matrices.stiffness_here() == nullptr || matrices.mass_here() == nullptr) return std::nullopt;
  const SymmetricMatrix& stiffness = *matrices.stiffness_here();
  const NodeMatrix& mass = *matrices.mass_here();
  const auto points_unknowns = static_cast<Eigen::Index>(freedoms_.free.size());
  const Eigen::Index released = freedoms_.carry_released.cols(), supports = freedoms_.rigid.cols(),
                     averages = freedoms_.conditions.cols();
  std::vector<std::int64_t> kept;
  std::vector<Eigen::Index> inner, outer;  // numbers in z: of points in the factor; released, then supports
  for (const Eigen::Index k : freedoms_.not_supports) {
    if (k >= points_unknowns) break;
    inner.push_back(k);
    kept.push_back(freedoms_.free[static_cast<std::size_t>(k)]);
  }
  for (Eigen::Index c = 0; c < released; ++c) outer.push_back(points_unknowns + c);
  outer.insert(outer.end(), freedoms_.supports.begin(), freedoms_.supports.end());

  SymmetricMatrix matrix = principal_submatrix(stiffness, kept);
  const Eigen::VectorXd diagonal = matrix.diagonal();
  std::vector<double> scale(diagonal.begin(), diagonal.end());
  subtract_inertia(matrix, kept, mass, eigenvalue, threads);
  if (released + supports + averages > 0) {
    const Eigen::Index first_average = released + supports;
    Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(freedoms_.size, first_average);
    for (Eigen::Index c = 0; c < first_average; ++c) unit(outer[static_cast<std::size_t>(c)], c) = 1;
    const Eigen::MatrixXd forces = restrict(stiffness.multiply(expand(unit), threads));
    const Eigen::MatrixXd images = forces - eigenvalue * inertia(mass, unit, threads);
    // A condition has no size of its own: it gets one by which its multiplier's pivot is about 1.
    Eigen::MatrixXd conditions = freedoms_.conditions;
    for (Eigen::Index c = 0; c < averages; ++c)
      conditions.col(c) /= std::sqrt(freedoms_.conditions.col(c).dot(corrections_.col(c)));
    Eigen::MatrixXd border(kept.size(), first_average + averages);
    border << images(inner, Eigen::all), conditions(inner, Eigen::all);
    Eigen::MatrixXd corner = Eigen::MatrixXd::Zero(border.cols(), border.cols());
    corner.topLeftCorner(first_average, first_average) = images(outer, Eigen::all);
    corner.topRightCorner(first_average, averages) = conditions(outer, Eigen::all);
    corner.bottomLeftCorner(averages, first_average) = conditions(outer, Eigen::all).transpose();
    for (Eigen::Index c = 0; c < first_average; ++c) scale.push_back(forces(outer[static_cast<std::size_t>(c)], c));
    scale.resize(scale.size() + static_cast<std::size_t>(averages), 1.0);
    matrix = bordered(matrix, border, corner);
  }
  std::optional<PivotSigns> signs = factor_->count_signs(std::move(matrix), scale);
  if (signs) signs->negative -= averages;
  return signs;
}

}  // namespace bielle::reduce

// The pivots of K - sigma M of the held body: its factorised interior, bordered by the rows that the factor leaves out.
#include <cmath>
#include <vector>

#include "reduce/reduction/fixed_interface_body.hpp"

namespace bielle::reduce {

std::optional<PivotSigns> FixedInterfaceBody::count_below(const BodyMatrices& matrices, double eigenvalue) const {
  if (!factor_) return PivotSigns{};
  const auto points_unknowns = static_cast<Eigen::Index>(freedoms_.free.size());
  const Eigen::Index released = freedoms_.carry_released.cols(), supports = freedoms_.rigid.cols(),
                     averages = freedoms_.conditions.cols(), first_average = released + supports;
  BorderedShift shifted;
  shifted.eigenvalue = eigenvalue;
  std::vector<Eigen::Index> inner, outer;  // numbers in z: of points in the factor; released, then supports
  for (const Eigen::Index k : freedoms_.not_supports) {
    if (k >= points_unknowns) break;
    inner.push_back(k);
    shifted.kept.push_back(freedoms_.free[static_cast<std::size_t>(k)]);
  }
  for (Eigen::Index c = 0; c < released; ++c) outer.push_back(points_unknowns + c);
  outer.insert(outer.end(), freedoms_.supports.begin(), freedoms_.supports.end());
  const Eigen::VectorXd diagonal = matrices.stiffness_diagonal()(shifted.kept);
  shifted.scale.assign(diagonal.begin(), diagonal.end());
  if (first_average + averages > 0) {
    Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(freedoms_.size, first_average);
    for (Eigen::Index c = 0; c < first_average; ++c) unit(outer[static_cast<std::size_t>(c)], c) = 1;
    const Eigen::MatrixXd forces = restrict(matrices.stiffness_times(expand(unit)));
    const Eigen::MatrixXd images = forces - eigenvalue * inertia(matrices, unit);
    // A condition has no natural scale: it is scaled so that its multiplier's pivot is about 1.
    Eigen::MatrixXd conditions = freedoms_.conditions;
    for (Eigen::Index c = 0; c < averages; ++c)
      conditions.col(c) /= std::sqrt(freedoms_.conditions.col(c).dot(corrections_.col(c)));
    shifted.border.resize(static_cast<Eigen::Index>(inner.size()), first_average + averages);
    shifted.border << images(inner, Eigen::all), conditions(inner, Eigen::all);
    shifted.corner.setZero(first_average + averages, first_average + averages);
    shifted.corner.topLeftCorner(first_average, first_average) = images(outer, Eigen::all);
    shifted.corner.topRightCorner(first_average, averages) = conditions(outer, Eigen::all);
    shifted.corner.bottomLeftCorner(averages, first_average) = conditions(outer, Eigen::all).transpose();
    for (Eigen::Index c = 0; c < first_average; ++c)
      shifted.scale.push_back(forces(outer[static_cast<std::size_t>(c)], c));
    shifted.scale.resize(shifted.scale.size() + static_cast<std::size_t>(averages), 1.0);
  }
  std::optional<PivotSigns> signs = matrices.count_signs(*factor_, shifted);
  if (signs) signs->negative -= averages;
  return signs;
}

}  // namespace bielle::reduce

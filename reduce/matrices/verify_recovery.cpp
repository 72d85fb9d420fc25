// Stress, strain and forces inside the body vanish in its rigid motions. A matrix of recovery whose columns stand in
// another order than the unknowns, or that belongs to another body, has some.
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "reduce/common/counted.hpp"
#include "reduce/dense/dense_products.hpp"
#include "reduce/matrices/verified_subjects.hpp"

namespace bielle::reduce {

namespace {

/// Text has as few as eight digits, of which the cancellation of long bodies takes some. Columns in a wrong order leave
/// a share of order one.
constexpr double rigid_recovery_limit = 1e-4;

struct WorstRow {
  double value = 0;
  Eigen::Index row = 0;
};

/// Returns the largest value under rigid motions. It is relative to the largest sum of |s_ij u_j|, its size without
/// cancellation, or to the largest value in an elastic mode of the same displacement: the first one is rounding if
/// interfaces move the body without deformation.
WorstRow worst_row(const MatrixStudy& study, const Eigen::MatrixXd& matrix) {
  const Eigen::MatrixXd& rigid = *study.geometric;
  const Eigen::MatrixXd values = product(matrix, rigid).cwiseAbs();
  const Eigen::MatrixXd sizes = product(matrix.cwiseAbs(), rigid.cwiseAbs());
  const Eigen::VectorXd moved = study.observed(rigid).cwiseAbs().colwise().maxCoeff();
  double elastic = 0;  // per displacement
  if (study.modes && study.modes->eigenvalues.size() > 6) {
    const Eigen::MatrixXd modes = study.modes->vectors.rightCols(study.modes->eigenvalues.size() - 6);
    const Eigen::ArrayXd stress = product(matrix, modes).cwiseAbs().colwise().maxCoeff();
    const Eigen::ArrayXd displacement = study.observed(modes).cwiseAbs().colwise().maxCoeff();
    elastic = (stress / displacement.max(1e-300)).maxCoeff();
  }
  WorstRow worst;
  for (Eigen::Index motion = 0; motion < rigid.cols(); ++motion) {
    Eigen::Index row = 0;
    const double largest = values.col(motion).maxCoeff(&row);
    const double size = std::max({sizes.col(motion).maxCoeff(), elastic * moved(motion), 1e-300});
    if (largest / size > worst.value) worst = {largest / size, row};
  }
  return worst;
}

bool vanishes_in_rigid_motions(const std::string& unit) {
  constexpr std::array<const char*, 4> internal = {"Pa", "m/m", "N", "N m"};
  return std::find(internal.begin(), internal.end(), unit) != internal.end();
}

}  // namespace

VerifiedSubject verify_recovery(const MatrixStudy& study) {
  VerifiedSubject subject{"recovery", {}, {}};
  const auto add = [&](const std::string& check, const std::string& told, const WorstRow& worst,
                       const std::string& row) {
    add_finding(subject, {check, worst.value, rigid_recovery_limit, "rigid motions cause no " + told},
                fmt::format("rigid motions cause {}, most at {}: the columns of the matrix are not the unknowns, or it "
                            "belongs to another body",
                            told, row));
  };
  if (study.set.shapes && study.set.shapes->stress.size() > 0) {
    const NodalShapes& shapes = *study.set.shapes;
    subject.lines.push_back(fmt::format("stress at {}", counted(shapes.stress_points.size(), "point")));
    if (study.geometric) {
      const WorstRow worst = worst_row(study, shapes.stress);
      const auto point = static_cast<std::size_t>(shapes.stress_points[static_cast<std::size_t>(worst.row / 6)]);
      add("rigid_stress", "stress", worst, fmt::format("point {}", shapes.numbers[point]));
    }
  }
  for (const auto& [name, quantity] : study.set.quantities) {
    subject.lines.push_back(
        fmt::format("{}: {} [{}]", name, counted(quantity.rows.size(), "row"), quantity.all_units().substr(0, 40)));
    Unknowns internal;
    for (std::size_t row = 0; row < quantity.rows.size(); ++row)
      if (vanishes_in_rigid_motions(quantity.units[row])) internal.push_back(static_cast<Eigen::Index>(row));
    if (!study.geometric || internal.empty()) continue;
    const WorstRow worst = worst_row(study, Eigen::MatrixXd(quantity.matrix(internal, Eigen::all)));
    add("rigid_" + name, name, worst,
        "row " + quantity.rows[static_cast<std::size_t>(internal[static_cast<std::size_t>(worst.row)])]);
  }
  return subject;
}

}  // namespace bielle::reduce

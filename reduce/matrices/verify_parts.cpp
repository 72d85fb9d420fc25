#include <cmath>

#include <fmt/format.h>

#include "reduce/common/percent.hpp"
#include "reduce/dense/dense_products.hpp"
#include "reduce/fe/elasticity.hpp"
#include "reduce/matrices/set_mass.hpp"
#include "reduce/matrices/verified_subjects.hpp"

namespace bielle::reduce {

namespace {

void verify_damping(const MatrixStudy& study, VerifiedSubject& subject) {
  if (study.set.damping.nonZeros() == 0) {
    subject.lines.emplace_back("no damping");
    return;
  }
  const SparseColumns damping = symmetric_part(study.set.damping);
  if (study.geometric) {
    const Eigen::VectorXd root = Eigen::VectorXd(damping.diagonal()).cwiseMax(0).cwiseSqrt();
    const Eigen::VectorXd sizes = (root.asDiagonal() * *study.geometric).cwiseAbs().colwise().maxCoeff();
    const Eigen::MatrixXd forces = root.cwiseMax(1e-8 * root.maxCoeff()).cwiseMax(1e-300).cwiseInverse().asDiagonal() *
                                   (damping * *study.geometric) * sizes.cwiseMax(1e-300).cwiseInverse().asDiagonal();
    Eigen::Index at = 0, motion = 0;
    const double worst = forces.cwiseAbs().maxCoeff(&at, &motion);
    add_finding(subject, {"rigid_motion_damping", worst, text_rounding, "moved as a whole, the body is not damped"},
                fmt::format("the damping resists rigid motions, most at {}: it may be proportional to the mass",
                            study.set.name_of(at)));
  }
  if (!study.modes || study.modes->eigenvalues.size() <= 6) return;
  std::string ratios;
  for (Eigen::Index k = 6; k < study.modes->eigenvalues.size(); ++k) {
    const Eigen::VectorXd phi = study.modes->vectors.col(k);
    const double omega = std::sqrt(std::max(study.modes->eigenvalues(k), 1e-300));
    ratios += fmt::format(" {:.4g}", 100 * phi.dot(damping * phi) / (2 * omega));
  }
  subject.lines.push_back(fmt::format("damping ratios of the free modes:{} %", ratios));
}

/// S_kl = int T_k^T T_l dm with T_k the displacement along k: their sum over k = l is M, and translations e_i, e_j give
/// m where k = i and l = j.
void verify_inertia_components(const MatrixStudy& study, VerifiedSubject& subject) {
  const std::array<Eigen::MatrixXd, 6>& parts = study.set.inertia_components;
  if (parts[0].size() == 0) return;
  const Eigen::VectorXd scale =
      Eigen::VectorXd(study.mass.diagonal()).cwiseAbs().cwiseSqrt().cwiseMax(1e-300).cwiseInverse();
  const Eigen::MatrixXd rest =
      scale.asDiagonal() * (parts[0] + parts[1] + parts[2] - Eigen::MatrixXd(study.set.mass)) * scale.asDiagonal();
  Eigen::Index row = 0, column = 0;
  const double worst = rest.cwiseAbs().maxCoeff(&row, &column);
  add_finding(subject,
              {"inertia_components_sum", worst, text_rounding, "the parts of the mass along x, y and z add up"},
              fmt::format("the inertia components along x, y and z do not add up to the mass, most between {} and {}",
                          study.set.name_of(row), study.set.name_of(column)));
  if (!study.geometric) return;
  const Eigen::MatrixXd translations = study.geometric->leftCols(3);
  const double mass = mass_of(study).mass();
  double largest = 0;
  for (std::size_t p = 0; p < 6; ++p) {
    Eigen::Matrix3d found = congruent(parts[p], translations);
    found(voigt_pairs[p][0], voigt_pairs[p][1]) -= mass;
    largest = std::max(largest, found.cwiseAbs().maxCoeff() / std::abs(mass));
  }
  add_finding(
      subject,
      {"inertia_components_rigid", largest, text_rounding,
       "translated, the inertia components have the mass in their direction alone"},
      fmt::format("translated, the body has inertia components that differ from its mass by {}", percent(largest)));
}

}  // namespace

VerifiedSubject verify_parts(const MatrixStudy& study) {
  VerifiedSubject subject{"damping and inertia", {}, {}};
  verify_damping(study, subject);
  verify_inertia_components(study, subject);
  return subject;
}

}  // namespace bielle::reduce

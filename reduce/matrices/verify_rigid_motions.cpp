#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "reduce/common/percent.hpp"
#include "reduce/matrices/verified_subjects.hpp"

namespace bielle::reduce {

namespace {

/// The forces of some motions at their worst.
struct WorstForce {
  double value = 0;
  Eigen::Index unknown = 0;
  Eigen::Index motions = 0;  ///< with a force above the limit
};

WorstForce worst_force(const MatrixStudy& study, const Eigen::MatrixXd& motions) {
  const Eigen::MatrixXd forces = study.relative_forces(motions).cwiseAbs();
  WorstForce worst;
  Eigen::Index column = 0;
  worst.value = forces.maxCoeff(&worst.unknown, &column);
  worst.motions = (forces.colwise().maxCoeff().array() > text_rounding).count();
  return worst;
}

/// Returns the largest part of the wanted motions that no combination of the others has, relative to their size.
double distance_of(const MatrixStudy& study, const Eigen::MatrixXd& motions, const Eigen::MatrixXd& wanted) {
  const Eigen::MatrixXd from = study.observed(motions), to = study.observed(wanted);
  const Eigen::MatrixXd rest = to - from * few_least_squares(from, to);
  const Eigen::ArrayXd sizes = to.cwiseAbs().colwise().maxCoeff().cwiseMax(1e-300).transpose().array();
  return (rest.cwiseAbs().colwise().maxCoeff().transpose().array() / sizes).maxCoeff();
}

void verify_forces(const MatrixStudy& study, VerifiedSubject& subject) {
  const bool grounded = is_grounded(study);
  if (study.statical) {
    const WorstForce held = worst_force(study, *study.statical);
    const WorstForce worst = study.geometric && grounded ? worst_force(study, *study.geometric) : held;
    add_finding(subject, {"grounding", held.value, text_rounding, "moved without deformation, the body feels no force"},
                fmt::format("the stiffness holds the body to the ground: {} of 6 rigid motions cause force; most at {}",
                            worst.motions, study.set.name_of(worst.unknown)));
  }
  if (!study.geometric) return;
  const WorstForce worst = worst_force(study, *study.geometric);
  if (grounded) {
    subject.lines.push_back(
        fmt::format("largest force under rigid motions by the positions: {:.1e} of the diagonal", worst.value));
    return;
  }
  const char* cause = study.statical ? "the positions or axes of the nodes do not fit the stiffness"
                                     : "the stiffness holds the body to the ground, or positions do not fit it";
  add_finding(subject, {"rigid_motion_force", worst.value, text_rounding, "moved as a whole, the body feels no force"},
              fmt::format("{}: {} of 6 rigid motions by the positions cause force; most at {}", cause, worst.motions,
                          study.set.name_of(worst.unknown)));
}

/// Kinds of rigid motions are equal to 0.1 % of their size: digits of text are magnified by the slenderness of a body.
void verify_distances(const MatrixStudy& study, VerifiedSubject& subject) {
  constexpr double limit = 1e-3;
  if (!study.geometric || is_grounded(study)) return;
  if (study.statical) {
    const double value = distance_of(study, *study.statical, *study.geometric);
    add_finding(subject,
                {"static_rigid_motions", value, limit, "rigid motions by the stiffness are those by the positions"},
                fmt::format("rigid motions by the stiffness differ from those by the positions by {} of the motion",
                            percent(value)));
  }
  if (!study.modes || study.modes->eigenvalues.size() < 6) return;
  const double value = distance_of(study, study.modes->vectors.leftCols(6), *study.geometric);
  add_finding(subject,
              {"modal_rigid_motions", value, limit, "the six lowest modes are the rigid motions by the positions"},
              fmt::format("the six lowest modes differ from rigid motions by the positions by {} of the motion",
                          percent(value)));
}

/// Checks that rigid motions vibrate below a hundredth of the first elastic frequency, that is with less than 1e-4 of
/// its energy.
void verify_frequencies(const MatrixStudy& study, VerifiedSubject& subject) {
  constexpr double limit = 1e-2;
  if (!study.modes) {
    subject.lines.push_back("no modes of the free body: " + study.no_modes);
    return;
  }
  const Eigen::VectorXd& values = study.modes->eigenvalues;
  if (values.size() < 7) {
    subject.lines.emplace_back("the body has no elastic modes");
    return;
  }
  std::string list;
  for (Eigen::Index k = 0; k < 6; ++k) list += fmt::format("{}{:.3g}", k == 0 ? "" : " ", signed_frequency(values(k)));
  subject.lines.push_back(
      fmt::format("six lowest frequencies: {} Hz; the next {:.6g} Hz", list, signed_frequency(values(6))));
  // A seventh motion without stiffness has a frequency of rounding, far below all elastic ones.
  const bool vibrates = values(6) > 1e-10 * values(values.size() - 1);
  const double elastic = vibrates ? signed_frequency(values(6)) : 0,
               rigid = signed_frequency(values.head(6).cwiseAbs().maxCoeff());
  const Eigen::Index low = (values.array().abs() < limit * limit * values(6)).count();
  add_finding(subject,
              {"rigid_frequencies", elastic > 0 ? rigid / elastic : std::numeric_limits<double>::infinity(), limit,
               "six motions do not vibrate"},
              elastic > 0
                  ? fmt::format("{} of the six lowest modes vibrate: up to {:.4g} Hz, where the next has {:.4g} Hz",
                                6 - std::min<Eigen::Index>(low, 6), rigid, elastic)
                  : "more than six motions do not vibrate: parts of the body are not connected, or move freely");
}

}  // namespace

bool is_grounded(const MatrixStudy& study) {
  return study.statical && worst_force(study, *study.statical).value > text_rounding;
}

VerifiedSubject verify_rigid_motions(const MatrixStudy& study) {
  VerifiedSubject subject{"rigid motions", {}, {}};
  if (!study.geometric)
    add_finding(subject, {"rigid_motions", 1, 0, "the body can move as a whole"},
                "the body cannot move as a whole by its positions: " + study.no_geometric);
  else if (!study.statical)
    add_finding(subject, {"mechanism", 1, 0, "the body has no motion without force besides the rigid ones"},
                study.no_statical);
  verify_forces(study, subject);
  verify_distances(study, subject);
  verify_frequencies(study, subject);
  return subject;
}

}  // namespace bielle::reduce

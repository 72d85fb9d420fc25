#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "reduce/common/counted.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "reduce/matrices/verified_subjects.hpp"

namespace bielle::reduce {

namespace {

struct NamedMatrix {
  const char* name;
  const SparseColumns& matrix;
};

void verify_symmetry(const MatrixStudy& study, const NamedMatrix& of, VerifiedSubject& subject) {
  const SparseColumns transposed = of.matrix.transpose();
  const SparseColumns difference = of.matrix - transposed;
  Eigen::VectorXd scale = Eigen::VectorXd(of.matrix.diagonal()).cwiseAbs().cwiseSqrt();
  scale = scale.cwiseMax(1e-8 * scale.maxCoeff());  // an entry in a row with a null diagonal is large anyway
  double worst = 0;
  Eigen::Index row = 0, column = 0;
  for (Eigen::Index j = 0; j < difference.outerSize(); ++j)
    for (SparseColumns::InnerIterator entry(difference, j); entry; ++entry) {
      const double relative = std::abs(entry.value()) / std::max(scale(entry.row()) * scale(j), 1e-300);
      if (relative <= worst) continue;
      worst = relative;
      row = entry.row();
      column = j;
    }
  add_finding(subject,
              {fmt::format("{}_symmetry", of.name), worst, text_rounding, fmt::format("the {} is symmetric", of.name)},
              fmt::format("the {} is not symmetric: between {} and {} it has {:.6g}, and {:.6g} the other way round",
                          of.name, study.set.name_of(row), study.set.name_of(column), of.matrix.coeff(row, column),
                          of.matrix.coeff(column, row)));
}

/// Returns the least scaled eigenvalue of the stiffness. If the body held in six unknowns r is definite, as its static
/// motions tell, K has the signs of that body and of the Schur complement at r (Sylvester), which takes no
/// factorisation.
std::optional<LeastEigenvalue> least_of_stiffness(const MatrixStudy& study) {
  const Eigen::VectorXd diagonal = study.stiffness.diagonal();
  // An unknown with a null diagonal takes no part in static motions; entries besides it make K indefinite.
  const bool whole = (diagonal.array() > 0 || largest_entries(study.stiffness).array() == 0).all();
  if (whole && study.statical) {
    const Eigen::MatrixXd forces = study.stiffness * *study.statical;
    const Eigen::VectorXd scale = diagonal(study.references).cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd schur = scale.asDiagonal() * forces(study.references, Eigen::all) * scale.asDiagonal();
    const double least = symmetric_eigenpairs((schur + schur.transpose()) / 2).values(0);
    if (least > -text_rounding) return LeastEigenvalue{least, study.references[0]};
  }
  return least_scaled_eigenvalue(study.stiffness, study.threads);
}

void verify_definiteness(const MatrixStudy& study, const NamedMatrix& of, const std::optional<LeastEigenvalue>& least,
                         VerifiedSubject& subject) {
  if (!least) return;
  add_finding(
      subject,
      {fmt::format("{}_definiteness", of.name), std::max(0.0, -least->value), text_rounding,
       fmt::format("the {} is positive", of.name)},
      fmt::format("the {} is not positive: scaled to a unit diagonal its least eigenvalue is {:.3g}; {} has the "
                  "largest part in it",
                  of.name, least->value, study.set.name_of(least->unknown)));
}

/// Unknowns that lack one of both matrices.
void verify_presence(const MatrixStudy& study, VerifiedSubject& subject) {
  const Eigen::VectorXd stiffness = largest_entries(study.stiffness), mass = largest_entries(study.mass);
  Unknowns limp, massless;
  for (Eigen::Index k = 0; k < study.size(); ++k) {
    if (stiffness(k) == 0) limp.push_back(k);
    if (mass(k) == 0) massless.push_back(k);
  }
  if (study.set.scalars() == study.size()) {  // modes of a free body, with those of its rigid motions
    if (!limp.empty()) subject.lines.push_back(fmt::format("{} without stiffness", counted(limp.size(), "scalar")));
    limp.clear();
  }
  const bool all_nodal = std::none_of(limp.begin(), limp.end(), [&](Eigen::Index k) {
    return study.set.unknowns[static_cast<std::size_t>(k)].is_scalar();
  });
  if (!limp.empty() && limp.size() <= 6 && all_nodal && study.set.scalars() + 6 >= study.size()) {
    subject.lines.push_back(
        fmt::format("the interfaces move the body without deformation: {}", names_of(study.set, limp)));
    limp.clear();
  }
  add_finding(
      subject, {"unknowns_without_stiffness", static_cast<double>(limp.size()), 0, "no mass is without stiffness"},
      fmt::format("{} {} mass but no stiffness, so that nothing holds them to the body: {}",
                  counted(limp.size(), "unknown"), limp.size() == 1 ? "has" : "have", names_of(study.set, limp)));
  if (!massless.empty())
    subject.lines.push_back(
        fmt::format("{} stiffness but no mass: {}",
                    massless.size() == 1 ? "1 unknown has" : fmt::format("{} unknowns have", massless.size()),
                    names_of(study.set, massless)));
}

}  // namespace

void add_finding(VerifiedSubject& subject, Check check, const std::string& fault) {
  if (!std::isfinite(check.value)) check.value = 1e300;  // a value that is not a number fails its check
  const bool passed = check.passed();
  subject.findings.push_back({std::move(check), passed ? "" : fault});
}

std::string names_of(const MatrixSet& set, const Unknowns& unknowns, std::size_t most) {
  std::string names;
  const std::size_t shown = unknowns.size() <= most + 1 ? unknowns.size() : most;
  for (std::size_t k = 0; k < shown; ++k) {
    const bool last = k + 1 == unknowns.size();
    names += (k == 0 ? "" : last ? " and " : ", ") + set.name_of(unknowns[k]);
  }
  if (shown < unknowns.size()) names += fmt::format(" and {} more", unknowns.size() - shown);
  return names;
}

VerifiedSubject verify_entries(const MatrixStudy& study) {
  VerifiedSubject subject{"entries", {}, {}};
  const NamedMatrix stiffness{"stiffness", study.set.stiffness}, mass{"mass", study.set.mass};
  verify_symmetry(study, stiffness, subject);
  verify_symmetry(study, mass, subject);
  verify_definiteness(study, stiffness, least_of_stiffness(study), subject);
  verify_definiteness(study, mass, least_scaled_eigenvalue(study.mass, study.threads), subject);
  if (study.set.damping.nonZeros() > 0) {
    const NamedMatrix damping{"damping", study.set.damping};
    verify_symmetry(study, damping, subject);
    const SparseColumns even = symmetric_part(study.set.damping);
    verify_definiteness(study, damping, least_scaled_eigenvalue(even, study.threads), subject);
  }
  verify_presence(study, subject);
  return subject;
}

}  // namespace bielle::reduce

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "reduce/common/counted.hpp"
#include "reduce/matrices/held_modes.hpp"
#include "reduce/matrices/set_mass.hpp"
#include "reduce/matrices/verified_subjects.hpp"

namespace bielle::reduce {

namespace {

void tell_free_frequencies(const MatrixStudy& study, VerifiedSubject& subject) {
  if (!study.modes || study.modes->eigenvalues.size() <= 6) return;
  std::string list;
  for (Eigen::Index k = 6; k < study.modes->eigenvalues.size(); ++k)
    list += fmt::format(" {:.6g}", signed_frequency(study.modes->eigenvalues(k)));
  subject.lines.push_back(fmt::format("free-free:{} Hz", list));
}

void tell_held_frequencies(const MatrixStudy& study, VerifiedSubject& subject) {
  std::optional<HeldModes> found;
  try {
    found = held_modes(study, elastic_modes);
  } catch (const NotPositiveDefinite&) {
    subject.lines.push_back("with its interfaces held the body is not stiff: no fixed-base frequencies");
    return;
  }
  if (!found) {
    subject.lines.push_back("no interfaces that could be held, or nothing else: no fixed-base frequencies");
    return;
  }
  const Eigen::VectorXd& values = found->modes.eigenvalues;
  subject.lines.push_back(fmt::format("fixed-base, {} held:", counted(found->held.size(), "unknown")));
  const bool with_mass = found->effective_mass.rows() == values.size();
  const Eigen::RowVectorXd& all = found->whole_mass;
  if (with_mass)
    subject.lines.emplace_back(
        "        Hz   effective mass in % along x, y, z, about x, y, z through the centre of mass");
  const auto shares = [&](const Eigen::MatrixXd& masses) {
    std::string text;
    for (int i = 0; i < 6; ++i) text += fmt::format(" {:6.2f}", all(i) > 0 ? 100 * masses(0, i) / all(i) : 0.0);
    return text;
  };
  for (Eigen::Index k = 0; k < values.size(); ++k)
    subject.lines.push_back(fmt::format("{:10.6g}  {}", signed_frequency(values(k)),
                                        with_mass ? shares(found->effective_mass.row(k)) : ""));
  if (with_mass)
    subject.lines.push_back(fmt::format("{:>10}  {}", "sum", shares(found->effective_mass.colwise().sum())));
}

/// Returns the size of the entries besides the diagonal, relative to it.
double besides_diagonal(const SparseColumns& A) {
  const Eigen::VectorXd root = Eigen::VectorXd(A.diagonal()).cwiseAbs().cwiseSqrt().cwiseMax(1e-300);
  double largest = 0;
  for (Eigen::Index j = 0; j < A.outerSize(); ++j)
    for (SparseColumns::InnerIterator entry(A, j); entry; ++entry)
      if (entry.row() != j) largest = std::max(largest, std::abs(entry.value()) / (root(entry.row()) * root(j)));
  return largest;
}

double largest_coupling(const SparseColumns& A, const Unknowns& rows, const Unknowns& columns) {
  const Eigen::VectorXd root = Eigen::VectorXd(A.diagonal()).cwiseAbs().cwiseSqrt().cwiseMax(1e-300);
  const SparseColumns scaled = root.cwiseInverse().asDiagonal() * A * root.cwiseInverse().asDiagonal();
  const SparseColumns block = submatrix(scaled, rows, columns);
  return block.nonZeros() > 0
             ? Eigen::Map<const Eigen::VectorXd>(block.valuePtr(), block.nonZeros()).cwiseAbs().maxCoeff()
             : 0.0;
}

/// Reports whether the scalars are modes of the held body, which need not be so. The answer reveals the kind of
/// reduction.
void tell_scalars(const MatrixStudy& study, VerifiedSubject& subject) {
  Unknowns nodal, scalar;
  for (Eigen::Index k = 0; k < study.size(); ++k)
    (study.set.unknowns[static_cast<std::size_t>(k)].is_scalar() ? scalar : nodal).push_back(k);
  if (scalar.empty()) return;
  const SparseColumns stiffness = submatrix(study.stiffness, scalar, scalar),
                      mass = submatrix(study.mass, scalar, scalar);
  const bool unit = (Eigen::VectorXd(mass.diagonal()).array() - 1).abs().maxCoeff() < text_rounding;
  const bool orthogonal = besides_diagonal(mass) < text_rounding,
             diagonal = besides_diagonal(stiffness) < text_rounding;
  const double coupling = largest_coupling(study.stiffness, scalar, nodal);
  subject.lines.push_back(fmt::format(
      "{}: {} in the mass, {} in the stiffness, {}", counted(scalar.size(), "scalar"),
      orthogonal ? (unit ? "orthonormal" : "orthogonal, not of unit mass,") : "not orthogonal",
      diagonal ? "diagonal" : "coupled with each other",
      coupling < text_rounding
          ? "not coupled with the nodes in the stiffness"
          : fmt::format("coupled with the nodes in the stiffness (up to {:.2g} of the diagonal)", coupling)));
}

}  // namespace

VerifiedSubject verify_modes(const MatrixStudy& study) {
  VerifiedSubject subject{"modes", {}, {}};
  tell_free_frequencies(study, subject);
  tell_held_frequencies(study, subject);
  tell_scalars(study, subject);
  return subject;
}

}  // namespace bielle::reduce

#include "reduce/matrices/set_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "reduce/common/counted.hpp"
#include "reduce/dense/dense_products.hpp"
#include "reduce/fe/elasticity.hpp"
#include "reduce/matrices/common_places.hpp"
#include "reduce/matrices/set_mass.hpp"
#include "reduce/matrices/verified_subjects.hpp"
#include "reduce/reduction/rigid_motions.hpp"

namespace bielle::reduce {

namespace {

/// Mass properties of one body agree to 0.1 %: those of two programs differ by integration and by lumped masses. A
/// centre is compared in radii of gyration, an entry ij of the inertia with sqrt(I_ii I_jj).
constexpr double mass_limit = 1e-3;
/// The first frequency of one body agrees to 1 %, the accuracy that a good reduction has.
constexpr double frequency_limit = 1e-2;
/// A MAC of 0.9 is usual for the same mode.
constexpr double shape_limit = 0.1;
/// Modes whose frequencies differ less count together, since any combination of them is a mode: 1 %.
constexpr double multiple = 1e-2;
/// Counterparts whose MAC differs by less than 0.01 look alike at the common places. The one with the nearest frequency
/// is taken.
constexpr double alike = 1e-2;
constexpr double same_place = 1e-4;  // in lengths of the body

std::string vector_text(const Eigen::Vector3d& x) { return fmt::format("{:.6g}, {:.6g}, {:.6g}", x.x(), x.y(), x.z()); }

/// Compares the inertias about one point, the centre of the second body, in body axes.
void compare_inertia(const SetMass& a, const SetMass& b, VerifiedSubject& subject) {
  const Eigen::Vector3d offset = a.centre - b.centre;
  const Eigen::Matrix3d moved = a.inertia - a.mass() * skew(offset) * skew(offset);
  // The moment of a thin rod about its axis has lost the digits that its other moments have.
  const double floor = std::max(1e-4 * b.inertia.diagonal().cwiseAbs().maxCoeff(), 1e-300);
  std::string worst;
  double largest = 0;
  subject.lines.push_back(
      fmt::format("inertia about ({}) m, body axes [kg m^2]; difference in parts of sqrt(I_ii I_jj), at most {:.2g} %",
                  vector_text(b.centre), 100 * mass_limit));
  for (std::size_t k = 0; k < voigt_pairs.size(); ++k) {
    const auto [i, j] = voigt_pairs[k];
    const double scale = std::max(std::sqrt(std::abs(b.inertia(i, i) * b.inertia(j, j))), floor);
    const double difference = (moved(i, j) - b.inertia(i, j)) / scale;
    const std::string name = {"xyz"[i], "xyz"[j]};
    subject.lines.push_back(
        fmt::format("{:>5} {:14.7g} {:14.7g} {:+10.3g} %", name, moved(i, j), b.inertia(i, j), 100 * difference));
    if (!(std::abs(difference) > largest)) continue;
    largest = std::abs(difference);
    worst = fmt::format("{} is {:.6g} and {:.6g} kg m^2", name, moved(i, j), b.inertia(i, j));
  }
  add_finding(subject, {"against_inertia", largest, mass_limit, "both have the same inertia"},
              fmt::format("their inertias about ({}) m differ: {}", vector_text(b.centre), worst));
}

void compare_mass_properties(const MatrixStudy& a, const MatrixStudy& b, VerifiedSubject& subject) {
  if (!a.geometric || !b.geometric) {
    subject.lines.push_back("mass properties are not compared: one of the bodies has no rigid motions by positions");
    return;
  }
  const SetMass p = mass_of(a), q = mass_of(b);
  const double gyration = std::sqrt(std::max(q.inertia.trace() / 2 / q.mass(), 1e-300));
  add_finding(subject, {"against_mass", std::abs(p.mass() / q.mass() - 1), mass_limit, "both have the same mass"},
              fmt::format("their masses differ: {:.6g} and {:.6g} kg", p.mass(), q.mass()));
  add_finding(
      subject,
      {"against_centre", (p.centre - q.centre).norm() / gyration, mass_limit, "both have the same centre of mass"},
      fmt::format("their centres of mass differ: ({}) and ({}) m", vector_text(p.centre), vector_text(q.centre)));
  subject.lines.push_back(fmt::format("mass {:.6g} and {:.6g} kg, centre ({}) and ({}) m", p.mass(), q.mass(),
                                      vector_text(p.centre), vector_text(q.centre)));
  compare_inertia(p, q, subject);
}

/// Elastic modes without their rigid parts at the places, with the squares of their amplitudes.
struct ElasticModes {
  Eigen::VectorXd frequencies;
  Eigen::MatrixXd vectors;
};

ElasticModes elastic_modes_of(const MatrixStudy& study) {
  if (!study.modes || study.modes->eigenvalues.size() <= 6) return {};
  const Eigen::Index count = study.modes->eigenvalues.size() - 6;
  return {study.modes->eigenvalues.tail(count).unaryExpr(&signed_frequency), study.modes->vectors.rightCols(count)};
}

/// Returns which modes move a common place by more than rounding. The MAC of all others is only rounding.
std::vector<bool> seen_modes(const Eigen::MatrixXd& u) {
  const Eigen::VectorXd lengths = u.colwise().norm();
  const double least = text_rounding * lengths.maxCoeff();
  std::vector<bool> result(static_cast<std::size_t>(lengths.size()));
  for (std::size_t k = 0; k < result.size(); ++k) result[k] = lengths(static_cast<Eigen::Index>(k)) > least;
  return result;
}

/// Returns MAC_ij = (u_i . v_j)^2 / (|u_i|^2 |v_j|^2).
Eigen::MatrixXd assurance(const Eigen::MatrixXd& u, const Eigen::MatrixXd& v) {
  const Eigen::VectorXd lengths = u.colwise().norm().cwiseMax(1e-300), others = v.colwise().norm().cwiseMax(1e-300);
  return (lengths.cwiseInverse().asDiagonal() * transposed_product(u, v) * others.cwiseInverse().asDiagonal())
      .cwiseAbs2();
}

/// Modes of a second body at the common places.
struct SeenModes {
  const ElasticModes& modes;
  const Eigen::MatrixXd& v;
  std::vector<bool> seen;
};

/// Returns the mode that looks most like a mode of the first body; -1 if none is seen.
/// @param mac  that of the mode with each mode of b @param frequency  that of the mode
Eigen::Index counterpart(const Eigen::RowVectorXd& mac, double frequency, const SeenModes& b) {
  double largest = 0;
  for (Eigen::Index k = 0; k < mac.size(); ++k)
    if (b.seen[static_cast<std::size_t>(k)]) largest = std::max(largest, mac(k));
  const auto distance = [&](Eigen::Index k) { return std::abs(b.modes.frequencies(k) - frequency); };
  Eigen::Index best = -1;
  for (Eigen::Index k = 0; k < mac.size(); ++k)
    if (b.seen[static_cast<std::size_t>(k)] && mac(k) >= largest - alike && (best < 0 || distance(k) < distance(best)))
      best = k;
  return best;
}

/// Returns the share of u in the span of the modes that are as frequent as mode j.
double group_assurance(const Eigen::VectorXd& u, const SeenModes& b, Eigen::Index j) {
  std::vector<Eigen::Index> group;
  for (Eigen::Index k = 0; k < b.modes.frequencies.size(); ++k)
    if (b.seen[static_cast<std::size_t>(k)] && std::abs(b.modes.frequencies(k) / b.modes.frequencies(j) - 1) < multiple)
      group.push_back(k);
  const Eigen::MatrixXd basis = b.v(Eigen::all, group);
  const Eigen::VectorXd rest = u - basis * few_least_squares(basis, u);
  return 1 - rest.squaredNorm() / std::max(u.squaredNorm(), 1e-300);
}

void compare_shapes(const ElasticModes& a, const ElasticModes& modes_b, const CommonMotions& common,
                    VerifiedSubject& subject) {
  const Eigen::MatrixXd mac = assurance(common.a, common.b);
  const std::vector<bool> seen = seen_modes(common.a);
  const SeenModes b{modes_b, common.b, seen_modes(common.b)};
  bool is_first = true;
  subject.lines.push_back("  mode      Hz   of mode        Hz   difference   MAC");
  for (Eigen::Index i = 0; i < mac.rows(); ++i) {
    const Eigen::Index j =
        seen[static_cast<std::size_t>(i)] ? counterpart(mac.row(i), a.frequencies(i), b) : Eigen::Index(-1);
    if (j < 0) {
      subject.lines.push_back(fmt::format("{:5} {:10.6g}   does not move any common point", i + 1, a.frequencies(i)));
      continue;
    }
    const double other = modes_b.frequencies(j), difference = a.frequencies(i) / other - 1;
    const double group = group_assurance(common.a.col(i), b, j);
    subject.lines.push_back(fmt::format("{:5} {:10.6g} {:5} {:10.6g} {:+9.3g} % {:8.4f}", i + 1, a.frequencies(i),
                                        j + 1, other, 100 * difference, group));
    if (!std::exchange(is_first, false)) continue;
    const std::string first = i == 0 ? "the first free mode" : "the first free mode that moves a common point";
    add_finding(
        subject, {"against_first_shape", 1 - group, shape_limit, first + " has a counterpart"},
        fmt::format("{}, {:.6g} Hz, has no counterpart: its largest MAC is {:.3f}", first, a.frequencies(i), group));
    add_finding(
        subject, {"against_first_frequency", std::abs(difference), frequency_limit, "the first free frequencies agree"},
        fmt::format("the first free frequency is {:.6g} Hz, that of the other's mode of the same shape {:.6g} Hz",
                    a.frequencies(i), other));
  }
}

void list_frequencies(const ElasticModes& a, const ElasticModes& b, VerifiedSubject& subject) {
  const Eigen::Index count = std::min(a.frequencies.size(), b.frequencies.size());
  for (Eigen::Index k = 0; k < count; ++k)
    subject.lines.push_back(fmt::format("{:5} {:10.6g} {:10.6g} Hz {:+9.3g} %", k + 1, a.frequencies(k),
                                        b.frequencies(k), 100 * (a.frequencies(k) / b.frequencies(k) - 1)));
  add_finding(subject,
              {"against_first_frequency", std::abs(a.frequencies(0) / b.frequencies(0) - 1), frequency_limit,
               "the first free frequencies agree"},
              fmt::format("the first free frequencies are {:.6g} and {:.6g} Hz", a.frequencies(0), b.frequencies(0)));
}

/// Checks phi_a^T M_b phi_b of unit modal masses, which is the unit matrix for the same modes.
void compare_orthogonality(const MatrixStudy& a, const MatrixStudy& b, const ElasticModes& of_a,
                           const ElasticModes& of_b, double tolerance, VerifiedSubject& subject) {
  std::optional<Eigen::MatrixXd> moved = expressed_in(b.set, a.set, of_a.vectors, tolerance);
  Eigen::MatrixXd crossed;
  if (moved) {
    crossed = transposed_product(*moved, b.mass * of_b.vectors);
  } else if ((moved = expressed_in(a.set, b.set, of_b.vectors, tolerance))) {
    crossed = transposed_product(of_a.vectors, a.mass * *moved);
  } else {
    subject.lines.push_back(
        "cross-orthogonality cannot be computed: each body has unknowns without a counterpart in the other");
    return;
  }
  std::string matched, others;
  for (Eigen::Index i = 0; i < crossed.rows(); ++i) {
    Eigen::Index j = 0;
    const double largest = crossed.row(i).cwiseAbs().maxCoeff(&j);
    Eigen::VectorXd rest = crossed.row(i).transpose();
    rest(j) = 0;
    matched += fmt::format(" {:.4f}", largest);
    others += fmt::format(" {:.4f}", rest.cwiseAbs().maxCoeff());
  }
  subject.lines.push_back("cross-orthogonality in the mass, each with its counterpart:" + matched);
  subject.lines.push_back("                          the largest with another mode:" + others);
}

}  // namespace

VerifiedSubject compare(MatrixSet a, MatrixSet b, int threads) {
  remove_empty_unknowns(a);
  remove_empty_unknowns(b);
  VerifiedSubject subject{"against " + b.source, {}, {}};
  const MatrixStudy of_a = study_matrices(a, threads), of_b = study_matrices(b, threads);
  compare_mass_properties(of_a, of_b, subject);
  const ElasticModes modes_a = elastic_modes_of(of_a), modes_b = elastic_modes_of(of_b);
  if (modes_a.frequencies.size() == 0 || modes_b.frequencies.size() == 0) {
    subject.lines.push_back("modes are not compared: one of the bodies has none");
    return subject;
  }
  const double tolerance = same_place * of_b.length;
  const PlacedMotions u = placed_motions(a, modes_a.vectors), v = placed_motions(b, modes_b.vectors);
  const CommonPlaces common = common_places(u, v, tolerance);
  if (common.moved > 0)
    subject.lines.push_back(fmt::format("{} of the same number at another place",
                                        common.moved == 1 ? "1 node is" : fmt::format("{} nodes are", common.moved)));
  subject.lines.push_back(fmt::format("{} in common", counted(common.a.size(), "place")));
  // Two places on a line show bending in two planes and extension, but neither torsion nor the order of bending. At
  // least three places are needed.
  if (common.a.size() < 3) {
    list_frequencies(modes_a, modes_b, subject);
  } else {
    compare_shapes(modes_a, modes_b, common_motions(u, v, common, of_b.length), subject);
  }
  compare_orthogonality(of_a, of_b, modes_a, modes_b, tolerance, subject);
  return subject;
}

}  // namespace bielle::reduce

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include <fmt/format.h>

#include "reduce/common/counted.hpp"
#include "reduce/common/percent.hpp"
#include "reduce/matrices/implied_positions.hpp"
#include "reduce/matrices/verified_subjects.hpp"
#include "reduce/reduction/rigid_motions.hpp"

namespace bielle::reduce {

namespace {

/// Places agree to 0.1 % of the body's size: coordinates of five digits, and digits of the stiffness that slenderness
/// magnifies.
constexpr double place_limit = 1e-3;

/// Returns a factor between positions and the lengths of the matrices, in words.
std::string words_of_factor(double factor) {
  struct Known {
    double factor;
    const char* words;
  };
  constexpr std::array<Known, 6> known = {
      {{1e-3, "positions look like millimetres where the matrices are in metres"},
       {1e-2, "positions look like centimetres where the matrices are in metres"},
       {0.0254, "positions look like inches where the matrices are in metres"},
       {0.3048, "positions look like feet where the matrices are in metres"},
       {1e3, "positions look like metres where the matrices are in millimetres"},
       {1 / 0.0254, "positions look like metres where the matrices are in inches"}}};
  for (const Known& unit : known)
    if (std::abs(factor / unit.factor - 1) < 5e-3) return unit.words;
  return fmt::format("lengths of the matrices are {:.6g} times those of the positions", factor);
}

/// Names the nodes that the others contradict, the worst first.
std::string wrong_nodes(const MatrixSet& set, const ImpliedPositions& implied, const Similarity& fit,
                        double tolerance) {
  std::vector<std::size_t> order(implied.nodes.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto distance = [&](std::size_t k) { return fit.distances(static_cast<Eigen::Index>(k)); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return distance(a) > distance(b); });
  std::string names;
  constexpr std::size_t most = 4;
  const auto wrong = static_cast<std::size_t>((fit.distances.array() > tolerance).count());
  for (std::size_t k = 0; k < std::min(most, wrong); ++k) {
    const Eigen::Vector3d place =
        fit.turn.transpose() * (implied.positions.col(static_cast<Eigen::Index>(order[k])) - fit.offset) / fit.factor;
    const auto node = static_cast<std::size_t>(implied.nodes[order[k]]);
    Eigen::Index nearest = 0;
    (set.positions.colwise() - place).colwise().norm().minCoeff(&nearest);
    const bool taken = (set.positions.col(nearest) - place).norm() < tolerance / fit.factor;
    names += fmt::format("{}node {} {:.4g} m off", k == 0 ? "" : ", ", set.numbers[node], distance(order[k]));
    if (taken)
      names += fmt::format(" (where node {} stands)", set.numbers[static_cast<std::size_t>(nearest)]);
    else
      names += fmt::format(" (at {:.4g}, {:.4g}, {:.4g} m by the matrices)", place.x(), place.y(), place.z());
  }
  return wrong > most ? fmt::format("{} and {} more", names, wrong - most) : names;
}

double turn_angle(const Eigen::Matrix3d& turn) { return std::acos(std::clamp((turn.trace() - 1) / 2, -1.0, 1.0)); }

void verify_places(const MatrixSet& set, const ImpliedPositions& implied, VerifiedSubject& subject, double& scale) {
  const Eigen::Matrix3Xd given = set.positions(Eigen::all, implied.nodes);
  const double size = (implied.positions.rowwise().maxCoeff() - implied.positions.rowwise().minCoeff()).norm();
  if (!(size > 0)) return;
  const Similarity plain = nearest_translation(given, implied.positions);
  const double worst = plain.distances.maxCoeff() / size;
  std::string fault;
  if (worst > place_limit) {
    const Similarity similar = nearest_similarity(given, implied.positions);
    const double tolerance = place_limit * size;
    const auto fits = [&](const Similarity& fit) {
      return 2 * (fit.distances.array() <= tolerance).count() > fit.distances.size();
    };
    const Similarity& fit = fits(plain) ? plain : similar;
    if (!fits(plain) && fits(similar)) {
      if (std::abs(similar.factor - 1) > place_limit) {
        fault = words_of_factor(similar.factor);
        scale = similar.factor;
      }
      if (const double angle = turn_angle(similar.turn); angle > place_limit)
        fault += fmt::format("{}positions are turned by {:.4g} deg against the axes of the unknowns{}",
                             fault.empty() ? "" : "; ", angle * 180 / std::numbers::pi,
                             implied.nodes.size() < 3 ? ", or two nodes are exchanged" : "");
    }
    if (const auto wrong = (fit.distances.array() > tolerance).count(); wrong > 0)
      fault += fmt::format("{}{} not where the matrices have {}: {}", fault.empty() ? "" : "; ",
                           wrong == 1 ? "1 node is" : fmt::format("{} nodes are", wrong), wrong == 1 ? "it" : "them",
                           wrong_nodes(set, implied, fit, tolerance));
  }
  add_finding(subject, {"positions", worst, place_limit, "the stiffness has the nodes where the file has them"}, fault);
}

void verify_axes(const MatrixSet& set, const ImpliedPositions& implied, VerifiedSubject& subject) {
  Eigen::Index at = 0;
  const double worst = implied.turns.maxCoeff(&at);
  const auto wrong = (implied.turns.array() > place_limit).count();
  add_finding(subject, {"axes", worst, place_limit, "the stiffness has the axes of the nodes as the file has them"},
              fmt::format("the axes of node {} are turned by {:.4g} deg against those of its unknowns{}",
                          set.numbers[static_cast<std::size_t>(implied.nodes[static_cast<std::size_t>(at)])],
                          worst * 180 / std::numbers::pi,
                          wrong > 1 ? fmt::format(", and those of {}", counted(wrong - 1, "other node")) : ""));
}

/// Shapes move their points rigidly with the nodes.
void verify_points(const MatrixStudy& study, VerifiedSubject& subject) {
  const MatrixSet& set = study.set;
  if (!set.shapes || !study.geometric) return;
  const NodalShapes& shapes = *set.shapes;
  Eigen::MatrixXd error = shapes.displacement * *study.geometric;
  error -= Eigen::MatrixXd(rigid_motions(shapes.points, study.middle));
  error.rightCols(3) /= study.length;
  Eigen::Index row = 0, column = 0;
  const double worst = error.cwiseAbs().maxCoeff(&row, &column);
  add_finding(subject,
              {"shape_rigid_motions", worst, place_limit, "moved as a whole, all points of the shapes move rigidly"},
              fmt::format("rigid motions of the body move point {} of the shapes otherwise, by {} of the motion: its "
                          "place or its shape is wrong",
                          shapes.numbers.empty() ? row / 3 + 1 : shapes.numbers[static_cast<std::size_t>(row / 3)],
                          percent(worst)));
}

}  // namespace

VerifiedSubject verify_positions(const MatrixStudy& study, double& scale) {
  VerifiedSubject subject{"positions", {}, {}};
  scale = 1;
  verify_points(study, subject);
  if (!study.statical || is_grounded(study)) return subject;
  const std::optional<ImpliedPositions> implied = implied_positions(study, *study.statical);
  if (!implied) return subject;
  verify_axes(study.set, *implied, subject);
  verify_places(study.set, *implied, subject, scale);
  if (!implied->has_scale)
    subject.lines.push_back("nodes have no rotations, so that the stiffness does not show the unit of their positions");
  return subject;
}

}  // namespace bielle::reduce

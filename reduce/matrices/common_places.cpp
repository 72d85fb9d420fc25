#include "reduce/matrices/common_places.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace bielle::reduce {

namespace {

/// Returns the nodes with all three components from `first` on.
std::vector<bool> nodes_with(const MatrixSet& set, int first) {
  std::vector<int> count(set.numbers.size(), 0);
  for (const NodalUnknown& u : set.unknowns)
    if (!u.is_scalar() && u.component >= first && u.component < first + 3) ++count[static_cast<std::size_t>(u.node)];
  std::vector<bool> result(count.size());
  std::transform(count.begin(), count.end(), result.begin(), [](int components) { return components == 3; });
  return result;
}

/// Places in cells of a grid with the tolerance as width.
class PlaceGrid {
 public:
  PlaceGrid(const Eigen::Matrix3Xd& places, double tolerance) : places_(places), tolerance_(tolerance) {
    for (Eigen::Index k = 0; k < places.cols(); ++k) cells_[cell_of(places.col(k))].push_back(k);
  }

  /// Returns the places no farther than the tolerance, ascending.
  std::vector<Eigen::Index> near(const Eigen::Vector3d& place) const {
    std::vector<Eigen::Index> result;
    const Cell middle = cell_of(place);
    for (std::int64_t i = -1; i <= 1; ++i)
      for (std::int64_t j = -1; j <= 1; ++j)
        for (std::int64_t k = -1; k <= 1; ++k) {
          const auto found = cells_.find({middle[0] + i, middle[1] + j, middle[2] + k});
          if (found == cells_.end()) continue;
          for (const Eigen::Index candidate : found->second)
            if ((places_.col(candidate) - place).norm() <= tolerance_) result.push_back(candidate);
        }
    std::sort(result.begin(), result.end());
    return result;
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  Cell cell_of(const Eigen::Vector3d& place) const {
    Cell cell{};
    for (int i = 0; i < 3; ++i)
      cell[static_cast<std::size_t>(i)] = static_cast<std::int64_t>(std::floor(place(i) / tolerance_));
    return cell;
  }

  const Eigen::Matrix3Xd& places_;
  double tolerance_;
  std::map<Cell, std::vector<Eigen::Index>> cells_;
};

bool same_unknowns(const MatrixSet& a, const MatrixSet& b, double tolerance) {
  if (a.size() != b.size() || a.numbers != b.numbers) return false;
  if (a.positions.cols() > 0 && (a.positions - b.positions).colwise().norm().maxCoeff() > tolerance) return false;
  for (std::size_t k = 0; k < a.unknowns.size(); ++k)
    if (a.unknowns[k].node != b.unknowns[k].node || a.unknowns[k].component != b.unknowns[k].component) return false;
  return std::equal(a.axes.begin(), a.axes.end(), b.axes.begin(),
                    [](const auto& p, const auto& q) { return (p - q).norm() < 1e-6; });
}

}  // namespace

PlacedMotions placed_motions(const MatrixSet& set, const Eigen::MatrixXd& motions) {
  PlacedMotions result;
  const std::vector<bool> moves = nodes_with(set, 0), turns = nodes_with(set, 3);
  for (std::size_t a = 0; a < moves.size(); ++a)
    if (moves[a]) result.nodes.push_back(static_cast<Eigen::Index>(a));
  const auto nodes = static_cast<Eigen::Index>(result.nodes.size());
  const Eigen::Index points = set.shapes ? set.shapes->points.cols() : 0;
  result.places.resize(3, nodes + points);
  result.displacements.resize(3 * (nodes + points), motions.cols());
  result.rotations.setZero(3 * (nodes + points), motions.cols());
  const Eigen::MatrixXd moved = nodal_motions(set, false) * motions, turned = nodal_motions(set, true) * motions;
  for (Eigen::Index k = 0; k < nodes; ++k) {
    const Eigen::Index node = result.nodes[static_cast<std::size_t>(k)];
    result.numbers.push_back(set.numbers[static_cast<std::size_t>(node)]);
    result.turns.push_back(turns[static_cast<std::size_t>(node)]);
    result.places.col(k) = set.positions.col(node);
    result.displacements.middleRows(3 * k, 3) = moved.middleRows(3 * node, 3);
    if (result.turns.back()) result.rotations.middleRows(3 * k, 3) = turned.middleRows(3 * node, 3);
  }
  if (points == 0) return result;
  result.numbers.insert(result.numbers.end(), set.shapes->numbers.begin(), set.shapes->numbers.end());
  result.places.rightCols(points) = set.shapes->points;
  result.displacements.bottomRows(3 * points) = set.shapes->displacement * motions;
  const bool points_turn = set.shapes->rotation.size() > 0;
  result.turns.resize(static_cast<std::size_t>(nodes + points), points_turn);
  if (points_turn) result.rotations.bottomRows(3 * points) = set.shapes->rotation * motions;
  return result;
}

CommonPlaces common_places(const PlacedMotions& a, const PlacedMotions& b, double tolerance) {
  CommonPlaces result;
  const PlaceGrid grid(b.places, tolerance);
  std::map<std::int64_t, Eigen::Index> by_number;
  for (std::size_t k = 0; k < b.nodes.size(); ++k) by_number[b.numbers[k]] = static_cast<Eigen::Index>(k);
  std::vector<bool> used(static_cast<std::size_t>(b.places.cols()), false);
  for (Eigen::Index k = 0; k < a.places.cols(); ++k) {
    std::vector<Eigen::Index> near = grid.near(a.places.col(k));
    const std::int64_t number = a.numbers[static_cast<std::size_t>(k)];
    std::stable_partition(near.begin(), near.end(),
                          [&](Eigen::Index j) { return b.numbers[static_cast<std::size_t>(j)] == number; });
    const auto found =
        std::find_if(near.begin(), near.end(), [&](Eigen::Index j) { return !used[static_cast<std::size_t>(j)]; });
    if (found != near.end()) {
      used[static_cast<std::size_t>(*found)] = true;
      result.a.push_back(k);
      result.b.push_back(*found);
    }
    if (k >= static_cast<Eigen::Index>(a.nodes.size())) continue;
    if (const auto same = by_number.find(number); same != by_number.end())
      result.moved += (b.places.col(same->second) - a.places.col(k)).norm() > tolerance;
  }
  return result;
}

CommonMotions common_motions(const PlacedMotions& a, const PlacedMotions& b, const CommonPlaces& common,
                             double length) {
  std::vector<Eigen::Index> turning;
  for (std::size_t k = 0; k < common.a.size(); ++k)
    if (a.turns[static_cast<std::size_t>(common.a[k])] && b.turns[static_cast<std::size_t>(common.b[k])])
      turning.push_back(static_cast<Eigen::Index>(k));
  const auto places = static_cast<Eigen::Index>(common.a.size()), turns = static_cast<Eigen::Index>(turning.size());
  const auto rows_of = [&](const PlacedMotions& motions, const std::vector<Eigen::Index>& at) {
    Eigen::MatrixXd result(3 * (places + turns), motions.displacements.cols());
    for (Eigen::Index k = 0; k < places; ++k)
      result.middleRows(3 * k, 3) = motions.displacements.middleRows(3 * at[static_cast<std::size_t>(k)], 3);
    for (Eigen::Index k = 0; k < turns; ++k) {
      const auto place = static_cast<std::size_t>(turning[static_cast<std::size_t>(k)]);
      result.middleRows(3 * (places + k), 3) = length * motions.rotations.middleRows(3 * at[place], 3);
    }
    return result;
  };
  return {rows_of(a, common.a), rows_of(b, common.b)};
}

std::optional<Eigen::MatrixXd> expressed_in(const MatrixSet& to, const MatrixSet& from, const Eigen::MatrixXd& motions,
                                            double tolerance) {
  if (same_unknowns(to, from, tolerance)) return motions;
  if (to.scalars() > 0) return std::nullopt;
  const PlacedMotions source = placed_motions(from, motions);
  const PlaceGrid grid(source.places, tolerance);
  Eigen::MatrixXd result(to.size(), motions.cols());
  for (Eigen::Index k = 0; k < to.size(); ++k) {
    const NodalUnknown& u = to.unknowns[static_cast<std::size_t>(k)];
    const std::vector<Eigen::Index> near = grid.near(to.positions.col(u.node));
    const auto found = std::find_if(near.begin(), near.end(), [&](Eigen::Index j) {
      return !u.is_rotation() || source.turns[static_cast<std::size_t>(j)];
    });
    if (found == near.end()) return std::nullopt;
    const Eigen::RowVector3d direction = to.axes[static_cast<std::size_t>(u.node)].col(u.component % 3).transpose();
    result.row(k) = direction * (u.is_rotation() ? source.rotations : source.displacements).middleRows(3 * *found, 3);
  }
  return result;
}

}  // namespace bielle::reduce

#include "reduce/matrices/implied_positions.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "reduce/dense/dense_products.hpp"
#include "reduce/dense/dense_solves.hpp"
#include "reduce/dense/orthogonal_factors.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "reduce/fe/elasticity.hpp"
#include "reduce/reduction/rigid_motions.hpp"

namespace bielle::reduce {

namespace {

using NodeRows = Eigen::Matrix<double, 3, 6>;
constexpr int reweightings = 30;

/// Returns weights that make a sum of squares one of distances. @param size  distance that counts as zero
Eigen::VectorXd weights_by(const Eigen::VectorXd& distances, double size) {
  return (distances.array() / size + 1e-9).inverse().min(1e9).matrix() / 1e9;
}

/// Displacements and rotations of nodes in body axes, for each of six motions.
struct NodalMotion {
  std::vector<Eigen::Index> nodes;
  std::vector<NodeRows> displacements;
  std::vector<std::optional<NodeRows>> rotations;  // present for nodes with all three
};

NodalMotion motions_of_nodes(const MatrixSet& set, const Eigen::MatrixXd& motions) {
  std::vector<std::array<Eigen::Index, 6>> at(set.numbers.size(), {-1, -1, -1, -1, -1, -1});
  for (Eigen::Index k = 0; k < set.size(); ++k)
    if (const NodalUnknown& u = set.unknowns[static_cast<std::size_t>(k)]; !u.is_scalar())
      at[static_cast<std::size_t>(u.node)][static_cast<std::size_t>(u.component)] = k;
  NodalMotion result;
  for (std::size_t a = 0; a < at.size(); ++a) {
    if (std::any_of(at[a].begin(), at[a].begin() + 3, [](Eigen::Index k) { return k < 0; })) continue;
    result.nodes.push_back(static_cast<Eigen::Index>(a));
    const std::array<Eigen::Index, 3> x = {at[a][0], at[a][1], at[a][2]}, r = {at[a][3], at[a][4], at[a][5]};
    result.displacements.emplace_back(set.axes[a] * motions(x, Eigen::all));
    const bool turns = std::all_of(r.begin(), r.end(), [](Eigen::Index k) { return k >= 0; });
    result.rotations.push_back(turns ? std::optional<NodeRows>(set.axes[a] * motions(r, Eigen::all)) : std::nullopt);
  }
  return result;
}

using SixBySix = Eigen::Matrix<double, 6, 6>;
using SixByThree = Eigen::Matrix<double, 6, 3>;

/// Combinations that translate all nodes alike.
SixByThree translations_of(const NodalMotion& motion, double length) {
  const std::size_t count = motion.nodes.size();
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(count));
  SixByThree result = SixByThree::Zero();
  for (int trial = 0; trial < reweightings; ++trial) {
    SixBySix gram = SixBySix::Zero();
    SixByThree right = SixByThree::Zero();
    for (std::size_t a = 0; a < count; ++a) {
      const double w = weights(static_cast<Eigen::Index>(a));
      gram += w * motion.displacements[a].transpose() * motion.displacements[a];
      right += w * motion.displacements[a].transpose();
      if (motion.rotations[a]) gram += w * length * length * motion.rotations[a]->transpose() * *motion.rotations[a];
    }
    result = pseudo_inverse(gram) * right;
    for (std::size_t a = 0; a < count; ++a)
      weights(static_cast<Eigen::Index>(a)) =
          (motion.displacements[a] * result - Eigen::Matrix3d::Identity()).norm() +
          (motion.rotations[a] ? length * (*motion.rotations[a] * result).norm() : 0.0);
    weights = weights_by(weights, 1);
  }
  return result;
}

/// Returns the combinations that turn all nodes alike, by their rotations. The translations that they contain are
/// arbitrary.
SixByThree rotations_by_nodes(const NodalMotion& motion) {
  const std::size_t count = motion.nodes.size();
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(count));
  SixByThree result = SixByThree::Zero();
  for (int trial = 0; trial < reweightings; ++trial) {
    SixBySix gram = SixBySix::Zero();
    SixByThree right = SixByThree::Zero();
    for (std::size_t a = 0; a < count; ++a) {
      if (!motion.rotations[a]) continue;
      const double w = weights(static_cast<Eigen::Index>(a));
      gram += w * motion.rotations[a]->transpose() * *motion.rotations[a];
      right += w * motion.rotations[a]->transpose();
    }
    const SymmetricEigenpairs pairs = symmetric_eigenpairs(gram);  // three are zero: those of translations
    const SixByThree turning = pairs.vectors.rightCols<3>();
    result = turning * pairs.values.tail<3>().cwiseInverse().asDiagonal() * turning.transpose() * right;
    for (std::size_t a = 0; a < count; ++a)
      weights(static_cast<Eigen::Index>(a)) =
          motion.rotations[a] ? (*motion.rotations[a] * result - Eigen::Matrix3d::Identity()).norm() : 1.0;
    weights = weights_by(weights, 1);
  }
  return result;
}

/// xx yy zz yz xz xy of the symmetric part of each 3 x 3 matrix that one of nine coefficients multiplies.
using Symmetric = Eigen::Matrix<double, 6, 9>;

Symmetric symmetric_parts(const Eigen::Matrix3d& d) {
  Symmetric result = Symmetric::Zero();
  for (int p = 0; p < 6; ++p)
    for (int k = 0; k < 3; ++k) {  // (d G)_ij = sum over k of d_ik G_kj; G by columns
      const auto [i, j] = voigt_pairs[static_cast<std::size_t>(p)];
      result(p, 3 * j + k) += d(i, k) / 2;
      result(p, 3 * i + k) += d(j, k) / 2;
    }
  return result;
}

/// Returns the same without rotations of nodes: displacements u_a = (d_a G + const) e with an antisymmetric matrix.
SixByThree rotations_by_displacements(const NodalMotion& motion, const SixByThree& translations) {
  const SixByThree others = orthogonal_basis(translations).rightCols(3);
  std::vector<Symmetric> parts;
  Symmetric mean = Symmetric::Zero();
  for (const NodeRows& rows : motion.displacements) {
    parts.push_back(symmetric_parts(rows * others));
    mean += parts.back() / static_cast<double>(motion.displacements.size());
  }
  Eigen::Matrix<double, 9, 9> gram = Eigen::Matrix<double, 9, 9>::Zero();
  for (const Symmetric& part : parts) gram += (part - mean).transpose() * (part - mean);
  const Eigen::VectorXd coefficients = symmetric_eigenpairs(gram).vectors.col(0);
  return others * Eigen::Map<const Eigen::Matrix3d>(coefficients.data());
}

double angle_of(const Eigen::Matrix3d& turn) {
  const Eigen::Vector3d axis(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1));
  return std::atan2(axis.norm(), turn.trace() - 1);
}

/// Returns the positions by u = theta x x with unit theta, up to a common displacement.
Eigen::Matrix3Xd positions_by(const NodalMotion& motion, const SixByThree& rotations) {
  Eigen::Matrix3Xd result(3, static_cast<Eigen::Index>(motion.nodes.size()));
  for (std::size_t a = 0; a < motion.nodes.size(); ++a) {
    const Eigen::Matrix3d u = motion.displacements[a] * rotations;  // -x~
    result.col(static_cast<Eigen::Index>(a)) =
        Eigen::Vector3d(u(1, 2) - u(2, 1), u(2, 0) - u(0, 2), u(0, 1) - u(1, 0)) / 2;
  }
  return result;
}

double median_of(Eigen::VectorXd values) {
  const auto middle = values.data() + values.size() / 2;
  std::nth_element(values.data(), middle, values.data() + values.size());
  return *middle;
}

/// Returns the quaternion with the largest q^T n q. It is not unique for points on a line; the one with the smallest
/// angle is then taken.
Eigen::Vector4d least_turn(const Eigen::Matrix4d& n) {
  const SymmetricEigenpairs pairs = symmetric_eigenpairs(n);
  const auto equal = (pairs.values.array() > pairs.values(3) - 1e-6 * std::abs(pairs.values(3))).count();
  const Eigen::MatrixXd largest = pairs.vectors.rightCols(equal);
  const Eigen::Vector4d q = largest * largest.row(0).transpose();
  return q.norm() > 1e-6 ? q.normalized() : Eigen::Vector4d(pairs.vectors.col(3));
}

/// Returns the sum of the distances of points from their median.
double spread_of(const Eigen::Matrix3Xd& points) {
  const Eigen::Vector3d centre(median_of(points.row(0)), median_of(points.row(1)), median_of(points.row(2)));
  return (points.colwise() - centre).colwise().norm().sum();
}

}  // namespace

std::optional<ImpliedPositions> implied_positions(const MatrixStudy& study, const Eigen::MatrixXd& motions) {
  const Eigen::VectorXd sizes = study.observed(motions).colwise().norm();
  const NodalMotion motion = motions_of_nodes(study.set, motions * sizes.cwiseInverse().asDiagonal());
  ImpliedPositions result;
  result.has_scale =
      std::any_of(motion.rotations.begin(), motion.rotations.end(), [](const auto& r) { return bool(r); });
  if (motion.nodes.size() < (result.has_scale ? 2u : 4u)) return std::nullopt;
  const SixByThree translations = translations_of(motion, study.length);
  result.nodes = motion.nodes;
  result.turns.resize(static_cast<Eigen::Index>(motion.nodes.size()));
  for (std::size_t a = 0; a < motion.nodes.size(); ++a)
    result.turns(static_cast<Eigen::Index>(a)) = angle_of(motion.displacements[a] * translations);
  if (result.has_scale) {
    result.positions = positions_by(motion, rotations_by_nodes(motion));
    return result;
  }
  result.positions = positions_by(motion, rotations_by_displacements(motion, translations));
  const Eigen::Matrix3Xd given = study.set.positions(Eigen::all, result.nodes);
  result.positions *= spread_of(given) / spread_of(result.positions);
  const Eigen::Matrix3Xd mirrored = -result.positions;
  // For a flat set of nodes both fit, one of them after a rotation by half a turn. The smaller rotation is then chosen.
  const Similarity as_found = nearest_similarity(given, result.positions), other = nearest_similarity(given, mirrored);
  const double found = as_found.distances.sum(), opposite = other.distances.sum();
  const bool both = std::abs(found - opposite) < 1e-6 * spread_of(given);
  if (both ? angle_of(other.turn) < angle_of(as_found.turn) : opposite < found) result.positions = mirrored;
  return result;
}

Similarity nearest_translation(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to) {
  Similarity result;
  for (int i = 0; i < 3; ++i) result.offset(i) = median_of((to.row(i) - from.row(i)).transpose());
  result.distances = ((to - from).colwise() - result.offset).colwise().norm();
  return result;
}

Similarity nearest_similarity(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to) {
  Similarity result;
  const double size = std::max(spread_of(to) / static_cast<double>(to.cols()), 1e-300);
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(from.cols());
  for (int trial = 0; trial < reweightings; ++trial) {
    weights /= weights.sum();
    const Eigen::Vector3d from_centre = from * weights, to_centre = to * weights;
    const Eigen::Matrix3Xd a = from.colwise() - from_centre, b = to.colwise() - to_centre;
    const Eigen::Matrix3d s = a * weights.asDiagonal() * b.transpose();
    Eigen::Matrix4d n;
    n << s.trace(), s(1, 2) - s(2, 1), s(2, 0) - s(0, 2), s(0, 1) - s(1, 0),   //
        0, s(0, 0) - s(1, 1) - s(2, 2), s(0, 1) + s(1, 0), s(2, 0) + s(0, 2),  //
        0, 0, s(1, 1) - s(0, 0) - s(2, 2), s(1, 2) + s(2, 1),                  //
        0, 0, 0, s(2, 2) - s(0, 0) - s(1, 1);
    n = Eigen::Matrix4d(n.selfadjointView<Eigen::Upper>());
    const Eigen::Vector4d q = least_turn(n);
    result.turn = Eigen::Quaterniond(q(0), q(1), q(2), q(3)).toRotationMatrix();
    const Eigen::Matrix3Xd turned = result.turn * a;
    const double squares = (turned.array().square().matrix() * weights).sum();
    result.factor = squares > 0 ? ((turned.array() * b.array()).matrix() * weights).sum() / squares : 1;
    result.offset = to_centre - result.factor * result.turn * from_centre;
    result.distances = ((to - result.factor * result.turn * from).colwise() - result.offset).colwise().norm();
    weights = weights_by(result.distances, size);
  }
  return result;
}

}  // namespace bielle::reduce

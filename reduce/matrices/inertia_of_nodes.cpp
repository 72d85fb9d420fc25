// The blocks of a mass matrix between two nodes as rigid clouds of mass around them. With the displacement v and the
// rotation t of the nodes a and b, and u = v + t x r in a cloud,
//     sum of rho u_k u'_l = v_k m v'_l + v_k (s x e_l).t' + (s x e_k).t v'_l + (e_k x t).P (e_l x t'),
// where m is a third of the trace of the block of displacements, s belongs to the skew part -s~ of that between
// displacements and rotations, and P = tr(J)/2 I - J to that of rotations.
#include <vector>

#include <Eigen/Geometry>

#include "reduce/dense/dense_products.hpp"
#include "reduce/fe/elasticity.hpp"
#include "reduce/matrices/body_inertia.hpp"
#include "reduce/reduction/rigid_motions.hpp"

namespace bielle::reduce {

namespace {

using Entries = std::vector<Eigen::Triplet<double>>;

/// Calls work(a, b, block) for the blocks of three rows and columns of a matrix.
template <class Work>
void for_blocks(const SparseColumns& matrix, const Work& work) {
  const auto nodes = static_cast<std::size_t>(matrix.rows() / 3);
  std::vector<Eigen::Matrix3d> blocks(nodes);
  std::vector<int> found(nodes, -1), rows;
  for (int b = 0; 3 * b < matrix.cols(); ++b) {
    rows.clear();
    for (int j = 0; j < 3; ++j)
      for (SparseColumns::InnerIterator entry(matrix, 3 * b + j); entry; ++entry) {
        const auto a = static_cast<std::size_t>(entry.row() / 3);
        if (found[a] != b) {
          found[a] = b;
          blocks[a].setZero();
          rows.push_back(static_cast<int>(a));
        }
        blocks[a](entry.row() % 3, j) = entry.value();
      }
    for (const int a : rows) work(a, b, blocks[static_cast<std::size_t>(a)]);
  }
}

SparseColumns made_of(const Entries& entries, Eigen::Index rows, Eigen::Index columns) {
  SparseColumns result(rows, columns);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

Eigen::MatrixXd every_third_row(const Eigen::MatrixXd& matrix, int first) {
  return matrix(Eigen::seqN(first, matrix.rows() / 3, 3), Eigen::all);
}

/// Returns (nodes, 3 nodes): rows s x e_l of each pair of nodes.
SparseColumns arms(const SparseColumns& coupling, int l) {
  Entries entries;
  for_blocks(coupling, [&](int a, int b, const Eigen::Matrix3d& block) {
    const Eigen::Vector3d s(block(1, 2) - block(2, 1), block(2, 0) - block(0, 2), block(0, 1) - block(1, 0));
    const Eigen::Vector3d row = (s / 2).cross(Eigen::Vector3d::Unit(l));
    for (int i = 0; i < 3; ++i) entries.emplace_back(a, 3 * b + i, row(i));
  });
  return made_of(entries, coupling.rows() / 3, coupling.cols());
}

/// Returns (3 nodes, 3 nodes): e_k~^T P e_l~ of each pair of nodes.
SparseColumns clouds(const SparseColumns& rotary, int k, int l) {
  Entries entries;
  const Eigen::Matrix3d left = skew(Eigen::Vector3d::Unit(k)).transpose(), right = skew(Eigen::Vector3d::Unit(l));
  for_blocks(rotary, [&](int a, int b, const Eigen::Matrix3d& J) {
    const Eigen::Matrix3d block = left * (J.trace() / 2 * Eigen::Matrix3d::Identity() - J) * right;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) entries.emplace_back(3 * a + i, 3 * b + j, block(i, j));
  });
  return made_of(entries, rotary.rows(), rotary.cols());
}

}  // namespace

std::array<Eigen::MatrixXd, 6> inertia_of_nodes(const MatrixSet& set, const Eigen::MatrixXd& shapes, bool rotations) {
  const SparseColumns X = nodal_motions(set, false), Y = nodal_motions(set, true);
  Entries scalar;
  for_blocks(SparseColumns(X * set.mass * X.transpose()),
             [&](int a, int b, const Eigen::Matrix3d& block) { scalar.emplace_back(a, b, block.trace() / 3); });
  const SparseColumns m = made_of(scalar, set.positions.cols(), set.positions.cols());
  const Eigen::MatrixXd v = X * shapes;
  std::array<Eigen::MatrixXd, 6> result;
  for (std::size_t s = 0; s < 6; ++s) {
    const auto [k, l] = voigt_pairs[s];
    result[s] = transposed_product(every_third_row(v, k), m * every_third_row(v, l));
  }
  if (!rotations || Y.nonZeros() == 0) return result;
  const SparseColumns coupling = X * set.mass * Y.transpose(), rotary = Y * set.mass * Y.transpose();
  const Eigen::MatrixXd t = Y * shapes;
  std::array<Eigen::MatrixXd, 3> turned;
  for (int k = 0; k < 3; ++k) turned[static_cast<std::size_t>(k)] = arms(coupling, k) * t;
  for (std::size_t s = 0; s < 6; ++s) {
    const auto [k, l] = voigt_pairs[s];
    const Eigen::MatrixXd& of_k = turned[static_cast<std::size_t>(k)];
    const Eigen::MatrixXd& of_l = turned[static_cast<std::size_t>(l)];
    result[s] += transposed_product(every_third_row(v, k), of_l);
    result[s] += transposed_product(of_k, every_third_row(v, l));
    result[s] += transposed_product(t, clouds(rotary, k, l) * t);
  }
  return result;
}

}  // namespace bielle::reduce

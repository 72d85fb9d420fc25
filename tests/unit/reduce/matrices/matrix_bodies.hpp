// Sets of matrices for several tests: those of meshes, and beams of two or more nodes with six unknowns each.
#pragma once

#include <Eigen/Geometry>

#include "reduce/common/progress.hpp"
#include "reduce/fe/assembly.hpp"
#include "reduce/matrices/reduce_matrices.hpp"
#include "tests/unit/reduce/reduction/bodies.hpp"

namespace bielle::test {

inline reduce::SparseColumns sparse(const Eigen::MatrixXd& matrix) { return matrix.sparseView(); }

/// Returns K and M of a steel mesh; nodes are numbered from 1.
inline reduce::MatrixSet matrices_of(const reduce::Mesh& mesh) {
  const reduce::Solid solid = steel_solid(mesh);
  const reduce::NodeGraph graph = reduce::node_graph(mesh);
  const Eigen::Index points = mesh.point_count(), n = 3 * points;
  const SymmetricMatrix stiffness = reduce::assemble_stiffness(solid, graph);
  const reduce::NodeMatrix mass = reduce::assemble_mass(solid, graph);
  reduce::MatrixSet set;
  set.name = "box";
  set.source = "mesh of the test";
  set.positions = mesh.points;
  set.axes.assign(static_cast<std::size_t>(points), Eigen::Matrix3d::Identity());
  for (int a = 0; a < points; ++a) {
    set.numbers.push_back(a + 1);
    for (int i = 0; i < 3; ++i) set.unknowns.push_back({a, i});
  }
  set.stiffness = sparse(stiffness.multiply(Eigen::MatrixXd::Identity(n, n)));
  set.mass = sparse(mass.multiply(Eigen::MatrixXd::Identity(n, n), 3, 1));
  return set;
}

/// Rotates the axes of each node by its own angle, and transforms the matrices.
inline void turn_nodes(reduce::MatrixSet& set) {
  Eigen::MatrixXd turn = Eigen::MatrixXd::Zero(set.size(), set.size());
  for (std::size_t a = 0; a < set.numbers.size(); ++a)
    set.axes[a] =
        Eigen::AngleAxisd(0.3 + static_cast<double>(a), Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  for (Eigen::Index k = 0; k < set.size(); ++k)
    for (Eigen::Index j = 0; j < set.size(); ++j) {
      const auto &row = set.unknowns[static_cast<std::size_t>(k)], &column = set.unknowns[static_cast<std::size_t>(j)];
      if (row.node == column.node && row.is_rotation() == column.is_rotation())
        turn(k, j) = set.axes[static_cast<std::size_t>(row.node)](row.component % 3, column.component % 3);
    }
  set.stiffness = sparse(turn.transpose() * set.stiffness * turn);
  set.mass = sparse(turn.transpose() * set.mass * turn);
}

/// Returns the numbers of the nodes in a group of a mesh, as numbered by `matrices_of`.
inline std::vector<std::int64_t> node_numbers(const reduce::Mesh& mesh, const std::string& group) {
  std::vector<std::int64_t> result;
  for (const int node : mesh.groups.at(group).nodes) result.push_back(node + 1);
  return result;
}

inline reduce::NodeInterface tied(const std::string& name, const std::vector<std::int64_t>& nodes,
                                  reduce::Tie tie = reduce::Tie::rigid) {
  reduce::NodeInterface interface;
  interface.name = name;
  interface.nodes = nodes;
  interface.tie = tie;
  interface.subject = "interfaces." + name;
  return interface;
}

inline Superelement reduced(reduce::MatrixSet set, const reduce::MatrixOptions& options) {
  Progress quiet(true);
  return reduce::reduce_matrices(set, options, quiet);
}

/// Returns a straight Euler-Bernoulli beam along x with its consistent mass matrix (J. S. Przemieniecki, Theory of
/// Matrix Structural Analysis, 1968, chapter 11, without rotary inertia of bending): length 2 m, EA = 1e7 N, GJ = 1e4 N
/// m^2, EI = 2e4 (about y), 3e4 (about z) N m^2, 3 kg/m, 1e-4 kg m of torsion.
inline reduce::MatrixSet beam_set(int elements = 1) {
  const double L = 2.0 / elements, EA = 1e7, GJ = 1e4, rho = 3, polar = 1e-4;
  const int nodes = elements + 1;
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(6 * nodes, 6 * nodes), M = K;
  for (int e = 0; e < elements; ++e) {
    const auto add = [&](Eigen::MatrixXd& into, const std::vector<int>& at, const Eigen::MatrixXd& part) {
      for (int i = 0; i < part.rows(); ++i)
        for (int j = 0; j < part.cols(); ++j) into(6 * e + at[i], 6 * e + at[j]) += part(i, j);
    };
    Eigen::Matrix2d bar, line;
    bar << 1, -1, -1, 1;
    line << 2, 1, 1, 2;
    add(K, {0, 6}, EA / L * bar);
    add(K, {3, 9}, GJ / L * bar);
    add(M, {0, 6}, rho * L / 6 * line);
    add(M, {3, 9}, polar * L / 6 * line);
    for (const int plane : {1, 2}) {  // displacement y with rotation z, displacement z with rotation -y
      const double EI = plane == 1 ? 3e4 : 2e4, s = plane == 1 ? 1 : -1;
      Eigen::Matrix4d k, m;
      k << 12, 6 * L * s, -12, 6 * L * s, 6 * L * s, 4 * L * L, -6 * L * s, 2 * L * L, -12, -6 * L * s, 12, -6 * L * s,
          6 * L * s, 2 * L * L, -6 * L * s, 4 * L * L;
      m << 156, 22 * L * s, 54, -13 * L * s, 22 * L * s, 4 * L * L, 13 * L * s, -3 * L * L, 54, 13 * L * s, 156,
          -22 * L * s, -13 * L * s, -3 * L * L, -22 * L * s, 4 * L * L;
      const int turn = plane == 1 ? 5 : 4;
      add(K, {plane, turn, 6 + plane, 6 + turn}, EI / (L * L * L) * k);
      add(M, {plane, turn, 6 + plane, 6 + turn}, rho * L / 420 * m);
    }
  }
  reduce::MatrixSet set;
  set.name = "beam";
  set.source = "beam of the test";
  set.positions = Eigen::Matrix3Xd::Zero(3, nodes);
  set.axes.assign(static_cast<std::size_t>(nodes), Eigen::Matrix3d::Identity());
  for (int a = 0; a < nodes; ++a) {
    set.positions(0, a) = a * L;
    set.numbers.push_back(10 * (a + 1));
    for (int c = 0; c < 6; ++c) set.unknowns.push_back({a, c});
  }
  set.stiffness = sparse(K);
  set.mass = sparse(M);
  return set;
}

}  // namespace bielle::test

// A solid with supports, solved directly, for comparison with a reduction.
#pragma once

#include <functional>
#include <numbers>

#include "reduce/fe/assembly.hpp"
#include "reduce/sparse/symmetric_factor.hpp"
#include "reduce/spectral/eigenpairs.hpp"

namespace bielle::test {

class SolidModel {
 public:
  /// @param fixed  whether component 0..2 of the point at x is held; none: a free body
  SolidModel(reduce::Mesh body, const reduce::Material& material,
             const std::function<bool(const Eigen::Vector3d& x, int component)>& fixed = {})
      : mesh(std::move(body)),
        solid(reduce::make_solid(mesh, {{"material", material}}, {{"all", "material"}})),
        graph(reduce::node_graph(mesh)),
        stiffness(reduce::assemble_stiffness(solid, graph)),
        mass(reduce::assemble_mass(solid, graph)) {
    for (Eigen::Index a = 0; a < mesh.point_count(); ++a) {
      for (int i = 0; i < 3; ++i) {
        if (!fixed || !fixed(mesh.points.col(a), i)) {
          free_.push_back(3 * a + i);
        }
      }
    }
  }
  SolidModel(const SolidModel&) = delete;

  /// Returns the natural frequencies [Hz], ascending; a free body's six rigid motions are left out.
  Eigen::VectorXd frequencies(int count, const EigenpairOptions& options = {}) const {
    const bool is_free = static_cast<Eigen::Index>(free_.size()) == 3 * mesh.point_count();
    const double shift = is_free ? -1e6 : 0;  // (rad/s)^2
    SymmetricMatrix shifted = stiffness;
    for (std::int64_t j = 0; shift != 0 && j < shifted.size; ++j) {
      for (std::int64_t p = shifted.starts[j]; p < shifted.starts[j + 1]; ++p) {
        if (const std::int64_t i = shifted.rows[p]; i % 3 == j % 3) {
          shifted.values[p] -= shift * mass.values[graph.place(static_cast<int>(j / 3), static_cast<int>(i / 3))];
        }
      }
    }
    const SymmetricFactor factor(principal_submatrix(shifted, free_));
    const ShiftInvertProblem problem{factor.size(), shift, [&](const Eigen::MatrixXd& b) { return factor.solve(b); },
                                     [&](const Eigen::MatrixXd& x) { return restrict(mass.multiply(expand(x), 3)); }};
    const int rigid = is_free ? 6 : 0;
    return shift_invert_eigenpairs(problem, count + rigid, options).values.tail(count).cwiseSqrt() /
           (2 * std::numbers::pi);
  }

  /// Returns the displacements of all points under forces on all points.
  RowMatrix solve(const RowMatrix& forces) const {
    return expand(SymmetricFactor(principal_submatrix(stiffness, free_)).solve(restrict(forces)));
  }

  const reduce::Mesh mesh;
  const reduce::Solid solid;
  const reduce::NodeGraph graph;
  const SymmetricMatrix stiffness;
  const reduce::NodeMatrix mass;

 private:
  RowMatrix expand(const Eigen::MatrixXd& x) const {
    RowMatrix all = RowMatrix::Zero(3 * mesh.point_count(), x.cols());
    all(free_, Eigen::all) = x;
    return all;
  }
  Eigen::MatrixXd restrict(const RowMatrix& all) const { return all(free_, Eigen::all); }

  std::vector<std::int64_t> free_;
};

}  // namespace bielle::test

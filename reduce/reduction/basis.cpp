#include "reduce/reduction/basis.hpp"

#include <algorithm>
#include <cmath>

#include "reduce/dense/blas.hpp"
#include "reduce/reduction/rigid_motions.hpp"
#include "reduce/spectral/eigenpairs.hpp"

namespace bielle::reduce {

namespace {

/// Returns M times the linear fields; masses have the field at their elements.
RowMatrix linear_inertia(const Solid& solid, const BodyMatrices& matrices, const Eigen::Vector3d& centre) {
  RowMatrix functions(solid.points(), 4);
  functions << Eigen::VectorXd::Ones(solid.points()), (solid.mesh.points.colwise() - centre).transpose();
  const RowMatrix products = matrices.mesh_mass_times(functions, 1);
  RowMatrix result = RowMatrix::Zero(3 * solid.points(), LinearFields::count);
  for (Eigen::Index a = 0; a < solid.points(); ++a) {
    for (int i = 0; i < 3; ++i) {
      result.block<1, 4>(3 * a + i, 4 * i) = products.row(a);
    }
  }
  matrices.masses().add_linear_inertia(centre, result);
  return result;
}

/// Solves for the held body under unit displacements of its interfaces and under the inertia of linear fields, as one
/// block of right-hand sides, since the time of solutions is limited by memory bandwidth, not by their number.
Eigen::MatrixXd static_solutions(const BodyMatrices& matrices, const Ties& ties, const FixedInterfaceBody& held,
                                 const RowMatrix& inertia) {
  const Eigen::Index kept = ties.carry_kept.cols();
  Eigen::MatrixXd loads(held.size(), kept + inertia.cols());
  if (ties.carry_kept.nonZeros() > 0)
    loads.leftCols(kept) = -held.restrict(matrices.stiffness_times(RowMatrix(ties.carry_kept)));
  else
    loads.leftCols(kept).setZero();  // average ties carry no points
  loads.rightCols(inertia.cols()) = held.restrict(inertia);
  Eigen::MatrixXd averages = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(ties.averages.size()), loads.cols());
  for (Eigen::Index k = 0; k < averages.rows(); ++k) {
    averages(k, ties.averages[k]) = 1;
  }
  return held.solve(loads, averages);
}

/// Computes Psi <- Psi (I - U A) + U_points A.
void put_rigid_motions_in(const Solid& solid, const Ties& ties, const MassProperties& body, int threads, Basis& basis) {
  const Eigen::MatrixXd nearest = nearest_rigid_motion(ties.interfaces, body.centre, radius_of_gyration(body));
  const Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(basis.kept(), basis.kept()) -
                               interface_rigid_motions(ties.interfaces, body.centre) * nearest;
  const std::vector<bool> inside = points_of_solid(solid);
  const Eigen::Index kept = basis.kept(), all = basis.shapes.cols();
  constexpr Eigen::Index at_a_time = 256;  // points: their rows stay in the cache
  const BlasThreads one(1);
#pragma omp parallel num_threads(threads)
  {
    RowMatrix old;
#pragma omp for schedule(static)
    for (Eigen::Index first = 0; first < solid.points(); first += at_a_time) {
      const Eigen::Index count = std::min(at_a_time, solid.points() - first), rows = 3 * count;
      const RowMatrix motions = rigid_motions(solid.mesh.points.middleCols(first, count), body.centre);
      auto panel = basis.shapes.block(3 * first, 0, rows, kept);
      old = panel;
      panel.setZero();
      // A row-major block is the transpose of a block stored by columns.
      add_dense_product({rest.data(), kept, kept, kept, true}, {old.data(), kept, rows, kept, false}, panel.data(),
                        all);
      add_dense_product({nearest.data(), kept, 6, 6, true}, {motions.data(), 6, rows, 6, false}, panel.data(), all);
      for (Eigen::Index a = 0; a < count; ++a)
        if (!inside[static_cast<std::size_t>(first + a)]) panel.middleRows<3>(3 * a).setZero();
    }
  }
  for (Eigen::Index c = 0; c < basis.released.rows(); ++c) {
    const Direction direction = ties.released[c];
    auto row = basis.released.row(c).head(basis.kept());
    row = Eigen::RowVectorXd(row * rest +
                             interface_rigid_motion(ties.interfaces[direction.interface], direction.axis, body.centre) *
                                 nearest);
  }
}

}  // namespace

double radius_of_gyration(const MassProperties& body) { return std::sqrt(body.inertia.trace() / (2 * body.mass)); }

Basis make_basis(const Solid& solid, const BodyMatrices& matrices, const Ties& ties, const FixedInterfaceBody& held,
                 const MassProperties& body, const ModeRequest& modes, Progress& progress, int threads) {
  progress.start("constraint modes");
  Basis basis;
  const auto kept = static_cast<Eigen::Index>(ties.kept.size());
  const Eigen::Index released = ties.carry_released.cols();
  basis.linear.inertia = linear_inertia(solid, matrices, body.centre);
  Eigen::MatrixXd solutions = static_solutions(matrices, ties, held, basis.linear.inertia);
  basis.linear.held = held.expand(solutions.rightCols(LinearFields::count));
  solutions.conservativeResize(Eigen::NoChange, kept);

  progress.start("fixed-boundary modes");
  const ShiftInvertProblem problem{held.size(), 0, [&](const Eigen::MatrixXd& b) { return held.solve(b); },
                                   [&](const Eigen::MatrixXd& z) { return held.inertia(matrices, z); }};
  const auto search = [&](int count, const EigenpairOptions& how) { return matrices.eigenpairs(problem, count, how); };
  Eigenpairs pairs = requested_modes(modes, problem, search, progress, threads);
  basis.eigenvalues = pairs.values;
  basis.residuals = pairs.residuals;
  basis.solves = pairs.solves;
  basis.sweeps = pairs.sweeps;
  basis.method = pairs.method;
  basis.next = pairs.next;
  solutions.conservativeResize(Eigen::NoChange, kept + pairs.values.size());
  if (pairs.vectors.cols() > 0) solutions.rightCols(pairs.vectors.cols()) = pairs.vectors;
  pairs.vectors.resize(0, 0);  // frees memory: vectors with rows for all points are large
  basis.released = solutions.bottomRows(released);
  basis.shapes = held.expand(solutions);
  solutions.resize(0, 0);
  for (Eigen::Index row = 0; row < ties.carry_kept.rows(); ++row)
    for (SparseRows::InnerIterator entry(ties.carry_kept, row); entry; ++entry)
      basis.shapes(row, entry.col()) += entry.value();
  put_rigid_motions_in(solid, ties, body, threads, basis);
  return basis;
}

}  // namespace bielle::reduce

#include "reduce/fe/stress_fit.hpp"

#include <algorithm>

#include "reduce/dense/blas.hpp"
#include "reduce/dense/dense_solves.hpp"

namespace bielle::reduce {

FittedStress PatchFit::fit(const Surroundings& around, int threads, double* coefficients) const {
  const auto count = static_cast<Eigen::Index>(around.vertices.size());
  const Eigen::Index size = 6 * samples_.fields;
  FittedStress result{terms_, samples_.fields, coefficients, std::vector<double>(around.vertices.size())};
#pragma omp parallel num_threads(threads)
  {
    Eigen::Matrix3Xd places;
    Eigen::MatrixXd polynomials, values, normal(terms_, terms_), right(terms_, size);
#pragma omp for schedule(dynamic, 64)
    for (Eigen::Index v = 0; v < count; ++v) {
      const std::vector<int> patch = patch_of(solid_, around, static_cast<std::size_t>(v), least_cells_);
      result.scale[v] = gather(patch, solid_.mesh.points.col(around.vertices[v]), places, values);
      polynomials.resize(terms_, places.cols());
      for (Eigen::Index p = 0; p < places.cols(); ++p) set_terms(places.col(p), terms_, polynomials.col(p).data());
      normal.setZero();
      right.setZero();
      const DenseBlock of_terms{polynomials.data(), terms_, places.cols(), terms_, false};
      add_dense_product(of_terms, {polynomials.data(), places.cols(), terms_, terms_, true}, normal.data(), terms_);
      add_dense_product(of_terms, {values.data(), places.cols(), size, size, true}, right.data(), terms_);
      // Regular meshes and small bodies leave terms undetermined; the terms of high degree are then set to zero, not
      // those of low degree.
      const double trace = normal.trace();
      normal.diagonal().tail(terms_ - 1).array() += 1e-12 * trace;
      if (terms_ == most_terms) normal.diagonal().tail(terms_ - 4).array() += 1e-9 * trace;
      Eigen::Map<Eigen::MatrixXd>(coefficients + v * terms_ * size, size, terms_) =
          solve_symmetric(normal, right).transpose();
    }
  }
  return result;
}

double PatchFit::gather(const std::vector<int>& patch, const Eigen::Vector3d& centre, Eigen::Matrix3Xd& places,
                        Eigen::MatrixXd& values) const {
  Eigen::Index count = 0, at = 0;
  for (const int cell : patch) count += samples_.points(cell);
  places.resize(3, count);
  values.resize(6 * samples_.fields, count);
  for (const int cell : patch) {
    const Eigen::Index points = samples_.points(cell);
    places.middleCols(at, points) = samples_.places.middleCols(samples_.first[cell], points).colwise() - centre;
    std::copy_n(samples_.of(cell), values.rows() * points, values.col(at).data());
    at += points;
  }
  const double scale = places.colwise().norm().maxCoeff();
  places /= scale;
  return scale;
}

}  // namespace bielle::reduce

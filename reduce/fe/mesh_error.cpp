#include "reduce/fe/mesh_error.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "reduce/common/dense_solves.hpp"
#include "reduce/fe/cell_geometry.hpp"
#include "reduce/fe/elasticity.hpp"
#include "reduce/spectral/blas.hpp"

namespace bielle::reduce {

namespace {

constexpr int at_a_time = 6;  // so many fields: stress at all sampling points is in memory, and sizes are fixed

using SixRows = Eigen::Matrix<double, 6, at_a_time, Eigen::RowMajor>;  // a component of all fields in each row
using Fields = Eigen::Matrix<double, Eigen::Dynamic, at_a_time, Eigen::RowMajor>;
using Samples = Eigen::Matrix<double, Eigen::Dynamic, 6 * at_a_time, Eigen::RowMajor>;

/// What depends on the type of cell: points at which stress is most accurate, and the polynomial fitted to them.
template <int N>
struct Fit {
  static constexpr int terms = N == 4 ? 4 : 10;
  static constexpr int sampling_degree = N == 4 ? 0 : 2;
  static constexpr int error_degree = N == 4 ? 2 : 3;
  using Terms = Eigen::Matrix<double, terms, 1>;
  using Normal = Eigen::Matrix<double, terms, terms>;

  static Terms polynomials(const Eigen::Vector3d& x) {
    Terms result;
    result.template head<4>() << 1, x;
    if constexpr (N == 10) result.template tail<6>() << x.cwiseAbs2(), x.y() * x.z(), x.x() * x.z(), x.x() * x.y();
    return result;
  }
};

/// Strain at a point of a cell.
template <int N>
SixRows strain_at(const Fields& fields, const Eigen::MatrixXi& nodes, Eigen::Index cell,
                  const Eigen::Matrix<double, N, 3>& gradients) {
  SixRows strain = SixRows::Zero();
  for (int a = 0; a < N; ++a)
    for (int i = 0; i < 3; ++i) {
      const auto u = fields.row(3 * static_cast<Eigen::Index>(nodes(a, cell)) + i);
      for (int j = 0; j < 3; ++j) strain.row(voigt(i, j)) += gradients(a, j) * u;
    }
  return strain;
}

/// Cells of one material around each of its vertices.
struct Surroundings {
  std::vector<int> vertices;            // points
  std::vector<int> number;              // of each point, in `vertices`; -1: no vertex of the material
  std::vector<std::vector<int>> cells;  // around each vertex
};

Surroundings surroundings(const Solid& solid, int material) {
  Surroundings result;
  result.number.assign(solid.points(), -1);
  for (Eigen::Index e = 0; e < solid.cells(); ++e) {
    if (solid.material_of[e] != material) continue;
    for (int v = 0; v < 4; ++v) {
      int& number = result.number[solid.nodes(v, e)];
      if (number < 0) {
        number = static_cast<int>(result.vertices.size());
        result.vertices.push_back(solid.nodes(v, e));
        result.cells.emplace_back();
      }
      result.cells[number].push_back(static_cast<int>(e));
    }
  }
  return result;
}

/// The cells around a vertex, and around their vertices until there are as many as asked for or no more.
std::vector<int> patch_of(const Solid& solid, const Surroundings& around, std::size_t vertex, std::size_t least) {
  std::vector<int> patch = around.cells[vertex];
  for (std::size_t before = 0; patch.size() < least && patch.size() > before;) {
    before = patch.size();
    std::vector<int> wider;
    for (const int cell : patch)
      for (int v = 0; v < 4; ++v) {
        const std::vector<int>& more = around.cells[around.number[solid.nodes(v, cell)]];
        wider.insert(wider.end(), more.begin(), more.end());
      }
    std::sort(wider.begin(), wider.end());
    wider.erase(std::unique(wider.begin(), wider.end()), wider.end());
    patch = std::move(wider);
  }
  return patch;
}

/// The polynomials of all vertices of one material: `terms` rows for each vertex, one column for each component of each
/// field (component by component), in coordinates from the vertex in units of `scale`.
struct FittedStress {
  Samples coefficients;
  std::vector<double> scale;  // [m]
};

template <int N>
class Estimate {
 public:
  Estimate(const Solid& solid, int threads)
      : solid_(solid),
        threads_(threads),
        sampling_(simplex_quadrature(3, Fit<N>::sampling_degree)),
        rule_(simplex_quadrature(3, Fit<N>::error_degree)) {
    for (int m = 0; m < static_cast<int>(solid.materials.size()); ++m) around_.push_back(surroundings(solid, m));
  }

  /// Energies of the error and of the field, (cells, fields).
  void add(const Fields& fields, Fields& error, Fields& energy) const {
    const Samples samples = sample(fields);
    for (std::size_t m = 0; m < around_.size(); ++m)
      compare(fields, fit(samples, around_[m]), static_cast<int>(m), error, energy);
  }

 private:
  static constexpr int terms = Fit<N>::terms;

  CellPoints<N> points_of(Eigen::Index cell) const { return cell_points<N>(solid_.mesh.points, solid_.nodes, cell); }

  /// Stress at the sampling points, one row for each point of each cell.
  Samples sample(const Fields& fields) const {
    const auto points = static_cast<Eigen::Index>(sampling_.size());
    Samples result(solid_.cells() * points, 6 * at_a_time);
#pragma omp parallel for num_threads(threads_) schedule(static)
    for (Eigen::Index e = 0; e < solid_.cells(); ++e) {
      const CellPoints<N> x = points_of(e);
      Eigen::Matrix<double, N, 3> gradients;
      for (Eigen::Index p = 0; p < points; ++p) {
        map_point<N>(sampling_, p, x, gradients);
        Eigen::Map<SixRows>(result.row(e * points + p).data()) =
            solid_.materials[solid_.material_of[e]].elasticity * strain_at<N>(fields, solid_.nodes, e, gradients);
      }
    }
    return result;
  }

  FittedStress fit(const Samples& samples, const Surroundings& around) const {
    const auto points = static_cast<Eigen::Index>(sampling_.size());
    const auto count = static_cast<Eigen::Index>(around.vertices.size());
    FittedStress result{Samples(count * terms, 6 * at_a_time), std::vector<double>(count)};
    const std::size_t least = 2 * terms / sampling_.size() + 1;  // cells: two samples for each term
#pragma omp parallel for num_threads(threads_) schedule(dynamic, 64)
    for (Eigen::Index v = 0; v < count; ++v) {
      const std::vector<int> patch = patch_of(solid_, around, v, least);
      const Eigen::Vector3d centre = solid_.mesh.points.col(around.vertices[v]);
      Eigen::Matrix3Xd places(3, static_cast<Eigen::Index>(patch.size()) * points);
      for (std::size_t c = 0; c < patch.size(); ++c) {
        const CellPoints<N> x = points_of(patch[c]);
        for (Eigen::Index p = 0; p < points; ++p)
          places.col(static_cast<Eigen::Index>(c) * points + p) = x * sampling_.values[p] - centre;
      }
      const double scale = places.colwise().norm().maxCoeff();
      Eigen::Matrix<double, terms, Eigen::Dynamic> polynomials(terms, places.cols());
      Samples values(places.cols(), 6 * at_a_time);
      for (std::size_t c = 0; c < patch.size(); ++c) {
        const auto first = static_cast<Eigen::Index>(c) * points;
        for (Eigen::Index p = first; p < first + points; ++p)
          polynomials.col(p) = Fit<N>::polynomials(places.col(p) / scale);
        values.middleRows(first, points) = samples.middleRows(patch[c] * points, points);
      }
      typename Fit<N>::Normal normal = Fit<N>::Normal::Zero();
      Eigen::Matrix<double, terms, 6 * at_a_time> right = Eigen::Matrix<double, terms, 6 * at_a_time>::Zero();
      const DenseBlock of_terms{polynomials.data(), terms, places.cols(), terms, false};
      add_dense_product(of_terms, {polynomials.data(), places.cols(), terms, terms, true}, normal.data(), terms);
      add_dense_product(of_terms, {values.data(), places.cols(), 6 * at_a_time, 6 * at_a_time, true}, right.data(),
                        terms);
      // Regular meshes and small bodies leave terms undetermined: the high ones are zero then, not the low ones.
      const double size = normal.trace();
      normal.diagonal().tail(terms - 1).array() += 1e-12 * size;
      if constexpr (N == 10) normal.diagonal().tail(terms - 4).array() += 1e-9 * size;
      result.coefficients.middleRows<terms>(v * terms) = solve_symmetric(normal, right);
      result.scale[v] = scale;
    }
    return result;
  }

  /// The polynomials of the vertices of a cell, weighted by its linear functions, at the points of `rule_`: a row each.
  Samples smooth_stress(Eigen::Index cell, const CellPoints<N>& x, const FittedStress& fitted,
                        const Surroundings& around) const {
    const auto points = static_cast<Eigen::Index>(rule_.size());
    Eigen::Matrix<double, 4 * terms, Eigen::Dynamic> weighted(4 * terms, points);
    Eigen::Matrix<double, 4 * terms, 6 * at_a_time, Eigen::RowMajor> coefficients;
    for (int v = 0; v < 4; ++v) {
      const Eigen::Index vertex = around.number[solid_.nodes(v, cell)];
      coefficients.template middleRows<terms>(v * terms) =
          fitted.coefficients.template middleRows<terms>(vertex * terms);
      for (Eigen::Index p = 0; p < points; ++p) {
        const Eigen::Vector3d local = rule_.points.col(p), place = x * rule_.values[static_cast<std::size_t>(p)];
        const double share = v == 0 ? 1 - local.sum() : local(v - 1);
        weighted.template block<terms, 1>(v * terms, p) =
            share * Fit<N>::polynomials((place - x.col(v)) / fitted.scale[static_cast<std::size_t>(vertex)]);
      }
    }
    Samples result = Samples::Zero(points, 6 * at_a_time);  // by rows: its transpose by columns
    add_dense_product({coefficients.data(), 6 * at_a_time, 4 * terms, 6 * at_a_time, false},
                      {weighted.data(), 4 * terms, points, 4 * terms, false}, result.data(), 6 * at_a_time);
    return result;
  }

  void compare(const Fields& fields, const FittedStress& fitted, int material, Fields& error, Fields& energy) const {
    const Eigen::Matrix<double, 6, 6> elasticity = solid_.materials[material].elasticity;
    const Eigen::Matrix<double, 6, 6> compliance = solve_symmetric(elasticity, Eigen::MatrixXd::Identity(6, 6));
#pragma omp parallel for num_threads(threads_) schedule(static)
    for (Eigen::Index e = 0; e < solid_.cells(); ++e) {
      if (solid_.material_of[e] != material) continue;
      const CellPoints<N> x = points_of(e);
      Eigen::Matrix<double, N, 3> gradients;
      const Samples smooth = smooth_stress(e, x, fitted, around_[material]);
      for (std::size_t p = 0; p < rule_.size(); ++p) {
        const double volume = map_point<N>(rule_, p, x, gradients);
        const SixRows strain = strain_at<N>(fields, solid_.nodes, e, gradients), stress = elasticity * strain;
        const SixRows difference = Eigen::Map<const SixRows>(smooth.row(static_cast<Eigen::Index>(p)).data()) - stress;
        const SixRows other = compliance * difference;
        error.row(e) += volume * difference.cwiseProduct(other).colwise().sum();
        energy.row(e) += volume * strain.cwiseProduct(stress).colwise().sum();
      }
    }
  }

  const Solid& solid_;
  int threads_;
  CellRule<N> sampling_, rule_;
  std::vector<Surroundings> around_;  // of each material
};

template <int N>
MeshError mesh_error(const Solid& solid, const RowMatrix& fields, int threads) {
  const BlasThreads one(1);
  const Estimate<N> estimate(solid, threads);
  MeshError result{Eigen::VectorXd::Zero(fields.cols())};
  Eigen::VectorXd density = Eigen::VectorXd::Zero(solid.cells());
  for (Eigen::Index first = 0; first < fields.cols(); first += at_a_time) {
    const Eigen::Index width = std::min<Eigen::Index>(at_a_time, fields.cols() - first);
    Fields some = Fields::Zero(fields.rows(), at_a_time);
    some.leftCols(width) = fields.middleCols(first, width);
    Fields error = Fields::Zero(solid.cells(), at_a_time), energy = error;
    estimate.add(some, error, energy);
    for (Eigen::Index f = 0; f < width; ++f) {
      const double of_error = error.col(f).sum(), all = energy.col(f).sum() + of_error;
      if (!(all > 0)) continue;
      result.relative(first + f) = std::sqrt(of_error / all);
      density += error.col(f) / all;
    }
  }
  Eigen::Index worst = 0;
  for (Eigen::Index e = 0; e < solid.cells(); ++e) {
    const CellPoints<N> x = cell_points<N>(solid.mesh.points, solid.nodes, e);
    const Eigen::Vector3d a = x.col(1) - x.col(0), b = x.col(2) - x.col(0), c = x.col(3) - x.col(0);
    density(e) /= std::abs(Eigen::Matrix3d((Eigen::Matrix3d() << a, b, c).finished()).determinant());
    if (density(e) > density(worst)) worst = e;
  }
  result.worst_place = cell_points<N>(solid.mesh.points, solid.nodes, worst).template leftCols<4>().rowwise().mean();
  return result;
}

}  // namespace

MeshError estimate_mesh_error(const Solid& solid, const RowMatrix& fields, int threads) {
  if (fields.cols() == 0) return {Eigen::VectorXd(0)};
  return solid.type == CellType::tet4 ? mesh_error<4>(solid, fields, threads) : mesh_error<10>(solid, fields, threads);
}

}  // namespace bielle::reduce

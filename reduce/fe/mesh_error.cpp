#include "reduce/fe/mesh_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include <Eigen/LU>

#include "reduce/dense/blas.hpp"
#include "reduce/dense/dense_solves.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "reduce/fe/cell_fields.hpp"
#include "reduce/fe/cell_geometry.hpp"
#include "reduce/fe/internal_modes.hpp"
#include "reduce/fe/vertex_patches.hpp"

namespace bielle::reduce {

namespace {

constexpr Eigen::Index at_a_time = 9;  // number of fields; their stresses at all sampling points are in memory

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using RowArray = Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

using Numbers = std::unique_ptr<double[]>;
Numbers numbers(Eigen::Index count) {
  return std::make_unique_for_overwrite<double[]>(static_cast<std::size_t>(count));
}

/// The square root W of C = W W.
Matrix6 root_of(const Matrix6& elasticity) {
  const SymmetricEigenpairs pairs = symmetric_eigenpairs(elasticity);
  const Matrix6 vectors = pairs.vectors;
  return vectors * pairs.values.cwiseMax(0).cwiseSqrt().asDiagonal() * vectors.transpose();
}

/// Data that depend on the type of cell: points at which stress is most accurate, and the polynomial that is fitted to
/// them.
template <int N>
struct Fit {
  static constexpr bool is_quadratic = SolidCell<N>::is_second_order;
  static constexpr int terms = is_quadratic ? 10 : 4;
  static constexpr int sampling_degree = N == 4 ? 0 : 2;
  static constexpr int error_degree = N == 10 ? 3 : is_quadratic ? 4 : 2;
  using Terms = Eigen::Matrix<double, terms, 1>;
  using Normal = Eigen::Matrix<double, terms, terms>;

  static Terms polynomials(const Eigen::Vector3d& x) {
    Terms result;
    result.template head<4>() << 1, x;
    if constexpr (is_quadratic) result.template tail<6>() << x.cwiseAbs2(), x.y() * x.z(), x.x() * x.z(), x.x() * x.y();
    return result;
  }
};

/// The polynomials of all vertices of one material, in coordinates from the vertex in units of `scale`: for each vertex
/// (6 fields, terms), one column after the other.
struct FittedStress {
  double* coefficients;
  std::vector<double> scale;  // [m]
};

/// The estimate for some fields. Stresses are those for unit compliance, W^-1 s = W eps: their square is twice the
/// energy. The fits are not affected, since each component has its own.
template <int N>
class Estimate {
 public:
  /// @param width  fields at a time, at most
  Estimate(const Solid& solid, const RowMatrix& fields, Eigen::Index width, int threads)
      : solid_(solid),
        fields_(fields),
        threads_(threads),
        sampling_(cell_quadrature(SolidCell<N>::type, Fit<N>::sampling_degree)),
        rule_(cell_quadrature(SolidCell<N>::type, Fit<N>::error_degree)),
        around_(all_surroundings(solid)),
        samples_(numbers(solid.cells() * size_of_samples(width))),
        coefficients_(numbers(most_vertices() * terms * 6 * width)) {
    for (const Material& material : solid.materials) roots_.push_back(root_of(material.elasticity));
    set_interpolation();
    shares_.resize(SolidCell<N>::vertices, rule_.weights.size());
    for (Eigen::Index p = 0; p < shares_.cols(); ++p)
      shares_.col(p) = shape_values(SolidCell<N>::linear_type, rule_.points.col(p));
  }

  /// Energies, doubled, of the error and of the fields from `first` on: (cells, fields).
  void calc(Eigen::Index first, RowArray& error, RowArray& energy) {
    first_ = first;
    width_ = error.cols();
    sample(energy);
    for (std::size_t m = 0; m < around_.size(); ++m) compare(fit(around_[m]), static_cast<int>(m), error, energy);
  }

 private:
  static constexpr int terms = Fit<N>::terms;
  static constexpr int most_points = Fit<N>::is_quadratic && N != 10 ? 27 : 8;  // number of points of `rule_`

  static std::vector<Surroundings> all_surroundings(const Solid& solid) {
    std::vector<Surroundings> result;
    for (int m = 0; m < static_cast<int>(solid.materials.size()); ++m) result.push_back(surroundings(solid, m));
    return result;
  }
  Eigen::Index most_vertices() const {
    std::size_t most = 0;
    for (const Surroundings& around : around_) most = std::max(most, around.vertices.size());
    return static_cast<Eigen::Index>(most);
  }
  Eigen::Index size_of_samples(Eigen::Index fields) const {
    return 6 * fields * static_cast<Eigen::Index>(sampling_.size());
  }
  CellPoints<N> points_of(Eigen::Index cell) const { return cell_points<N>(solid_.mesh.points, solid_.nodes, cell); }
  double* samples_of(Eigen::Index cell) { return samples_.get() + cell * size_of_samples(width_); }

  /// Whether the stress of a cell is the linear function that its sampling points give.
  static bool has_linear_stress(const CellPoints<N>& x) { return SolidCell<N>::is_simplex && is_straight<N>(x); }

  /// Sets the interpolation of a linear function of the cell from the sampling points to the points of `rule_`.
  void set_interpolation() {
    if constexpr (!SolidCell<N>::is_simplex) return;
    const auto columns = static_cast<Eigen::Index>(sampling_.size());
    interpolation_ = Eigen::MatrixXd::Ones(columns, rule_.weights.size());
    if (columns == 1) return;
    const auto barycentric = [](const Eigen::MatrixXd& points) {
      Eigen::MatrixXd result(4, points.cols());
      result << 1 - points.colwise().sum().array(), points;
      return result;
    };
    interpolation_ = Eigen::Matrix4d(barycentric(sampling_.points)).inverse() * barycentric(rule_.points);
  }

  /// Computes the stress at the sampling points, and its energy in each cell; these points integrate the square of a
  /// linear stress exactly. The energy of curved cells is integrated with `rule_`.
  void sample(RowArray& energy) {
    const auto points = static_cast<Eigen::Index>(sampling_.size());
#pragma omp parallel num_threads(threads_)
    {
      CellFields<N> cell(points, width_);
      InternalModes<N> modes;
      Eigen::VectorXd volumes(points);
#pragma omp for schedule(static)
      for (Eigen::Index e = 0; e < solid_.cells(); ++e) {
        const CellPoints<N> x = points_of(e);
        const auto material = static_cast<std::size_t>(solid_.material_of[e]);
        set_strains(
            cell, modes, sampling_, x, solid_.materials[material].elasticity, [&](double) { return roots_[material]; },
            [&](Eigen::Index p, const auto&, double volume) { volumes(p) = volume; });
        cell.take(fields_, solid_.nodes, e, first_);
        cell.evaluate(points, samples_of(e));
        if (has_linear_stress(x)) add_squares(samples_of(e), volumes, &energy(e, 0));
      }
    }
  }

  /// Adds to each field the integral of the square of its stress, (fields, 6 points).
  void add_squares(const double* stress, const Eigen::VectorXd& volumes, double* sums) const {
    Eigen::Map<Eigen::ArrayXd> sum(sums, width_);
    for (Eigen::Index p = 0; p < volumes.size(); ++p)
      for (int s = 0; s < 6; ++s)
        sum += volumes(p) * Eigen::Map<const Eigen::ArrayXd>(stress + (6 * p + s) * width_, width_).square();
  }

  /// Sets the positions of a patch's sampling points relative to a vertex, in units of the largest distance.
  double set_places(const std::vector<int>& patch, const Eigen::Vector3d& centre, Eigen::Matrix3Xd& places) const {
    const auto points = static_cast<Eigen::Index>(sampling_.size());
    places.resize(3, static_cast<Eigen::Index>(patch.size()) * points);
    for (std::size_t c = 0; c < patch.size(); ++c) {
      const CellPoints<N> x = points_of(patch[c]);
      for (Eigen::Index p = 0; p < points; ++p)
        places.col(static_cast<Eigen::Index>(c) * points + p) =
            x * sampling_.values[static_cast<std::size_t>(p)] - centre;
    }
    const double scale = places.colwise().norm().maxCoeff();
    places /= scale;
    return scale;
  }

  FittedStress fit(const Surroundings& around) {
    const auto points = static_cast<Eigen::Index>(sampling_.size());
    const auto count = static_cast<Eigen::Index>(around.vertices.size());
    const Eigen::Index size = 6 * width_;  // length of a sample
    FittedStress result{coefficients_.get(), std::vector<double>(count)};
    const std::size_t least = 2 * terms / sampling_.size() + 1;  // cells: two samples for each term
#pragma omp parallel num_threads(threads_)
    {
      Eigen::Matrix3Xd places;
      Eigen::Matrix<double, terms, Eigen::Dynamic> polynomials;
      Eigen::MatrixXd values, right(terms, size);
#pragma omp for schedule(dynamic, 64)
      for (Eigen::Index v = 0; v < count; ++v) {
        const std::vector<int> patch = patch_of(solid_, around, static_cast<std::size_t>(v), least);
        result.scale[v] = set_places(patch, solid_.mesh.points.col(around.vertices[v]), places);
        polynomials.resize(terms, places.cols());
        for (Eigen::Index p = 0; p < places.cols(); ++p) polynomials.col(p) = Fit<N>::polynomials(places.col(p));
        values.resize(size, places.cols());
        for (std::size_t c = 0; c < patch.size(); ++c)
          std::copy_n(samples_of(patch[c]), size * points, values.col(static_cast<Eigen::Index>(c) * points).data());
        typename Fit<N>::Normal normal = Fit<N>::Normal::Zero();
        right.setZero();
        const DenseBlock of_terms{polynomials.data(), terms, places.cols(), terms, false};
        add_dense_product(of_terms, {polynomials.data(), places.cols(), terms, terms, true}, normal.data(), terms);
        add_dense_product(of_terms, {values.data(), places.cols(), size, size, true}, right.data(), terms);
        // Regular meshes and small bodies leave terms undetermined; the terms of high degree are then set to zero, not
        // those of low degree.
        const double trace = normal.trace();
        normal.diagonal().tail(terms - 1).array() += 1e-12 * trace;
        if constexpr (Fit<N>::is_quadratic) normal.diagonal().tail(terms - 4).array() += 1e-9 * trace;
        Eigen::Map<Eigen::MatrixXd>(result.coefficients + v * terms * size, size, terms) =
            solve_symmetric(normal, right).transpose();
      }
    }
    return result;
  }

  /// Adds the polynomials of the vertices of a cell, weighted by its linear functions, at the points of `rule_`.
  /// @param stress  (6 fields, points)
  void add_smooth_stress(Eigen::Index cell, const CellPoints<N>& x, const FittedStress& fitted,
                         const Surroundings& around, double* stress) const {
    const auto points = static_cast<Eigen::Index>(rule_.size());
    const Eigen::Index size = 6 * width_;
    Eigen::Matrix<double, terms, most_points> weighted;
    for (int v = 0; v < SolidCell<N>::vertices; ++v) {
      const Eigen::Index vertex = around.number[solid_.nodes(v, cell)];
      const double scale = fitted.scale[static_cast<std::size_t>(vertex)];
      for (Eigen::Index p = 0; p < points; ++p) {
        const Eigen::Vector3d place = x * rule_.values[static_cast<std::size_t>(p)];
        weighted.col(p) = shares_(v, p) * Fit<N>::polynomials((place - x.col(v)) / scale);
      }
      add_dense_product({fitted.coefficients + vertex * terms * size, size, terms, size, false},
                        {weighted.data(), terms, points, terms, false}, stress, size);
    }
  }

  void compare(const FittedStress& fitted, int material, RowArray& error, RowArray& energy) {
    const auto points = static_cast<Eigen::Index>(rule_.size()), sampled = static_cast<Eigen::Index>(sampling_.size());
    const Eigen::Index size = 6 * width_;
    const Eigen::MatrixXd backward = -interpolation_;
#pragma omp parallel num_threads(threads_)
    {
      CellFields<N> curved(points, width_);
      InternalModes<N> modes;
      Eigen::MatrixXd stress(size, points), own(size, points);
      Eigen::VectorXd volumes(points);
#pragma omp for schedule(static)
      for (Eigen::Index e = 0; e < solid_.cells(); ++e) {
        if (solid_.material_of[e] != material) continue;
        const CellPoints<N> x = points_of(e);
        stress.setZero();
        if (has_linear_stress(x)) {
          volumes = rule_.weights * Eigen::Matrix3d(x * rule_.local_gradients[0]).determinant();
          add_dense_product({samples_of(e), size, sampled, size, false},
                            {backward.data(), sampled, points, sampled, false}, stress.data(), size);
        } else {
          const auto number = static_cast<std::size_t>(material);
          set_strains(
              curved, modes, rule_, x, solid_.materials[number].elasticity, [&](double) { return roots_[number]; },
              [&](Eigen::Index p, const auto&, double volume) { volumes(p) = volume; });
          curved.take(fields_, solid_.nodes, e, first_);
          curved.evaluate(points, own.data());
          add_squares(own.data(), volumes, &energy(e, 0));
          stress = -own;
        }
        add_smooth_stress(e, x, fitted, around_[static_cast<std::size_t>(material)], stress.data());
        add_squares(stress.data(), volumes, &error(e, 0));
      }
    }
  }

  const Solid& solid_;
  const RowMatrix& fields_;
  int threads_;
  CellRule<N> sampling_, rule_;
  std::vector<Surroundings> around_;  // patches of each material
  std::vector<Matrix6> roots_;        // W of each material
  Eigen::MatrixXd interpolation_;     // (sampling points, points of `rule_`)
  Eigen::MatrixXd shares_;            // functions of order 1 of the vertices at the points of `rule_`
  Numbers samples_;                   // stresses of each cell (fields, 6 points), one column after the other
  Numbers coefficients_;              // coefficients of `FittedStress`
  Eigen::Index first_ = 0, width_ = 0;
};

template <int N>
MeshError mesh_error(const Solid& solid, const RowMatrix& fields, int threads) {
  const BlasThreads one(1);
  const Eigen::Index shares = (fields.cols() + at_a_time - 1) / at_a_time, most = (fields.cols() + shares - 1) / shares;
  Estimate<N> estimate(solid, fields, most, threads);
  MeshError result{Eigen::VectorXd::Zero(fields.cols())};
  Eigen::ArrayXd density = Eigen::ArrayXd::Zero(solid.cells());
  for (Eigen::Index first = 0; first < fields.cols(); first += most) {
    const Eigen::Index width = std::min<Eigen::Index>(most, fields.cols() - first);
    RowArray error = RowArray::Zero(solid.cells(), width), energy = error;
    estimate.calc(first, error, energy);
    const Eigen::ArrayXd of_error = error.colwise().sum(), all = energy.colwise().sum().transpose() + of_error;
    const Eigen::ArrayXd unit = (all > 0).select(all.max(std::numeric_limits<double>::min()).inverse(), 0);
    result.relative.segment(first, width) = (of_error * unit).sqrt();
    density += (error.matrix() * unit.matrix()).array();
  }
  Eigen::Index worst = 0;
  const CellRule<N> rule(cell_quadrature(SolidCell<N>::type, N == 4 ? 0 : 2));
  for (Eigen::Index e = 0; e < solid.cells(); ++e) {
    const CellPoints<N> x = cell_points<N>(solid.mesh.points, solid.nodes, e);
    double volume = 0;
    for (std::size_t p = 0; p < rule.size(); ++p)
      volume += rule.weights(static_cast<Eigen::Index>(p)) * Eigen::Matrix3d(x * rule.local_gradients[p]).determinant();
    density(e) /= std::abs(volume);
    if (density(e) > density(worst)) worst = e;
  }
  result.worst_place = cell_points<N>(solid.mesh.points, solid.nodes, worst)
                           .template leftCols<SolidCell<N>::vertices>()
                           .rowwise()
                           .mean();
  return result;
}

}  // namespace

MeshError estimate_mesh_error(const Solid& solid, const RowMatrix& fields, int threads) {
  if (fields.cols() == 0) return {Eigen::VectorXd(0)};
  return with_nodes_of(solid.type, [&]<int N>() { return mesh_error<N>(solid, fields, threads); });
}

}  // namespace bielle::reduce

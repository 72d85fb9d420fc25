#include "reduce/fe/mesh_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "reduce/dense/blas.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "reduce/fe/cell_fields.hpp"
#include "reduce/fe/elasticity.hpp"
#include "reduce/fe/internal_modes.hpp"
#include "reduce/fe/solid_block.hpp"
#include "reduce/fe/stress_fit.hpp"
#include "reduce/mesh/jacobian.hpp"

namespace bielle::reduce {

namespace {

constexpr Eigen::Index at_a_time = 9;  // number of fields; their stresses at all sampling points are in memory

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using RowArray = Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Returns the square root W of C = W W.
Matrix6 root_of(const Matrix6& elasticity) {
  const SymmetricEigenpairs pairs = symmetric_eigenpairs(elasticity);
  const Matrix6 vectors = pairs.vectors;
  return vectors * pairs.values.cwiseMax(0).cwiseSqrt().asDiagonal() * vectors.transpose();
}

/// The cells of one type: their samples, and the difference between their stress and the smoother one.
template <int N>
class BlockError {
 public:
  BlockError(const SolidBlock& block, const std::vector<Matrix6>& roots, int threads)
      : block_(block),
        roots_(roots),
        threads_(threads),
        sampling_(sampling_rule()),
        rule_(cell_quadrature(SolidCell<N>::type, N == 10                         ? 3
                                                  : SolidCell<N>::is_second_order ? 4
                                                                                  : 2)) {
    set_interpolation();
    shares_.resize(SolidCell<N>::vertices, rule_.weights.size());
    for (Eigen::Index p = 0; p < shares_.cols(); ++p)
      shares_.col(p) = shape_values(straight_type(SolidCell<N>::type), rule_.points.col(p));
  }

  static Quadrature sampling_rule() { return cell_quadrature(SolidCell<N>::type, N == 4 ? 0 : 2); }

  /// Computes the stresses of the fields from `first` on at the sampling points, and doubled energies (cells, fields)
  /// of cells with linear stress: the sampling points integrate its square exactly.
  void sample(const RowMatrix& fields, Eigen::Index first, StressSamples& samples, RowArray& energy) const {
    const auto points = static_cast<Eigen::Index>(sampling_.size());
#pragma omp parallel num_threads(threads_)
    {
      CellFields<N> cell(points, samples.fields);
      InternalModes<N> modes(block_.solid.integration);
      Eigen::VectorXd volumes(points);
#pragma omp for schedule(static)
      for (Eigen::Index e = 0; e < block_.cells(); ++e) {
        const CellPoints<N> x = block_.points<N>(e);
        const int number = block_.first + static_cast<int>(e);
        set_strains(
            cell, modes, sampling_, x, block_.elasticity(e), [&, W = root(e)](double) { return W; },
            [&](Eigen::Index p, const auto&, double volume) { volumes(p) = volume; });
        cell.take(fields, block_.nodes, e, first);
        cell.evaluate(points, samples.of(number));
        if (has_linear_stress(x)) add_squares(samples.of(number), volumes, energy, number);
      }
    }
  }

  /// Adds the doubled energies of the error, and of the fields in cells without linear stress, in the cells of one
  /// material.
  void compare(const RowMatrix& fields, Eigen::Index first, const StressSamples& samples, const FittedStress& fitted,
               const Surroundings& around, int material, RowArray& error, RowArray& energy) const {
    const auto points = static_cast<Eigen::Index>(rule_.size()), sampled = static_cast<Eigen::Index>(sampling_.size());
    const Eigen::Index size = 6 * samples.fields;
    const Eigen::MatrixXd backward = -interpolation_;
#pragma omp parallel num_threads(threads_)
    {
      CellFields<N> curved(points, samples.fields);
      InternalModes<N> modes(block_.solid.integration);
      Eigen::MatrixXd stress(size, points), own(size, points);
      Eigen::VectorXd volumes(points);
#pragma omp for schedule(static)
      for (Eigen::Index e = 0; e < block_.cells(); ++e) {
        if (block_.material_number(e) != material) continue;
        const CellPoints<N> x = block_.points<N>(e);
        const int number = block_.first + static_cast<int>(e);
        stress.setZero();
        if (has_linear_stress(x)) {
          volumes = rule_.weights * jacobian_at<N>(rule_, 0, x).determinant();
          add_dense_product({samples.of(number), size, sampled, size, false},
                            {backward.data(), sampled, points, sampled, false}, stress.data(), size);
        } else {
          set_strains(
              curved, modes, rule_, x, block_.elasticity(e), [&, W = root(e)](double) { return W; },
              [&](Eigen::Index p, const auto&, double volume) { volumes(p) = volume; });
          curved.take(fields, block_.nodes, e, first);
          curved.evaluate(points, own.data());
          add_squares(own.data(), volumes, energy, number);
          stress = -own;
        }
        add_smooth_stress(e, x, fitted, around, stress.data());
        add_squares(stress.data(), volumes, error, number);
      }
    }
  }

 private:
  static constexpr int most_points = SolidCell<N>::is_second_order && N != 10 ? 27 : 8;  // number of points of `rule_`

  /// Returns W of a cell; of a wound material W Q^T, the stress of which is smooth in the material's axes.
  Matrix6 root(Eigen::Index e) const {
    const Matrix6& root = roots_[static_cast<std::size_t>(block_.material_number(e))];
    const Material& material = block_.material(e);
    if (!material.is_wound()) return root;
    return root * stress_rotation(material.axes_at(block_.centroid(e))).transpose();
  }

  /// Returns whether the stress of a cell is the linear function that its sampling points give.
  static bool has_linear_stress(const CellPoints<N>& x) {
    return SolidCell<N>::is_simplex && is_straight(SolidCell<N>::type, x);
  }

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

  /// Adds to each field the integral of the square of its stress, (fields, 6 points).
  static void add_squares(const double* stress, const Eigen::VectorXd& volumes, RowArray& sums, int cell) {
    const Eigen::Index width = sums.cols();
    Eigen::Map<Eigen::ArrayXd> sum(&sums(cell, 0), width);
    for (Eigen::Index p = 0; p < volumes.size(); ++p)
      for (int s = 0; s < 6; ++s)
        sum += volumes(p) * Eigen::Map<const Eigen::ArrayXd>(stress + (6 * p + s) * width, width).square();
  }

  /// Adds the polynomials of the vertices of a cell, weighted by its linear functions, at the points of `rule_`.
  /// @param stress  (6 fields, points)
  void add_smooth_stress(Eigen::Index cell, const CellPoints<N>& x, const FittedStress& fitted,
                         const Surroundings& around, double* stress) const {
    const auto points = static_cast<Eigen::Index>(rule_.size());
    const Eigen::Index size = 6 * fitted.fields, terms = fitted.terms;
    Eigen::Matrix<double, most_terms * most_points, 1> weighted;
    for (int v = 0; v < SolidCell<N>::vertices; ++v) {
      const Eigen::Index vertex = around.number[block_.nodes(v, cell)];
      const double scale = fitted.scale[static_cast<std::size_t>(vertex)];
      for (Eigen::Index p = 0; p < points; ++p) {
        const Eigen::Vector3d place = x * rule_.values[static_cast<std::size_t>(p)];
        set_terms((place - x.col(v)) / scale, terms, &weighted(terms * p));
        weighted.segment(terms * p, terms) *= shares_(v, p);
      }
      add_dense_product({fitted.coefficients + vertex * terms * size, size, terms, size, false},
                        {weighted.data(), terms, points, terms, false}, stress, size);
    }
  }

  SolidBlock block_;
  const std::vector<Matrix6>& roots_;  // W of each material
  int threads_;
  CellRule<N> sampling_, rule_;
  Eigen::MatrixXd interpolation_;  // (sampling points, points of `rule_`)
  Eigen::MatrixXd shares_;         // functions of order 1 of the vertices at the points of `rule_`
};

/// Returns the places of all samples, and memory for the stresses of some fields.
StressSamples make_samples(const Solid& solid, Eigen::Index fields) {
  StressSamples samples;
  for_each_block(solid, [&]<int N>(const SolidBlock& block) {
    const Eigen::Index points = BlockError<N>::sampling_rule().weights.size();
    for (Eigen::Index e = 0; e < block.cells(); ++e) samples.first.push_back(samples.first.back() + points);
  });
  samples.places.resize(3, samples.first.back());
  for_each_block(solid, [&]<int N>(const SolidBlock& block) {
    const CellRule<N> rule(BlockError<N>::sampling_rule());
    for (Eigen::Index e = 0; e < block.cells(); ++e)
      for (std::size_t p = 0; p < rule.size(); ++p)
        samples.places.col(samples.first[block.first + e] + static_cast<Eigen::Index>(p)) =
            block.points<N>(e) * rule.values[p];
  });
  samples.stress = numbers(6 * fields * samples.first.back());
  return samples;
}

/// The estimate for some fields at a time.
class Estimate {
 public:
  /// @param width  fields at a time, at most
  Estimate(const Solid& solid, const RowMatrix& fields, Eigen::Index width, int threads)
      : solid_(solid), fields_(fields), threads_(threads), samples_(make_samples(solid, width)) {
    int order = 2;  // cells that fit together have one order
    std::size_t sampled = std::numeric_limits<std::size_t>::max();
    for_each_block(solid, [&]<int N>(const SolidBlock&) {
      order = std::min(order, SolidCell<N>::is_second_order ? 2 : 1);
      sampled = std::min(sampled, static_cast<std::size_t>(BlockError<N>::sampling_rule().weights.size()));
    });
    terms_ = terms_of_order(order);
    least_cells_ = 2 * static_cast<std::size_t>(terms_) / sampled + 1;  // for two samples per term
    std::size_t most_vertices = 0;
    for (int m = 0; m < static_cast<int>(solid.materials.size()); ++m) {
      around_.push_back(surroundings(solid, m));
      roots_.push_back(root_of(solid.materials[static_cast<std::size_t>(m)].elasticity));
      most_vertices = std::max(most_vertices, around_.back().vertices.size());
    }
    coefficients_ = numbers(static_cast<Eigen::Index>(most_vertices) * terms_ * 6 * width);
  }

  /// Energies, doubled, of the error and of the fields from `first` on: (cells, fields).
  void calc(Eigen::Index first, RowArray& error, RowArray& energy) {
    samples_.fields = error.cols();
    for_each_block(solid_, [&]<int N>(const SolidBlock& block) {
      BlockError<N>(block, roots_, threads_).sample(fields_, first, samples_, energy);
    });
    const PatchFit patches(solid_, samples_, terms_, least_cells_);
    for (std::size_t m = 0; m < around_.size(); ++m) {
      const FittedStress fitted = patches.fit(around_[m], threads_, coefficients_.get());
      for_each_block(solid_, [&]<int N>(const SolidBlock& block) {
        BlockError<N>(block, roots_, threads_)
            .compare(fields_, first, samples_, fitted, around_[m], static_cast<int>(m), error, energy);
      });
    }
  }

 private:
  const Solid& solid_;
  const RowMatrix& fields_;
  int threads_;
  StressSamples samples_;
  Eigen::Index terms_ = 0;
  std::size_t least_cells_ = 0;
  std::vector<Surroundings> around_;  // patches of each material
  std::vector<Matrix6> roots_;        // W of each material
  Numbers coefficients_;              // of `FittedStress`
};

}  // namespace

MeshError estimate_mesh_error(const Solid& solid, const RowMatrix& fields, int threads) {
  if (fields.cols() == 0) return {Eigen::VectorXd(0)};
  const BlasThreads one(1);
  const Eigen::Index shares = (fields.cols() + at_a_time - 1) / at_a_time, most = (fields.cols() + shares - 1) / shares;
  Estimate estimate(solid, fields, most, threads);
  MeshError result{Eigen::VectorXd::Zero(fields.cols())};
  Eigen::ArrayXd density = Eigen::ArrayXd::Zero(solid.cells.size());
  for (Eigen::Index first = 0; first < fields.cols(); first += most) {
    const Eigen::Index width = std::min<Eigen::Index>(most, fields.cols() - first);
    RowArray error = RowArray::Zero(solid.cells.size(), width), energy = error;
    estimate.calc(first, error, energy);
    const Eigen::ArrayXd of_error = error.colwise().sum(), all = energy.colwise().sum().transpose() + of_error;
    const Eigen::ArrayXd unit = (all > 0).select(all.max(std::numeric_limits<double>::min()).inverse(), 0);
    result.relative.segment(first, width) = (of_error * unit).sqrt();
    density += (error.matrix() * unit.matrix()).array();
  }
  int worst = 0;
  for (int e = 0; e < solid.cells.size(); ++e) {
    density(e) /= cell_volume(solid.cells.type(e), solid.cells.points(e));
    if (density(e) > density(worst)) worst = e;
  }
  result.worst_place = solid.cells.corner_points(worst).rowwise().mean();
  return result;
}

}  // namespace bielle::reduce

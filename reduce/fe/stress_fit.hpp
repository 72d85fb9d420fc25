// Stresses at the points of cells at which they are most accurate, and the polynomials around each vertex that fit them
// best (Zienkiewicz and Zhu, superconvergent patch recovery). Internal to reduce/fe.
#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "reduce/fe/elasticity.hpp"
#include "reduce/fe/solid.hpp"
#include "reduce/fe/vertex_patches.hpp"

namespace bielle::reduce {

using Numbers = std::unique_ptr<double[]>;
inline Numbers numbers(Eigen::Index count) {
  return std::make_unique_for_overwrite<double[]>(static_cast<std::size_t>(count));
}

/// Stresses of all cells at the points at which they are most accurate. They are those for unit compliance, W^-1 s = W
/// eps: their square is twice the energy. The fits are not affected, since each component has its own.
struct StressSamples {
  std::vector<Eigen::Index> first{0};  // first point of each cell, and the number of all points
  Eigen::Matrix3Xd places;             // [m]
  Numbers stress;                      // (fields, 6 points), one column after the other
  Eigen::Index fields = 0;

  Eigen::Index points(int cell) const { return first[cell + 1] - first[cell]; }
  double* of(int cell) { return stress.get() + 6 * fields * first[cell]; }
  const double* of(int cell) const { return stress.get() + 6 * fields * first[cell]; }
};

/// Number of terms of a polynomial of degree 1 or 2 in space.
constexpr int most_terms = 10;
constexpr int terms_of_order(int order) { return order == 1 ? 4 : most_terms; }

/// The terms of a polynomial at a place, those of lower degree first.
inline void set_terms(const Eigen::Vector3d& x, Eigen::Index terms, double* column) {
  Eigen::Map<Eigen::Vector4d>(column) << 1, x;
  if (terms == most_terms)
    Eigen::Map<Vector6>(column + 4) << x.cwiseAbs2(), x.y() * x.z(), x.x() * x.z(), x.x() * x.y();
}

/// The polynomials of all vertices of one material, in coordinates from the vertex in units of `scale`: for each vertex
/// (6 fields, terms), one column after the other.
struct FittedStress {
  Eigen::Index terms, fields;
  const double* coefficients;
  std::vector<double> scale;  // [m]
};

/// Fits polynomials to the samples around each vertex.
class PatchFit {
 public:
  PatchFit(const Solid& solid, const StressSamples& samples, Eigen::Index terms, std::size_t least_cells)
      : solid_(solid), samples_(samples), terms_(terms), least_cells_(least_cells) {}

  /// @param coefficients  memory for the coefficients of all vertices
  FittedStress fit(const Surroundings& around, int threads, double* coefficients) const;

 private:
  /// Sets the samples of a patch and their positions from a vertex, in units of the largest distance.
  /// @returns that distance
  double gather(const std::vector<int>& patch, const Eigen::Vector3d& centre, Eigen::Matrix3Xd& places,
                Eigen::MatrixXd& values) const;

  const Solid& solid_;
  const StressSamples& samples_;
  Eigen::Index terms_;
  std::size_t least_cells_;
};

}  // namespace bielle::reduce

#include "reduce/spectral/refined_factor.hpp"

#include <algorithm>
#include <span>

#include "reduce/common/error.hpp"

namespace bielle {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr Index most_columns = 16;  // at a time: each has vectors of its own
constexpr double accuracy = 1e-11;  // of the energy norm
/// A factor that needs more is of no use: it takes 4 to 7.
constexpr int most_steps = 100;

VectorXd inverse_roots(const std::vector<double>& diagonal) {
  return Eigen::Map<const VectorXd>(diagonal.data(), static_cast<Index>(diagonal.size())).cwiseSqrt().cwiseInverse();
}

std::span<const double> numbers(const VectorXd& x) { return {x.data(), static_cast<std::size_t>(x.size())}; }

}  // namespace

RefinedFactor::RefinedFactor(const FactorStructure& structure, const Multifrontal& elimination, const BorderedPart& a,
                             int threads)
    : kept_(a.kept.begin(), a.kept.end()),
      a_{a.whole, kept_, a.border, a.corner},
      threads_(threads),
      scale_(inverse_roots(a.diagonal())),
      factor_(structure, elimination, a_, numbers(scale_), numbers(VectorXd::Ones(scale_.size())), threads) {}

MatrixXd RefinedFactor::precondition(const MatrixXd& b) const {
  MatrixXd scaled(b.rows(), b.cols());
  VectorXd sizes(b.cols());
#pragma omp parallel for num_threads(threads_)
  for (Index c = 0; c < b.cols(); ++c) {
    scaled.col(c) = scale_.cwiseProduct(b.col(c));
    sizes(c) = scaled.col(c).lpNorm<Eigen::Infinity>();
    if (sizes(c) > 0) scaled.col(c) /= sizes(c);  // far from the ends of the range of single precision
  }
  MatrixXd x = factor_.solve(scaled);
#pragma omp parallel for num_threads(threads_)
  for (Index c = 0; c < b.cols(); ++c) x.col(c) = sizes(c) * scale_.cwiseProduct(x.col(c));
  return x;
}

MatrixXd RefinedFactor::solve(const MatrixXd& b) const {
  MatrixXd x(b.rows(), b.cols());
  for (Index first = 0; first < b.cols(); first += most_columns) {
    const Index width = std::min(most_columns, b.cols() - first);
    x.middleCols(first, width) = solve_few(b.middleCols(first, width));
  }
  return x;
}

/// Conjugate gradients for each column by itself.
MatrixXd RefinedFactor::solve_few(const MatrixXd& b) const {
  MatrixXd x = MatrixXd::Zero(b.rows(), b.cols()), residual = b, correction = precondition(b), direction = correction;
  // r^T P r is about the energy of the error.
  VectorXd energies = b.cwiseProduct(correction).colwise().sum().transpose();
  const VectorXd at_rest = accuracy * accuracy * energies;
  for (int step = 0; (energies.array() > at_rest.array()).any(); ++step) {
    if (step == most_steps)
      throw ComputationError(
          "the stiffness matrix is too badly conditioned for a factor in single precision, and memory does not suffice "
          "for one in double precision; take a coarser mesh, end other programs, or raise the limit (ulimit -v)");
    const MatrixXd forces = a_.multiply(direction, threads_);
#pragma omp parallel for num_threads(threads_)
    for (Index c = 0; c < b.cols(); ++c) {
      if (!(energies(c) > at_rest(c))) continue;
      const double length = energies(c) / direction.col(c).dot(forces.col(c));
      x.col(c) += length * direction.col(c);
      residual.col(c) -= length * forces.col(c);
    }
    correction = precondition(residual);
#pragma omp parallel for num_threads(threads_)
    for (Index c = 0; c < b.cols(); ++c) {
      if (!(energies(c) > at_rest(c))) continue;
      const double before = energies(c);
      energies(c) = residual.col(c).dot(correction.col(c));
      direction.col(c) = correction.col(c) + energies(c) / before * direction.col(c);
    }
  }
  return x + correction;
}

}  // namespace bielle

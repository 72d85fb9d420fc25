// Eigenpairs of K phi = lambda M phi nearest to a shift: by ARPACK with single vectors (arpack_eigenpairs.hpp), by
// Bielle's own block Lanczos method if solutions are expensive (block_lanczos.hpp), or by dense algebra if the problem
// is small.
//
// The caller provides the solution with K - shift M and the product with M, so that one factorisation serves several
// purposes, and the solution may include constraints.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include <Eigen/Core>

namespace bielle {

/// The pencil K - lambda M, represented by its shift-inverted operator. M is symmetric, positive semi-definite, and
/// positive definite on the range of `solve`.
struct ShiftInvertProblem {
  Eigen::Index size = 0;
  double shift = 0;
  /// (K - shift M)^-1 b for a block of columns
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd& b)> solve;
  /// M x for a block of columns
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd& x)> multiply_mass;
};

enum class EigenMethod { automatic, arpack, block_lanczos };

/// Returns the method for `automatic`: ARPACK for problems of up to 100,000 unknowns and up to 60 pairs and one more.
EigenMethod sensible_method(Eigen::Index size, int count);

struct Eigenpairs;
struct EigenpairOptions;

/// Finds at least the `count` eigenpairs nearest to the shift; the caller sorts and normalises them and computes the
/// residuals.
using EigenIteration =
    std::function<Eigenpairs(const ShiftInvertProblem& problem, int count, const EigenpairOptions& options)>;

struct EigenpairOptions {
  EigenMethod method = EigenMethod::automatic;
  EigenIteration iteration;  ///< replaces the method if it is given, and sets the name of the method in the result
  /// Residuals of the eigenpairs of the inverted operator, relative to their eigenvalues.
  double tolerance = 1e-8;
  int restarts = 300;  ///< before giving up
  int block = 0;       ///< columns of a block; 0: as many as have proved best
  int basis = 0;       ///< columns that the block method holds before it restarts; 0: as many as have proved best
  int threads = 1;     ///< threads for the block method's own products
  /// Called after every solution with the number of columns solved so far; it may show progress.
  std::function<void(int solves)> on_solve;
};

/// Eigenpairs in ascending order of eigenvalue.
struct Eigenpairs {
  Eigen::VectorXd values;   ///< lambda
  Eigen::MatrixXd vectors;  ///< columns phi, phi^T M phi = 1, the first of the largest components positive
  /// |phi - (lambda - shift) (K - shift M)^-1 M phi|_M for each pair, before the last step of inverse iteration: some
  /// eigenvalue of the pencil lies within this, relative to lambda - shift.
  Eigen::VectorXd residuals;
  std::string method;  ///< in words: "ARPACK", "block Lanczos", "dense algebra"
  /// For a search up to a limit: the least eigenvalue beyond it, if one was found.
  std::optional<double> next;
  int solves = 0;    ///< columns that the iteration solved for
  int sweeps = 0;    ///< calls of `solve` that it took: each reads the factor once
  int restarts = 0;  ///< restarts of the iteration
};

/// The `count` eigenpairs nearest to the shift.
/// @param count  1 <= count; small problems (count > size / 2 or so) are solved densely
/// @throws ComputationError if the iteration does not converge: the number of converged pairs and of requested ones
Eigenpairs shift_invert_eigenpairs(const ShiftInvertProblem& problem, int count, const EigenpairOptions& options = {});

/// All eigenpairs with eigenvalues in (shift, limit], found by requesting growing counts.
/// @param search       as shift_invert_eigenpairs: the `count` pairs of that problem nearest to the shift
/// @param first_guess  the first count
/// @param most         more than this are not sought
/// @throws InputError if there are more than `most`, or seem to be from the spacing of those found: their approximate
/// number
Eigenpairs eigenpairs_below(const std::function<Eigenpairs(int count)>& search, const ShiftInvertProblem& problem,
                            double limit, int first_guess = 10, int most = 1000000);

}  // namespace bielle

// Eigenpairs of K phi = lambda M phi nearest to a shift: by ARPACK with single vectors (arpack_eigenpairs.hpp), by a
// block Lanczos method of our own where solutions are expensive (block_lanczos.hpp), or densely where the problem is
// small.
//
// The caller gives the solution with K - shift M and the product with M, so that one factorisation serves here and
// elsewhere, and constraints may be worked into the solution.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include <Eigen/Core>

namespace bielle {

/// The pencil K - lambda M, seen through its shift-inverted operator. M is symmetric, positive semi-definite, and
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

/// `automatic` stands for this: ARPACK for problems of up to 100,000 unknowns and 60 pairs and one more.
EigenMethod sensible_method(Eigen::Index size, int count);

struct Eigenpairs;
struct EigenpairOptions;

/// Finds at least the `count` eigenpairs nearest to the shift; order, norm and residuals are left to who asked.
using EigenIteration =
    std::function<Eigenpairs(const ShiftInvertProblem& problem, int count, const EigenpairOptions& options)>;

struct EigenpairOptions {
  EigenMethod method = EigenMethod::automatic;
  EigenIteration iteration;  ///< in place of the method, where it is given; it names itself
  /// Residuals of the eigenpairs of the inverted operator, relative to their eigenvalues.
  double tolerance = 1e-8;
  int restarts = 300;  ///< before giving up
  int block = 0;       ///< columns of a block; 0: as many as have proved best
  int basis = 0;       ///< columns that the block method holds before it restarts; 0: as many as have proved best
  int threads = 1;     ///< of the block method's own products
  /// Called after every solution with the number of columns solved for so far; may show progress.
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
  /// Of a search up to a limit: the least eigenvalue beyond it, where one was found.
  std::optional<double> next;
  int solves = 0;    ///< columns that the iteration solved for
  int sweeps = 0;    ///< calls of `solve` that it took: each reads the factor once
  int restarts = 0;  ///< of the iteration
};

/// The `count` eigenpairs nearest to the shift.
/// @param count  1 <= count; small problems (count > size / 2 or so) are solved densely
/// @throws ComputationError when the iteration does not converge: how many pairs did, of how many
Eigenpairs shift_invert_eigenpairs(const ShiftInvertProblem& problem, int count, const EigenpairOptions& options = {});

/// All eigenpairs with eigenvalues in (shift, limit], found by asking for growing counts.
/// @param search       as shift_invert_eigenpairs: the `count` nearest to the shift, of that problem
/// @param first_guess  how many to ask for first
/// @param most         more than this are not sought
/// @throws InputError when there are more than `most`, or seem to be from the spacing of those found: about how many
Eigenpairs eigenpairs_below(const std::function<Eigenpairs(int count)>& search, const ShiftInvertProblem& problem,
                            double limit, int first_guess = 10, int most = 1000000);

}  // namespace bielle

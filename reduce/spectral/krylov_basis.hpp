// A block Krylov space of the operator S M, S = (K - shift M)^-1, orthonormal in M, for block Lanczos methods.
//
//     S M Q = Q H + F R,   H symmetric,   Q^T M Q = I,   Q^T M F = 0,   F^T M F = I.
//
// Q contains the vectors whose images are known, F (the front) those to be multiplied next. After a restart Q holds
// Ritz vectors, and H has an arrow that couples them with the front (thick restart: K. Wu, H. Simon, SIAM J. Matrix
// Anal. Appl. 22 (2000) 602). Each image is made orthogonal twice: by the recurrence, against the vectors with which it
// is coupled, and then against all vectors, so that M Q need not be stored. Blocks are made orthonormal by the
// eigenvectors of their Gram matrix (SVQB: A. Stathopoulos, K. Wu, SIAM J. Sci. Comput. 23 (2002) 2165), repeatedly
// until it is well conditioned; directions in which only rounding errors are left are dropped, and the front becomes
// narrower.
#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "reduce/spectral/eigenpairs.hpp"
#include "reduce/spectral/start_vectors.hpp"

namespace bielle {

/// Approximate eigenpairs nu, Q s of S M in the part of the space that is not locked, the largest |nu| first.
struct RitzPairs {
  Eigen::VectorXd values;     ///< nu
  Eigen::VectorXd residuals;  ///< |S M Q s - nu Q s|_M, from the recurrence
  Eigen::MatrixXd weights;    ///< columns s

  Eigen::Index size() const { return values.size(); }
};

class KrylovBasis {
 public:
  /// @param capacity  number of columns of Q and F together, >= 2
  /// @param on_solve  called with the number of columns of each solution
  KrylovBasis(const ShiftInvertProblem& problem, Eigen::Index capacity, int threads,
              std::function<void(Eigen::Index columns)> on_solve);

  Eigen::Index size() const { return size_; }      ///< number of columns of Q
  Eigen::Index front() const { return front_; }    ///< columns of F; 0 before the start, and when Q is invariant
  Eigen::Index locked() const { return locked_; }  ///< the first columns of Q: converged eigenvectors
  Eigen::Index room() const { return vectors_.cols() - size_ - front_; }

  /// Makes a front of random vectors that is not coupled with Q: the first front, or a new one if Q is invariant. It is
  /// narrower, or empty, if the space has no more directions.
  void start(Eigen::Index width);
  /// Appends F to Q; the new front is the part of its image outside Q. There must be capacity for it.
  void expand();
  RitzPairs ritz() const;
  /// Reduces Q to the locked vectors and the first Ritz vectors, which stay coupled with the front.
  void restart(const RitzPairs& ritz, Eigen::Index kept);
  /// Replaces Q by Q W, all of it locked, and drops the front. @param values  nu of each column of Q W
  void lock(const Eigen::MatrixXd& W, const Eigen::VectorXd& values);

  Eigen::VectorXd locked_values() const { return projected_.diagonal().head(locked_); }
  Eigen::MatrixXd take_locked_vectors();  ///< the basis is of no use afterwards

 private:
  /// Vectors Y during orthonormalisation; the original block is Y `coupling`.
  struct Block {
    Eigen::MatrixXd vectors, mass_vectors;  // Y, M Y
    Eigen::MatrixXd coupling;
    void transform(const Eigen::MatrixXd& by, int threads);
  };

  Eigen::MatrixXd solve(const Eigen::MatrixXd& b);
  /// Makes Y orthogonal to Q and computes M Y anew; returns the previous Q^T M Y.
  Eigen::MatrixXd remove_basis(Eigen::MatrixXd& Y, Eigen::MatrixXd& mass_y) const;
  /// Makes the front an orthonormal basis of a block from which Q has been removed once.
  /// @param removed     the removed components along Q
  /// @param negligible  directions with less coupling than this are dropped
  void set_front(Block block, Eigen::MatrixXd removed, double negligible);
  void put_front(const Eigen::MatrixXd& vectors);

  const ShiftInvertProblem& problem_;
  int threads_;
  std::function<void(Eigen::Index)> on_solve_;
  StartVectors random_;
  Eigen::MatrixXd vectors_;            // Q, then F
  Eigen::MatrixXd mass_front_;         // M F
  Eigen::MatrixXd coupling_of_front_;  // coupling of the front with the block by whose product with S M it was made
  Eigen::MatrixXd projected_;          // H, lower triangle, and R in the rows of F
  Eigen::Index size_ = 0, front_ = 0, locked_ = 0;
  Eigen::Index coupled_ = 0;  // the front is coupled with the vectors of Q from this one on
  Eigen::Index last_ = 0;     // the last block of Q starts here: R is zero before it
  double largest_ = 0;        // a lower bound of the largest |nu|
};

}  // namespace bielle

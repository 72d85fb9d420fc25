// A block Krylov space of the operator S M, S = (K - shift M)^-1, orthonormal in M: what block Lanczos methods grow.
//
//     S M Q = Q H + F R,   H symmetric,   Q^T M Q = I,   Q^T M F = 0,   F^T M F = I.
//
// Q are the vectors whose images are known, F the front: those to be multiplied next. After a restart Q holds Ritz
// vectors, and H has an arrow that couples them with the front (thick restart: K. Wu, H. Simon, SIAM J. Matrix Anal.
// Appl. 22 (2000) 602). Each image is made orthogonal twice: once by the recurrence, against the vectors with which it
// is coupled, and once more against all, so that M Q need not be kept. Blocks are made orthonormal by the eigenvectors
// of their Gram matrix (SVQB: A. Stathopoulos, K. Wu, SIAM J. Sci. Comput. 23 (2002) 2165), again and again until that
// is well conditioned; directions in which nothing but rounding is left are dropped, and the front becomes narrower.
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
  /// @param capacity  of Q and F together, >= 2
  /// @param on_solve  is told of the columns of each solution
  KrylovBasis(const ShiftInvertProblem& problem, Eigen::Index capacity, int threads,
              std::function<void(Eigen::Index columns)> on_solve);

  Eigen::Index size() const { return size_; }      ///< of Q
  Eigen::Index front() const { return front_; }    ///< columns of F; 0 before the start, and when Q is invariant
  Eigen::Index locked() const { return locked_; }  ///< the first columns of Q: converged eigenvectors
  Eigen::Index room() const { return vectors_.cols() - size_ - front_; }

  /// A front of random vectors, coupled with nothing: the first one, or a new one where Q is invariant. Narrower, or
  /// empty, when the space has no more directions.
  void start(Eigen::Index width);
  /// F becomes part of Q, and what its image adds to Q the new front. There must be room for it.
  void expand();
  RitzPairs ritz() const;
  /// Q shrinks to the locked vectors and the first Ritz vectors, coupled with the front as before.
  void restart(const RitzPairs& ritz, Eigen::Index kept);
  /// Q becomes Q W, all of it locked, and the front is dropped. @param values  nu of each column of Q W
  void lock(const Eigen::MatrixXd& W, const Eigen::VectorXd& values);

  Eigen::VectorXd locked_values() const { return projected_.diagonal().head(locked_); }
  Eigen::MatrixXd take_locked_vectors();  ///< the basis is of no use afterwards

 private:
  /// Vectors Y on their way to become orthonormal: what there was to begin with is Y `coupling`.
  struct Block {
    Eigen::MatrixXd vectors, mass_vectors;  // Y, M Y
    Eigen::MatrixXd coupling;
    void transform(const Eigen::MatrixXd& by, int threads);
  };

  Eigen::MatrixXd solve(const Eigen::MatrixXd& b);
  /// Y is made orthogonal to Q, M Y computed anew; returns Q^T M Y as it was.
  Eigen::MatrixXd remove_basis(Eigen::MatrixXd& Y, Eigen::MatrixXd& mass_y) const;
  /// The front becomes an orthonormal basis of a block from which Q has been removed once.
  /// @param removed     what of Q was removed
  /// @param negligible  directions with less coupling than this are dropped
  void set_front(Block block, Eigen::MatrixXd removed, double negligible);
  void put_front(const Eigen::MatrixXd& vectors);

  const ShiftInvertProblem& problem_;
  int threads_;
  std::function<void(Eigen::Index)> on_solve_;
  StartVectors random_;
  Eigen::MatrixXd vectors_;            // Q, then F
  Eigen::MatrixXd mass_front_;         // M F
  Eigen::MatrixXd coupling_of_front_;  // with the block whose image it comes from
  Eigen::MatrixXd projected_;          // H, lower triangle, and R in the rows of F
  Eigen::Index size_ = 0, front_ = 0, locked_ = 0;
  Eigen::Index coupled_ = 0;  // the front is coupled with the vectors of Q from this one on
  Eigen::Index last_ = 0;     // the last block of Q starts here: R is zero before it
  double largest_ = 0;        // a lower bound of the largest |nu|
};

}  // namespace bielle

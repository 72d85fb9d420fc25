#include "reduce/spectral/operator_eigenpairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <type_traits>
#include <utility>
#include <vector>

#include <arpack/arpack.hpp>
#include <fmt/format.h>

#include "reduce/common/counted.hpp"
#include "reduce/common/error.hpp"
#include "reduce/dense/blas.hpp"
#include "reduce/dense/orthonormal_columns.hpp"

// OpenBLAS contains LAPACK but has no C header for it.
extern "C" {
void zgeev_(const char* left, const char* right, const int* n, std::complex<double>* a, const int* lda,
            std::complex<double>* values, std::complex<double>* vl, const int* ldvl, std::complex<double>* vr,
            const int* ldvr, std::complex<double>* work, const int* lwork, double* rwork, int* info);
void dgeevx_(const char* balance, const char* left, const char* right, const char* conditions, const int* n, double* a,
             const int* lda, double* real, double* imag, double* vl, const int* ldvl, double* vr, const int* ldvr,
             int* low, int* high, double* scale, double* norm, double* of_values, double* of_vectors, double* work,
             const int* lwork, int* iwork, int* info);
}

namespace bielle {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;
template <class Scalar>
using MatrixOf = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
template <class Scalar>
using VectorOf = Eigen::Vector<Scalar, Eigen::Dynamic>;

struct ComplexPairs {
  VectorXcd values;
  MatrixXcd vectors;
};

void check_lapack(int info) {
  if (info != 0)
    throw ComputationError(fmt::format("the eigenvalues did not converge (LAPACK's geev returned {})", info));
}

/// Columns k and k + 1 of `pairs` are real and imaginary part if the eigenvalue is complex.
MatrixXcd join_pairs(const VectorXd& imag, const MatrixXd& pairs, Index count) {
  MatrixXcd vectors(pairs.rows(), count);
  for (Index k = 0; k < count; ++k) {
    if (imag[k] == 0) {
      vectors.col(k) = pairs.col(k).cast<Complex>();
    } else {
      vectors.col(k).real() = pairs.col(k);
      vectors.col(k).imag() = pairs.col(k + 1);
      if (k + 1 < count) vectors.col(k + 1) = vectors.col(k).conjugate();
      ++k;
    }
  }
  return vectors;
}

/// @param balance  LAPACK's letter: "B" permutes and scales, "N" leaves the matrix as it is
ComplexPairs dense_pairs(MatrixXd A, const char* balance) {
  const int n = static_cast<int>(A.rows()), one = 1;
  VectorXd real(n), imag(n), scale(n);
  MatrixXd vectors(n, n);
  int room = -1, info = 0, low = 0, high = 0;
  double wanted = 0, norm = 0;
  const auto run = [&](double* work) {
    dgeevx_(balance, "N", "V", "N", &n, A.data(), &n, real.data(), imag.data(), nullptr, &one, vectors.data(), &n, &low,
            &high, scale.data(), &norm, nullptr, nullptr, work, &room, nullptr, &info);
  };
  run(&wanted);
  room = static_cast<int>(wanted);
  VectorXd work(room);
  run(work.data());
  check_lapack(info);
  ComplexPairs pairs{VectorXcd(n), join_pairs(imag, vectors, n)};
  pairs.values.real() = real;
  pairs.values.imag() = imag;
  return pairs;
}

/// Computes all pairs. Scaling can magnify rounding errors of a nilpotent part to the size of the others: the pairs are
/// then no longer those of a matrix near by (R. James, J. Langou, B. R. Lowery, arXiv:1401.5766), and are computed
/// without it.
ComplexPairs dense_pairs(const MatrixXd& A) {
  ComplexPairs pairs = dense_pairs(A, "B");
  constexpr double backward = 1e-12;
  double most = 0;
  for (Index k = 0; k < A.cols(); ++k)
    most = std::max(most, (A * pairs.vectors.col(k) - pairs.values[k] * pairs.vectors.col(k)).norm());
  return most > backward * A.norm() ? dense_pairs(A, "N") : pairs;
}

ComplexPairs dense_pairs(MatrixXcd A) {
  const int n = static_cast<int>(A.rows()), one = 1;
  ComplexPairs pairs{VectorXcd(n), MatrixXcd(n, n)};
  int room = -1, info = 0;
  Complex wanted = 0;
  VectorXd real_work(2 * n);
  zgeev_("N", "V", &n, A.data(), &n, pairs.values.data(), nullptr, &one, pairs.vectors.data(), &n, &wanted, &room,
         real_work.data(), &info);
  room = static_cast<int>(wanted.real());
  VectorXcd work(room);
  zgeev_("N", "V", &n, A.data(), &n, pairs.values.data(), nullptr, &one, pairs.vectors.data(), &n, work.data(), &room,
         real_work.data(), &info);
  check_lapack(info);
  return pairs;
}

/// Returns a start vector that is the same in every run and on every machine: a linear congruential generator (Knuth's
/// MMIX constants).
template <class Scalar>
VectorOf<Scalar> start_vector(Index size, int seed) {
  std::uint64_t state = 0x9E3779B97F4A7C15ULL * static_cast<std::uint64_t>(seed);
  const auto next = [&] {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(static_cast<std::int64_t>(state)) * 0x1p-63;
  };
  VectorOf<Scalar> result(size);
  for (Scalar& value : result) {
    if constexpr (std::is_same_v<Scalar, double>) {
      value = next();
    } else {
      const double real = next();
      value = {real, next()};
    }
  }
  return result;
}

/// ARPACK's iteration with its working memory.
template <class Scalar>
class ArnoldiIteration {
  static constexpr bool real = std::is_same_v<Scalar, double>;

 public:
  ArnoldiIteration(Index size, Index wanted, Index basis, double tolerance, int restarts, int seed)
      : size_(static_cast<a_int>(size)),
        wanted_(static_cast<a_int>(wanted)),
        basis_(static_cast<a_int>(basis)),
        tolerance_(tolerance),
        residual_(start_vector<Scalar>(size, seed)),
        arnoldi_(size, basis),
        work_(size, 3),
        small_work_(static_cast<std::size_t>(real ? 3 * basis * (basis + 2) : basis * (3 * basis + 5))),
        real_work_(static_cast<std::size_t>(basis)) {
    parameters_[0] = 1;         // exact shifts
    parameters_[2] = restarts;  // on return: how many were made
    parameters_[3] = 1;         // block size, the only one implemented
    parameters_[6] = 1;         // the operator as it is
  }

  /// @param enough  number of the wanted eigenvalues that must converge
  template <class Apply>
  void run(const Apply& apply, Index enough) {
    a_int request = 0;
    while (request != 99) {
      iterate(request);
      if (request == 1 || request == -1)
        column(1) = apply(VectorOf<Scalar>(column(0)));
      else if (request != 99)
        throw ComputationError(fmt::format("ARPACK made an unknown request ({})", request));
    }
    const int converged = parameters_[4];
    if (info_ >= 0 && converged < enough)
      throw ComputationError(fmt::format("the eigenvalue iteration stopped after {}, with {} of {} converged",
                                         counted(static_cast<int>(parameters_[2]), "restart"), converged,
                                         counted(static_cast<int>(wanted_), "eigenvalue")));
    if (info_ < 0)
      throw ComputationError(fmt::format("the eigenvalue iteration failed (ARPACK's naupd returned {})", info_));
  }

  /// Returns an orthonormal basis of the invariant subspace that was found, made of Schur vectors, which unlike
  /// eigenvectors are never nearly parallel.
  MatrixOf<Scalar> vectors() {
    std::vector<a_int> select(static_cast<std::size_t>(basis_));
    MatrixOf<Scalar> vectors(size_, wanted_ + 1);
    std::vector<Scalar> values(static_cast<std::size_t>(basis_) + 1), more(static_cast<std::size_t>(3 * basis_));
    std::vector<double> imag(static_cast<std::size_t>(basis_) + 1);
    if constexpr (real)
      arpack::neupd(1, arpack::howmny::ritz_vectors, select.data(), values.data(), imag.data(), vectors.data(), size_,
                    0, 0, more.data(), arpack::bmat::identity, size_, arpack::which::largest_magnitude, wanted_,
                    tolerance_, residual_.data(), basis_, arnoldi_.data(), size_, parameters_.data(), pointers_.data(),
                    work_.data(), small_work_.data(), small_size(), info_);
    else
      arpack::neupd(1, arpack::howmny::ritz_vectors, select.data(), values.data(), vectors.data(), size_, 0,
                    more.data(), arpack::bmat::identity, size_, arpack::which::largest_magnitude, wanted_, tolerance_,
                    residual_.data(), basis_, arnoldi_.data(), size_, parameters_.data(), pointers_.data(),
                    work_.data(), small_work_.data(), small_size(), real_work_.data(), info_);
    if (info_ != 0)
      throw ComputationError(fmt::format("the eigenvectors could not be formed (ARPACK's neupd returned {})", info_));
    // A conjugate pair is not separated.
    return arnoldi_.leftCols(std::min<Index>(parameters_[4], wanted_ + 1));
  }

 private:
  void iterate(a_int& request) {
    if constexpr (real)
      arpack::naupd(request, arpack::bmat::identity, size_, arpack::which::largest_magnitude, wanted_, tolerance_,
                    residual_.data(), basis_, arnoldi_.data(), size_, parameters_.data(), pointers_.data(),
                    work_.data(), small_work_.data(), small_size(), info_);
    else
      arpack::naupd(request, arpack::bmat::identity, size_, arpack::which::largest_magnitude, wanted_, tolerance_,
                    residual_.data(), basis_, arnoldi_.data(), size_, parameters_.data(), pointers_.data(),
                    work_.data(), small_work_.data(), small_size(), real_work_.data(), info_);
  }
  Eigen::Map<VectorOf<Scalar>> column(int pointer) {
    return Eigen::Map<VectorOf<Scalar>>(work_.data() + pointers_[static_cast<std::size_t>(pointer)] - 1, size_);
  }
  a_int small_size() const { return static_cast<a_int>(small_work_.size()); }
  a_int size_, wanted_, basis_;
  a_int info_ = 1;  ///< start from `residual_`
  double tolerance_;
  VectorOf<Scalar> residual_;
  MatrixOf<Scalar> arnoldi_, work_;
  std::vector<Scalar> small_work_;
  std::vector<double> real_work_;
  std::array<a_int, 14> parameters_{}, pointers_{};
};

/// An invariant subspace of T; a small matrix on it gives the eigenpairs.
template <class Scalar>
struct Subspace {
  MatrixOf<Scalar> Q, TQ;
  void add(const LinearOperator<Scalar>& T, const MatrixOf<Scalar>& vectors) {
    MatrixOf<Scalar> all(T.size, Q.cols() + vectors.cols());
    all << Q, vectors;
    Q = orthonormal_columns(std::move(all));
    TQ.resize(T.size, Q.cols());
    for (Index k = 0; k < Q.cols(); ++k) TQ.col(k) = T.apply(Q.col(k));
  }
  ComplexPairs pairs() const {
    const MatrixOf<Scalar> H = Q.adjoint() * TQ;
    ComplexPairs small = dense_pairs(H);
    small.vectors = Q.template cast<Complex>() * small.vectors;
    return small;
  }
};

std::vector<Index> by_magnitude(const VectorXcd& values) {
  std::vector<Index> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), Index{0});
  // Both members of a conjugate pair have exactly the same magnitude.
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return std::abs(values[a]) > std::abs(values[b]); });
  return order;
}

/// Returns the usual dimension of the Krylov space of a search for a number of eigenvalues.
Index usual_basis(Index count) { return 2 * count + 20; }

/// @param basis  largest dimension of the Krylov space
template <class Scalar>
MatrixOf<Scalar> search(const LinearOperator<Scalar>& T, const MatrixOf<Scalar>& known, Index count, Index basis,
                        double tolerance, int restarts, int seed, Index enough) {
  ArnoldiIteration<Scalar> iteration(T.size, count, basis, tolerance, restarts, seed);
  const auto without_known = [&](VectorOf<Scalar> x) {
    if (known.cols() > 0)
      for (int twice = 0; twice < 2; ++twice) x -= known * (known.adjoint() * x).eval();
    return x;
  };
  iteration.run([&](const VectorOf<Scalar>& x) { return without_known(T.apply(without_known(x))); }, enough);
  return iteration.vectors();
}

/// Adds eigenvalues that were missed. Up to rounding, a Krylov space of one start vector contains one vector of each
/// eigenspace: copies of a multiple eigenvalue may be missed while others beyond it converge. A search that excludes
/// the found subspace, which is invariant, finds the remaining eigenvalues.
template <class Scalar>
void add_missed(const LinearOperator<Scalar>& T, Index count, const OperatorEigenOptions& options,
                Subspace<Scalar>& found) {
  constexpr int rounds = 20;
  constexpr Index batch = 4;
  // Eigenvalues beyond the found ones may be as close together as those, which this dimension has separated.
  const auto basis = [&] { return std::min(T.size - found.Q.cols(), usual_basis(count)); };
  for (int round = 0; round < rounds && T.size - found.Q.cols() > 50; ++round) {
    const ComplexPairs pairs = found.pairs();
    const std::vector<Index> order = by_magnitude(pairs.values);
    const double least =
        std::abs(pairs.values[order[static_cast<std::size_t>(std::min<Index>(count, pairs.values.size())) - 1]]);
    // Little accuracy is needed to see that nothing is missing.
    constexpr double rough = 1e-3;
    const MatrixOf<Scalar> next = search(T, found.Q, 1, basis(), rough, options.restarts, 2 * round + 2, 1);
    MatrixOf<Scalar> answers(T.size, next.cols());
    for (Index k = 0; k < next.cols(); ++k) answers.col(k) = T.apply(next.col(k));
    const double most = dense_pairs(MatrixOf<Scalar>(next.adjoint() * answers)).values.cwiseAbs().maxCoeff();
    if (most < least * (1 - 2 * rough)) return;
    // Errors of the found subspace may prevent full convergence of other eigenvalues; these are sought in another
    // round.
    const double tolerance = std::max(options.tolerance, 1e-10);
    found.add(T, search(T, found.Q, batch, basis(), tolerance, 30, 2 * round + 3, 1));
  }
}

template <class Scalar>
OperatorEigenpairs largest(const LinearOperator<Scalar>& T, Index count, const OperatorEigenOptions& options) {
  // ARPACK's products of vectors are short, and BLAS threads would spin next to Bielle's own.
  const BlasThreads one(1);
  OperatorEigenpairs result;
  if (T.size == 0) {
    result.all = true;
    return result;
  }
  constexpr Index large = 3000;
  ComplexPairs pairs;
  if (T.size <= options.dense || (usual_basis(count) >= T.size && T.size <= large)) {
    MatrixOf<Scalar> A(T.size, T.size);
    for (Index k = 0; k < T.size; ++k) A.col(k) = T.apply(VectorOf<Scalar>::Unit(T.size, k));
    pairs = dense_pairs(A);
    result.all = true;
  } else if (usual_basis(count) >= T.size) {
    throw ComputationError(fmt::format("{} are too many eigenvalues of an operator of size {}", count, T.size));
  } else {
    Subspace<Scalar> found;
    found.Q.resize(T.size, 0);
    found.add(T, search<Scalar>(T, found.Q, count, std::min(T.size, usual_basis(count)), options.tolerance,
                                options.restarts, 1, count));
    if (options.copies) add_missed(T, count, options, found);
    pairs = found.pairs();
  }
  const std::vector<Index> order = by_magnitude(pairs.values);
  result.values = pairs.values(order);
  result.vectors = pairs.vectors(Eigen::all, order);
  result.residuals.resize(result.values.size());
  for (Index k = 0; k < result.values.size(); ++k) {
    auto x = result.vectors.col(k);
    x.normalize();
    VectorXcd y;
    if constexpr (std::is_same_v<Scalar, double>) {
      y.resize(T.size);
      y.real() = T.apply(x.real());
      y.imag() = T.apply(x.imag());
    } else {
      y = T.apply(x);
    }
    const double size = std::abs(result.values[k]);
    result.residuals[k] = size > 0 ? (y - result.values[k] * x).norm() / size : INFINITY;
  }
  return result;
}

}  // namespace

OperatorEigenpairs largest_eigenpairs(const LinearOperator<double>& T, Index count,
                                      const OperatorEigenOptions& options) {
  return largest(T, count, options);
}

OperatorEigenpairs largest_eigenpairs(const LinearOperator<Complex>& T, Index count,
                                      const OperatorEigenOptions& options) {
  return largest(T, count, options);
}

}  // namespace bielle

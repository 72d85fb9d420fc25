#include <numeric>
#include <optional>

#include <Eigen/SparseCholesky>
#include <cholmod.h>

#include "reduce/common/error.hpp"
#include "reduce/spectral/blas.hpp"
#include "reduce/spectral/symmetric_factor.hpp"
#include "tests/performance/measured_factor.hpp"

namespace bielle {

namespace {

class BielleFactor : public MeasuredFactor {
 public:
  explicit BielleFactor(const FactorRequest& request) : request_(request) {
    kept_.resize(static_cast<std::size_t>(request.matrix.size));
    std::iota(kept_.begin(), kept_.end(), 0);
  }
  void analyse() override {
    structure_ = std::make_shared<const FactorStructure>(block_graph(request_.matrix, request_.blocks));
  }
  void factorise() override {
    factor_.reset();
    factor_.emplace(BorderedPart{request_.matrix, kept_, {}, {}}, structure_, request_.threads);
  }
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) override { return factor_->solve(b); }
  double flops() const override { return structure_->flops(); }
  double stored() const override { return static_cast<double>(structure_->values()); }

 private:
  FactorRequest request_;
  std::vector<std::int64_t> kept_;
  std::shared_ptr<const FactorStructure> structure_;
  std::optional<SymmetricFactor> factor_;
};

/// CHOLMOD's settings and workspace, and the matrix as it takes it.
struct Cholmod {
  cholmod_common common;
  cholmod_sparse matrix{};

  explicit Cholmod(const SymmetricMatrix& a) {
    cholmod_l_start(&common);
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_METIS;
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.final_ll = 1;
    matrix.nrow = matrix.ncol = static_cast<std::size_t>(a.size);
    matrix.nzmax = a.rows.size();
    matrix.p = const_cast<std::int64_t*>(a.starts.data());
    matrix.i = const_cast<std::int64_t*>(a.rows.data());
    matrix.x = const_cast<double*>(a.values.data());
    matrix.stype = -1;
    matrix.itype = CHOLMOD_LONG;
    matrix.xtype = CHOLMOD_REAL;
    matrix.dtype = CHOLMOD_DOUBLE;
    matrix.sorted = matrix.packed = 1;
  }
  ~Cholmod() { cholmod_l_finish(&common); }
  Cholmod(const Cholmod&) = delete;
  Cholmod& operator=(const Cholmod&) = delete;
  void check() const {
    if (common.status < 0) throw ComputationError("CHOLMOD failed");
  }
};

class CholmodFactor : public MeasuredFactor {
 public:
  explicit CholmodFactor(const FactorRequest& request) : cholmod_(request.matrix), blas_(request.threads) {}
  ~CholmodFactor() override { cholmod_l_free_factor(&factor_, &cholmod_.common); }
  void analyse() override {
    factor_ = cholmod_l_analyze(&cholmod_.matrix, &cholmod_.common);
    cholmod_.check();
    flops_ = cholmod_.common.fl;
  }
  void factorise() override {
    cholmod_l_factorize(&cholmod_.matrix, factor_, &cholmod_.common);
    cholmod_.check();
  }
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) override {
    cholmod_dense right{};
    right.nrow = right.d = static_cast<std::size_t>(b.rows());
    right.ncol = static_cast<std::size_t>(b.cols());
    right.nzmax = static_cast<std::size_t>(b.size());
    right.x = const_cast<double*>(b.data());
    right.xtype = CHOLMOD_REAL;
    right.dtype = CHOLMOD_DOUBLE;
    cholmod_l_solve2(CHOLMOD_A, factor_, &right, nullptr, &solution_, nullptr, &work_, &more_work_, &cholmod_.common);
    cholmod_.check();
    return Eigen::Map<const Eigen::MatrixXd>(static_cast<const double*>(solution_->x), b.rows(), b.cols());
  }
  double flops() const override { return flops_; }
  double stored() const override { return static_cast<double>(factor_->xsize); }

 private:
  Cholmod cholmod_;
  BlasThreads blas_;
  cholmod_factor* factor_ = nullptr;
  cholmod_dense *solution_ = nullptr, *work_ = nullptr, *more_work_ = nullptr;  // kept until the process ends
  double flops_ = 0;
};

class EigenFactor : public MeasuredFactor {
 public:
  explicit EigenFactor(const FactorRequest& request) : matrix_(request.matrix) {}
  void analyse() override {
    Cholmod cholmod(matrix_);
    std::vector<std::int64_t> order(static_cast<std::size_t>(matrix_.size));
    cholmod_l_metis(&cholmod.matrix, nullptr, 0, 1, order.data(), &cholmod.common);
    cholmod.check();
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> places(matrix_.size);  // new from old
    for (std::size_t k = 0; k < order.size(); ++k) places.indices()(order[k]) = static_cast<int>(k);
    places_ = places;
    const Eigen::Map<const Sparse64> lower(matrix_.size, matrix_.size, matrix_.starts.back(), matrix_.starts.data(),
                                           matrix_.rows.data(), matrix_.values.data());
    ordered_.resize(matrix_.size, matrix_.size);
    ordered_.selfadjointView<Eigen::Lower>() = Sparse(lower).selfadjointView<Eigen::Lower>().twistedBy(places_);
    factor_.analyzePattern(ordered_);
  }
  void factorise() override {
    factor_.factorize(ordered_);
    if (factor_.info() != Eigen::Success) throw ComputationError("Eigen failed");
  }
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) override {
    const Eigen::MatrixXd right = places_ * b;
    const Eigen::MatrixXd solution = factor_.solve(right);
    return places_.transpose() * solution;
  }
  double flops() const override {
    const Sparse& l = factor_.matrixL().nestedExpression();
    double sum = 0;
    for (Eigen::Index k = 0; k < l.cols(); ++k) {
      const double count = l.outerIndexPtr()[k + 1] - l.outerIndexPtr()[k];
      sum += count * count;
    }
    return sum;
  }
  double stored() const override { return static_cast<double>(factor_.matrixL().nestedExpression().nonZeros()); }

 private:
  using Sparse = Eigen::SparseMatrix<double>;
  using Sparse64 = Eigen::SparseMatrix<double, Eigen::ColMajor, std::int64_t>;
  const SymmetricMatrix& matrix_;
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> places_;
  Sparse ordered_;
  Eigen::SimplicialLLT<Sparse, Eigen::Lower, Eigen::NaturalOrdering<int>> factor_;
};

}  // namespace

std::unique_ptr<MeasuredFactor> measured_bielle(const FactorRequest& request) {
  return std::make_unique<BielleFactor>(request);
}
std::unique_ptr<MeasuredFactor> measured_cholmod(const FactorRequest& request) {
  return std::make_unique<CholmodFactor>(request);
}
std::unique_ptr<MeasuredFactor> measured_eigen(const FactorRequest& request) {
  return std::make_unique<EigenFactor>(request);
}

}  // namespace bielle

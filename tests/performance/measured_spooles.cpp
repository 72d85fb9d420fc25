#include "tests/performance/measured_factor.hpp"

#ifdef BIELLE_HAS_SPOOLES
#include <array>

#include "reduce/common/error.hpp"

extern "C" {
#include <spooles/MT/spoolesMT.h>
#include <spooles/SymbFac.h>
#include <spooles/misc.h>
}

namespace bielle {

namespace {

constexpr int silent = 0;

/// The calls of CalculiX, without pivoting, which a positive definite matrix does not need. What the library hands out
/// is given back when the process ends.
class SpoolesFactor : public MeasuredFactor {
 public:
  explicit SpoolesFactor(const FactorRequest& request) : matrix_(request.matrix), threads_(request.threads) {}

  void analyse() override {
    entries_ = upper_triangle();
    Graph* const graph = Graph_new();
    IVL* const neighbours = InpMtx_fullAdjacency(entries_);
    const int size = static_cast<int>(matrix_.size), edges = IVL_tsize(neighbours);
    Graph_init2(graph, 0, size, 0, edges, size, edges, neighbours, nullptr, nullptr);
    tree_ = orderViaBestOfNDandMS(graph, 800, 1000, 64, 7892713, silent, stdout);
    Graph_free(graph);
    new_from_old_ = ETree_oldToNewVtxPerm(tree_);
    old_from_new_ = ETree_newToOldVtxPerm(tree_);
    ETree_permuteVertices(tree_, new_from_old_);
    InpMtx_permute(entries_, IV_entries(new_from_old_), IV_entries(new_from_old_));
    InpMtx_mapToUpperTriangle(entries_);
    InpMtx_changeCoordType(entries_, INPMTX_BY_CHEVRONS);
    InpMtx_changeStorageMode(entries_, INPMTX_BY_VECTORS);
    structure_ = SymbFac_initFromInpMtx(tree_, entries_);
    DV* const work = DV_new();
    DV_init(work, threads_, nullptr);
    owners_ = ETree_ddMap(tree_, SPOOLES_REAL, SPOOLES_SYMMETRIC, work, 1. / (2. * threads_));
    DV_free(work);
    flops_ = ETree_nFactorOps(tree_, SPOOLES_REAL, SPOOLES_SYMMETRIC);
  }

  void factorise() override {
    if (factor_ != nullptr) FrontMtx_free(factor_);
    if (blocks_ != nullptr) SubMtxManager_free(blocks_);
    factor_ = FrontMtx_new();
    blocks_ = SubMtxManager_new();
    SubMtxManager_init(blocks_, LOCK_IN_PROCESS, 0);
    FrontMtx_init(factor_, tree_, structure_, SPOOLES_REAL, SPOOLES_SYMMETRIC, FRONTMTX_DENSE_FRONTS,
                  SPOOLES_NO_PIVOTING, LOCK_IN_PROCESS, 0, nullptr, blocks_, silent, stdout);
    ChvManager* const columns = ChvManager_new();
    ChvManager_init(columns, LOCK_IN_PROCESS, 1);
    int error = -1;
    std::array<int, 20> counts{};
    Chv* const postponed = FrontMtx_MT_factorInpMtx(factor_, entries_, 100, 0, columns, owners_, 0, &error,
                                                    seconds_.data(), counts.data(), silent, stdout);
    ChvManager_free(columns);
    if (postponed != nullptr || error >= 0) throw ComputationError("SPOOLES failed");
    FrontMtx_postProcess(factor_, silent, stdout);
    if (map_ != nullptr) SolveMap_free(map_);
    map_ = SolveMap_new();
    SolveMap_ddMap(map_, SPOOLES_SYMMETRIC, FrontMtx_upperBlockIVL(factor_), FrontMtx_lowerBlockIVL(factor_), threads_,
                   owners_, FrontMtx_frontTree(factor_), 7892713, silent, stdout);
  }

  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) override {
    const int rows = static_cast<int>(b.rows()), columns = static_cast<int>(b.cols());
    DenseMtx* const right = DenseMtx_new();
    DenseMtx* const solution = DenseMtx_new();
    DenseMtx_init(right, SPOOLES_REAL, 0, 0, rows, columns, 1, rows);
    DenseMtx_init(solution, SPOOLES_REAL, 0, 0, rows, columns, 1, rows);
    Eigen::Map<Eigen::MatrixXd>(DenseMtx_entries(right), b.rows(), b.cols()) = b;
    DenseMtx_zero(solution);
    DenseMtx_permuteRows(right, new_from_old_);
    FrontMtx_MT_solve(factor_, solution, right, blocks_, map_, seconds_.data(), silent, stdout);
    DenseMtx_permuteRows(solution, old_from_new_);
    Eigen::MatrixXd x = Eigen::Map<Eigen::MatrixXd>(DenseMtx_entries(solution), b.rows(), b.cols());
    DenseMtx_free(right);
    DenseMtx_free(solution);
    return x;
  }

  double flops() const override { return flops_; }
  double stored() const override { return static_cast<double>(factor_->nentD) + factor_->nentU; }

 private:
  InpMtx* upper_triangle() const {
    InpMtx* const entries = InpMtx_new();
    InpMtx_init(entries, INPMTX_BY_ROWS, SPOOLES_REAL, static_cast<int>(matrix_.rows.size()), 0);
    for (std::int64_t j = 0; j < matrix_.size; ++j)
      for (std::int64_t p = matrix_.starts[static_cast<std::size_t>(j)];
           p < matrix_.starts[static_cast<std::size_t>(j) + 1]; ++p)
        InpMtx_inputRealEntry(entries, static_cast<int>(j), static_cast<int>(matrix_.rows[static_cast<std::size_t>(p)]),
                              matrix_.values[static_cast<std::size_t>(p)]);
    InpMtx_changeStorageMode(entries, INPMTX_BY_VECTORS);
    return entries;
  }

  const SymmetricMatrix& matrix_;
  int threads_;
  InpMtx* entries_ = nullptr;
  ETree* tree_ = nullptr;
  IV *new_from_old_ = nullptr, *old_from_new_ = nullptr, *owners_ = nullptr;
  IVL* structure_ = nullptr;
  FrontMtx* factor_ = nullptr;
  SubMtxManager* blocks_ = nullptr;
  SolveMap* map_ = nullptr;
  std::array<double, 20> seconds_{};
  double flops_ = 0;
};

}  // namespace

std::unique_ptr<MeasuredFactor> measured_spooles(const FactorRequest& request) {
  return std::make_unique<SpoolesFactor>(request);
}

}  // namespace bielle
#else
namespace bielle {

std::unique_ptr<MeasuredFactor> measured_spooles(const FactorRequest&) { return nullptr; }

}  // namespace bielle
#endif

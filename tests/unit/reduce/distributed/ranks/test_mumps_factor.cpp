// This program runs as a single rank, without mpirun. contract/programs/test_distributed.py runs two and three ranks.
#include <cstdlib>

#include <catch2/catch.hpp>
#include <mpi.h>

#include "reduce/distributed/ranks/mumps_factor.hpp"
#include "reduce/distributed/regularity.hpp"
#include "tests/unit/reduce/sparse/factor_checks.hpp"

using namespace bielle;

namespace {

reduce::Team& team() {
  static reduce::Team one = [] {
    MPI_Init(nullptr, nullptr);
    std::atexit([] { MPI_Finalize(); });
    return reduce::Team(MPI_COMM_WORLD, nullptr);
  }();
  return one;
}

reduce::Entries entries_of(const SymmetricMatrix& a) {
  reduce::Entries entries;
  for (std::int64_t j = 0; j < a.size; ++j)
    for (std::int64_t p = a.starts[static_cast<std::size_t>(j)]; p < a.starts[static_cast<std::size_t>(j) + 1]; ++p) {
      entries.rows.push_back(static_cast<int>(a.rows[static_cast<std::size_t>(p)]) + 1);
      entries.columns.push_back(static_cast<int>(j) + 1);
      entries.values.push_back(a.values[static_cast<std::size_t>(p)]);
    }
  return entries;
}

/// MUMPS's factor as a `Factor`. bielle-reduce uses it through a channel, which this test omits.
class FactorOfRanks : public Factor {
 public:
  explicit FactorOfRanks(const SymmetricMatrix& a) {
    std::vector<int> starts(static_cast<std::size_t>(a.size) + 1);
    for (std::size_t k = 0; k < starts.size(); ++k) starts[k] = static_cast<int>(k);
    try {
      factor_ = std::make_unique<reduce::MumpsFactor>(team(), static_cast<int>(a.size), entries_of(a), starts);
    } catch (const reduce::RankFailure& failure) {
      throw ComputationError(failure.outcome.message);
    }
    const reduce::SharedFactorStatistics& told = factor_->statistics();
    statistics_.unknowns = a.size;
    statistics_.nonzeros = static_cast<std::int64_t>(told.nonzeros);
    statistics_.flops = told.flops;
    statistics_.estimated_MB = told.estimated_MB;
    statistics_.ordering_seconds = told.analysis_seconds;
    statistics_.factorisation_seconds = told.factorisation_seconds;
    if (reduce::unresisted_unknown(*this, a.diagonal().cwiseAbs().cwiseSqrt(), told.negative_pivots > 0))
      throw ComputationError("the matrix is singular, or not positive definite");
  }
  const FactorStatistics& statistics() const override { return statistics_; }
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const override {
    Eigen::MatrixXd x = b;
    if (b.cols() > 0) factor_->solve(x.data(), static_cast<int>(x.cols()));
    return x;
  }

 private:
  std::unique_ptr<reduce::MumpsFactor> factor_;
  FactorStatistics statistics_;
};

}  // namespace

TEST_CASE("MUMPS's factor does what `Factor` promises", "[factor]") {
  test::check_all({"MUMPS", [](const SymmetricMatrix& a, int) { return std::make_unique<FactorOfRanks>(a); }, false});
}

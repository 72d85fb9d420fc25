#include "reduce/distributed/ranks/modes.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include <fmt/format.h>
#include <slepceps.h>

#include "reduce/common/error.hpp"

namespace bielle::reduce {

namespace {

/// An eigenvalue of the complement below this share of the highest wanted one was missed; any other is the same one or
/// the next.
constexpr double same = 1e-9;

void check(PetscErrorCode code) {
  if (code == 0) return;
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  throw ComputationError(fmt::format("the search for modes failed in SLEPc: {}", text ? text : "unknown error"));
}

/// Starts SLEPc such that its errors are returned as numbers and it handles no signals.
void start_slepc() {
  static bool started = false;
  if (std::exchange(started, true)) return;
  check(SlepcInitializeNoArguments());
  check(PetscPopSignalHandler());
  check(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr));
}

class Search {
 public:
  Search(Team& team, const ModesRequest& request, const ServeUntilAnswered& serve)
      : team_(team), request_(request), serve_(serve) {
    check(VecCreateMPI(team.comm(), PETSC_DECIDE, request.size, &start_));
    check(VecScatterCreateToZero(start_, &gather_, &whole_));
    PetscInt local = 0;
    check(VecGetLocalSize(start_, &local));
    const auto make_shell = [&](Mat* matrix) {
      check(MatCreateShell(team.comm(), local, local, request.size, request.size, this, matrix));
      check(MatShellSetOperation(*matrix, MATOP_MULT, reinterpret_cast<void (*)()>(&Search::multiply)));
    };
    make_shell(&stiffness_);
    make_shell(&mass_);
  }
  ~Search() {
    for (Vec& vector : vectors_) VecDestroy(&vector);
    MatDestroy(&mass_);
    MatDestroy(&stiffness_);
    VecScatterDestroy(&gather_);
    VecDestroy(&whole_);
    VecDestroy(&start_);
  }
  Search(const Search&) = delete;
  Search& operator=(const Search&) = delete;

  void run() {
    add_lowest(request_.count);
    // Eigenpairs of the complement are sought one at a time, as long as it holds one that should have been found.
    while (static_cast<int>(values_.size()) < request_.size) {
      std::vector<double> sorted = values_;
      std::sort(sorted.begin(), sorted.end());
      const auto wanted = std::min<std::size_t>(sorted.size(), static_cast<std::size_t>(request_.count));
      const double highest = sorted[wanted - 1];
      const auto before = static_cast<std::ptrdiff_t>(values_.size());
      add_lowest(1);
      if (*std::min_element(values_.begin() + before, values_.end()) >= (1 - same) * highest) break;
    }
  }

  void send_found() {
    std::vector<std::size_t> order(values_.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values_[a] < values_[b]; });
    if (team_.leads()) {
      team_.channel().send_number(static_cast<std::int64_t>(order.size()));
      for (const std::size_t k : order) team_.channel().send_number(values_[k]);
    }
    for (const std::size_t k : order) {
      gather(vectors_[k]);
      if (team_.leads()) send_whole();
    }
  }

 private:
  static PetscErrorCode multiply(Mat matrix, Vec x, Vec y) {
    void* context = nullptr;
    PetscCall(MatShellGetContext(matrix, &context));
    auto& search = *static_cast<Search*>(context);
    if (matrix == search.mass_) {
      search.ask(Question::mass_times, x, y);
      return 0;
    }
    // SLEPc multiplies by K only to check whether the deflated vectors lie in its null space. K has no null space.
    PetscCall(VecCopy(x, y));
    return VecNormalize(y, nullptr);
  }
  static PetscErrorCode solve(PC preconditioner, Vec b, Vec x) {
    void* context = nullptr;
    PetscCall(PCShellGetContext(preconditioner, &context));
    static_cast<Search*>(context)->ask(Question::solution, b, x);
    return 0;
  }

  void gather(Vec x) {
    check(VecScatterBegin(gather_, x, whole_, INSERT_VALUES, SCATTER_FORWARD));
    check(VecScatterEnd(gather_, x, whole_, INSERT_VALUES, SCATTER_FORWARD));
  }
  void send_whole() {
    const PetscScalar* numbers = nullptr;
    check(VecGetArrayRead(whole_, &numbers));
    team_.channel().send(numbers, sizeof(double) * static_cast<std::size_t>(request_.size));
    check(VecRestoreArrayRead(whole_, &numbers));
  }

  void ask(Question question, Vec x, Vec y) {
    gather(x);
    if (team_.leads()) {
      team_.channel().send_number(question);
      send_whole();
    }
    serve_();
    if (team_.leads()) {
      PetscScalar* numbers = nullptr;
      check(VecGetArray(whole_, &numbers));
      team_.channel().receive(numbers, sizeof(double) * static_cast<std::size_t>(request_.size));
      check(VecRestoreArray(whole_, &numbers));
    }
    check(VecScatterBegin(gather_, whole_, y, INSERT_VALUES, SCATTER_REVERSE));
    check(VecScatterEnd(gather_, whole_, y, INSERT_VALUES, SCATTER_REVERSE));
  }

  /// Adds the lowest eigenpairs in the complement of those found so far.
  void add_lowest(int count) {
    EPS eps = nullptr;
    check(EPSCreate(team_.comm(), &eps));
    check(EPSSetOperators(eps, stiffness_, mass_));
    check(EPSSetProblemType(eps, EPS_GHEP));
    check(EPSSetType(eps, EPSKRYLOVSCHUR));
    check(EPSSetWhichEigenpairs(eps, EPS_TARGET_MAGNITUDE));
    check(EPSSetTarget(eps, 0));
    check(EPSSetDimensions(eps, count, PETSC_DEFAULT, PETSC_DEFAULT));
    check(EPSSetTolerances(eps, request_.tolerance, request_.restarts));
    check(EPSSetPurify(eps, PETSC_FALSE));  // the caller makes a step of inverse iteration with the vectors
    set_solution(eps);
    set_start(eps);
    if (!vectors_.empty()) check(EPSSetDeflationSpace(eps, static_cast<PetscInt>(vectors_.size()), vectors_.data()));
    check(EPSSolve(eps));
    take(eps, count);
    check(EPSDestroy(&eps));
  }

  /// Sets the solver to shift and invert, with solutions from bielle-reduce.
  void set_solution(EPS eps) {
    ST transformation = nullptr;
    KSP solver = nullptr;
    PC preconditioner = nullptr;
    check(EPSGetST(eps, &transformation));
    check(STSetType(transformation, STSINVERT));
    check(STSetMatMode(transformation, ST_MATMODE_SHELL));
    check(STGetKSP(transformation, &solver));
    check(KSPSetType(solver, KSPPREONLY));
    check(KSPGetPC(solver, &preconditioner));
    check(PCSetType(preconditioner, PCSHELL));
    check(PCShellSetContext(preconditioner, this));
    check(PCShellSetApply(preconditioner, &Search::solve));
  }

  /// Makes a start vector in the range of the solution, where constraints hold and M is positive.
  void set_start(EPS eps) {
    Vec random = nullptr;
    check(VecDuplicate(start_, &random));
    PetscInt first = 0, last = 0;
    check(VecGetOwnershipRange(random, &first, &last));
    PetscScalar* numbers = nullptr;
    check(VecGetArray(random, &numbers));
    for (PetscInt k = first; k < last; ++k) numbers[k - first] = pseudo_random(static_cast<std::uint64_t>(k));
    check(VecRestoreArray(random, &numbers));
    Vec inertia = nullptr;
    check(VecDuplicate(start_, &inertia));
    ask(Question::mass_times, random, inertia);
    ask(Question::solution, inertia, start_);
    check(EPSSetInitialSpace(eps, 1, &start_));
    check(VecDestroy(&inertia));
    check(VecDestroy(&random));
  }

  /// Returns a number in (-1, 1) that does not depend on the number of ranks and differs for each search (splitmix64).
  double pseudo_random(std::uint64_t k) const {
    std::uint64_t z = (k + 1 + 1000003 * vectors_.size()) * 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return 2 * static_cast<double>((z ^ (z >> 31)) >> 11) / 9007199254740992.0 - 1;
  }

  void take(EPS eps, int count) {
    PetscInt found = 0;
    check(EPSGetConverged(eps, &found));
    if (found < count)
      throw ComputationError(
          fmt::format("only {} of {} modes converged in {} restarts", found, count, request_.restarts));
    for (PetscInt k = 0; k < found; ++k) {
      Vec vector = nullptr;
      check(VecDuplicate(start_, &vector));
      vectors_.push_back(vector);
      PetscScalar value = 0, imaginary = 0;
      check(EPSGetEigenpair(eps, k, &value, &imaginary, vector, nullptr));
      values_.push_back(value);
    }
  }

  Team& team_;
  const ModesRequest& request_;
  const ServeUntilAnswered& serve_;
  Vec start_ = nullptr, whole_ = nullptr;
  VecScatter gather_ = nullptr;
  Mat stiffness_ = nullptr, mass_ = nullptr;
  std::vector<double> values_;
  std::vector<Vec> vectors_;
};

}  // namespace

void find_modes(Team& team, const ModesRequest& request, const ServeUntilAnswered& serve) {
  Outcome outcome;
  start_slepc();
  Search search(team, request, serve);
  try {
    team.all_or_none([&] { search.run(); });
  } catch (const RankFailure& failure) {
    outcome = failure.outcome;
  }
  if (team.leads()) {
    team.channel().send_number(Question::none);
    team.channel().send_outcome(outcome);
  }
  if (outcome.kind == Outcome::good) search.send_found();
}

}  // namespace bielle::reduce

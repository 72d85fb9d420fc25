#include "reduce/reduction/mode_request.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "reduce/common/counted.hpp"
#include "reduce/common/error.hpp"

namespace bielle::reduce {

namespace {

constexpr int most_modes_below = 1000;  // upper bound for a frequency limit; more is probably a wrong unit
constexpr int first_guess_below = 20;   // modes below a limit, before any is known

double eigenvalue_of(double frequency) { return std::pow(2 * std::numbers::pi * frequency, 2); }

}  // namespace

void check_mode_count(const ModeRequest& request, Eigen::Index inside) {
  if (request.count.value_or(0) > inside)
    throw InputError(
        fmt::format("modes.count: {} {} asked for, but the body has only {} inside; refine its mesh or ask for fewer",
                    counted(*request.count, "fixed-boundary mode"), *request.count == 1 ? "is" : "are",
                    counted(inside, "degree of freedom", "degrees of freedom")));
}

void keep_requested(const ModeRequest& request, Eigenpairs& pairs, Progress& progress) {
  Eigen::Index count = pairs.values.size();
  if (request.below) count = (pairs.values.array() <= eigenvalue_of(*request.below)).count();
  if (request.count && count > *request.count) {
    count = *request.count;
    if (request.below)
      progress.note(
          fmt::format("modes: the count of {} leaves out modes below {:.6g} Hz, the first of them at {:.6g} Hz",
                      *request.count, *request.below, std::sqrt(pairs.values(count)) / (2 * std::numbers::pi)));
  }
  if (count >= pairs.values.size()) return;
  pairs.next = pairs.values(count);
  pairs.values.conservativeResize(count);
  pairs.vectors.conservativeResize(Eigen::NoChange, count);
  if (pairs.residuals.size() > count) pairs.residuals.conservativeResize(count);
}

Eigenpairs requested_modes(const ModeRequest& request, const ShiftInvertProblem& problem,
                           const std::function<Eigenpairs(int count, const EigenpairOptions& options)>& search,
                           Progress& progress, int threads) {
  check_mode_count(request, problem.size);
  if (!request.any() || request.count == 0 || problem.size == 0) return {};
  EigenpairOptions options;
  const double expected = 2.0 * request.count.value_or(first_guess_below) + 150;
  options.threads = threads;
  options.method = request.method;
  options.on_solve = [&](int solves) {
    progress.update(std::min(0.99, solves / expected), counted(solves, "solution"));
  };
  const auto find = [&](int count) { return search(count, options); };
  if (!request.count) {
    try {
      return eigenpairs_below(find, problem, eigenvalue_of(*request.below), first_guess_below, most_modes_below);
    } catch (const InputError& error) {
      throw InputError(fmt::format("modes.below: {}; more than {} modes are computed only when `count` asks for them",
                                   error.what(), most_modes_below));
    }
  }
  Eigenpairs pairs = find(static_cast<int>(std::min<Eigen::Index>(*request.count + 1, problem.size)));
  keep_requested(request, pairs, progress);
  return pairs;
}

}  // namespace bielle::reduce

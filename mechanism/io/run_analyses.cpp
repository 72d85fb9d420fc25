#include "mechanism/io/run_analyses.hpp"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <optional>

#include <fmt/format.h>

#include "mechanism/io/energy_balance.hpp"
#include "mechanism/io/results_file.hpp"
#include "mechanism/solvers/redundancy.hpp"
#include "mechanism/solvers/statics.hpp"

namespace bielle::mechanism {
namespace {

volatile std::sig_atomic_t interrupted = 0;

/// While it lives, an interrupt (Ctrl-C) or a request to end lets the step in hand finish; then the run stops.
class InterruptGuard {
 public:
  InterruptGuard() : previous_int_(std::signal(SIGINT, note)), previous_term_(std::signal(SIGTERM, note)) {
    interrupted = 0;
  }
  ~InterruptGuard() {
    std::signal(SIGINT, previous_int_);
    std::signal(SIGTERM, previous_term_);
  }
  void check(double time) const {
    if (interrupted)
      throw ComputationError(
          fmt::format("interrupted at t = {:.6g} s; the results file holds all steps up to there", time));
  }

 private:
  static void note(int) { interrupted = 1; }
  using Handler = void (*)(int);
  Handler previous_int_, previous_term_;
};

class Run {
 public:
  Run(const MechanismFile& file, const std::string& results_path, Progress& progress)
      : file_(file),
        system_(file.model),
        environment_(file.model.environment),
        state_(system_.start(0)),
        results_(results_path, file.model, file.text),
        progress_(progress) {
    const std::vector<int> redundant = find_redundant(system_, environment_, state_);
    system_.set_aside(redundant);
    for (const int multiplier : redundant)
      redundant_.push_back(system_.equation_name(system_.size() - system_.multipliers() + multiplier));
  }

  std::vector<AnalysisSummary> all() {
    std::vector<AnalysisSummary> summaries;
    for (const Analysis& analysis : file_.analyses) {
      progress_.start(analysis.name);
      results_.begin_analysis(analysis.name, expected_rows(analysis));
      switch (analysis.type) {
        case Analysis::Type::assembly:
          summaries.push_back(assemble(analysis));
          break;
        case Analysis::Type::statics:
          summaries.push_back(solve_static(analysis));
          break;
        case Analysis::Type::dynamics:
          summaries.push_back(integrate(analysis));
          break;
      }
      results_.end_analysis();
      summaries.back().redundant = redundant_;
    }
    progress_.finish();
    results_.complete();
    return summaries;
  }

 private:
  /// @param time  reported in place of the state's
  void record(const Environment& environment, const EnergyBalance& books, double step, int iterations,
              std::optional<double> time = {}) {
    StepRecord row;
    row.time = time;
    row.energy = books.totals();
    row.balance = books.balance();
    row.step = step;
    row.newton_iterations = iterations;
    results_.record(state_, system_.slots(), environment, row);
  }

  void record(const MarchStep& step, const EnergyBalance& books) {
    StepRecord row;
    row.energy = books.totals();
    row.balance = books.balance();
    row.step = step.report.size;
    row.newton_iterations = step.report.iterations;
    row.error_estimate = step.error;
    results_.record(state_, system_.slots(), environment_, row);
  }

  static long grid_steps(const Analysis& dynamics) {
    return std::max(1L, std::lround(std::ceil(dynamics.duration / dynamics.stepping.size * (1 - 1e-12))));
  }

  /// 0: unknown.
  std::size_t expected_rows(const Analysis& analysis) const {
    if (analysis.type == Analysis::Type::assembly) return 1;
    if (analysis.type == Analysis::Type::statics) return static_cast<std::size_t>(analysis.steps) + 1;
    if (!file_.output.times.empty()) return file_.output.times.size() + 1;
    if (analysis.stepping.tolerance > 0) return 0;
    return static_cast<std::size_t>(grid_steps(analysis) / file_.output.every) + 2;  // and the first, and the last
  }

  AnalysisSummary assemble(const Analysis& analysis) {
    AnalysisSummary summary;
    summary.name = analysis.name;
    assemble_positions(system_, environment_, state_, summary.start);
    make_velocities_consistent(system_, environment_, state_, summary.start);
    system_.accept(state_, environment_);
    EnergyBalance books;
    books.start(state_.time, system_.energy(state_, environment_));
    record(environment_, books, 0, 0);
    summary.records = 1;
    summary.end_time = state_.time;
    return summary;
  }

  AnalysisSummary solve_static(const Analysis& analysis) {
    AnalysisSummary summary;
    summary.name = fmt::format("static, {} load step{}", analysis.steps, analysis.steps == 1 ? "" : "s");
    EnergyBalance books;
    books.start(0, system_.energy(state_, environment_));
    const auto note = [&](const State& state, double factor, int iterations) {
      guard_.check(state.time);
      Environment loaded = environment_;
      loaded.load_factor = factor;
      loaded.gravity *= factor;
      Energy energy = system_.energy(state, loaded);
      energy.input = energy.dissipation = 0;  // no rates in statics: there is no power to integrate
      books.start(factor, energy);
      record(loaded, books, 0, iterations, factor);
      ++summary.steps;
      ++summary.records;
      summary.iterations += iterations;
      progress_.update(factor, fmt::format("load factor {:.4g}", factor));
    };
    solve_statics(system_, environment_, analysis.steps, NewtonOptions{}, state_, note);
    summary.energy = books.totals();
    summary.end_time = state_.time;
    return summary;
  }

  /// The analysis's steps with the kinks of the model, a whole number of fixed ones.
  StepOptions stepping_of(const Analysis& analysis, double begin) {
    StepOptions options = analysis.stepping;
    for (const double time : system_.break_points())
      if (time >= begin && time < begin + analysis.duration) options.break_points.push_back(time);
    if (options.tolerance > 0) return options;
    const long steps = grid_steps(analysis);
    options.size = analysis.duration / static_cast<double>(steps);
    if (std::abs(options.size - analysis.stepping.size) > 1e-9 * options.size)
      progress_.note(fmt::format("step {:.6g} s in place of {:.6g} s, so that {} steps fill the duration", options.size,
                                 analysis.stepping.size, steps));
    if (static_cast<long>(options.break_points.size()) > steps) {
      progress_.note(fmt::format("{} kinks (points of tables) in {} steps: steps do not end on them",
                                 options.break_points.size(), steps));
      options.break_points.clear();
    }
    return options;
  }

  AnalysisSummary integrate(const Analysis& analysis) {
    AnalysisSummary summary;
    summary.name = fmt::format("dynamic, {}", analysis.scheme_name);
    const double begin = state_.time, end = begin + analysis.duration;
    const StepOptions stepping = stepping_of(analysis, begin);
    TimeIntegration integration(system_, environment_, analysis.scheme, std::move(state_));
    summary.start = integration.start_report();
    state_ = integration.state();
    EnergyBalance books;
    books.start(begin, system_.energy(state_, environment_));
    record(environment_, books, stepping.size, 0);
    summary.records = 1;
    const std::vector<double>& times = file_.output.times;
    auto next_time = std::upper_bound(times.begin(), times.end(), begin);
    long steps = 0;
    const auto after_step = [&](const MarchStep& step) {
      const State& now = integration.state();
      const EnergyBalance before = books;
      books.advance(now.time, system_.energy(now, environment_));
      if (step.on_grid) ++steps;
      if (!times.empty()) {
        for (; next_time != times.end() && *next_time <= now.time; ++next_time) {
          state_ = *next_time == now.time ? now : integration.interpolated(*next_time);
          EnergyBalance then = before;
          then.advance(*next_time, system_.energy(state_, environment_));
          record(step, then);
          ++summary.records;
        }
      } else if ((step.on_grid && steps % file_.output.every == 0) || now.time >= end) {
        state_ = now;
        record(step, books);
        ++summary.records;
      }
      progress_.update((now.time - begin) / analysis.duration, fmt::format("t = {:.4g} s", now.time));
      guard_.check(now.time);
    };
    summary.march = march(integration, end, stepping, after_step);
    state_ = integration.state();
    summary.steps = summary.march.steps;
    summary.iterations = summary.march.iterations;
    summary.end_time = state_.time;
    summary.energy = books.totals();
    summary.energy_start = books.energy_at_start();
    summary.balance = books.balance();
    summary.largest_energy = books.largest();
    return summary;
  }

  const MechanismFile& file_;
  System system_;
  Environment environment_;
  State state_;
  ResultsFile results_;
  Progress& progress_;
  InterruptGuard guard_;
  std::vector<std::string> redundant_;
};

}  // namespace

std::vector<AnalysisSummary> run_analyses(const MechanismFile& file, const std::string& results_path,
                                          Progress& progress) {
  return Run(file, results_path, progress).all();
}

}  // namespace bielle::mechanism

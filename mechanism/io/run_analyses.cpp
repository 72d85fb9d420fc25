#include "mechanism/io/run_analyses.hpp"

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

  static long steps_of(const Analysis& dynamics) {
    return std::max(1L, std::lround(std::ceil(dynamics.duration / dynamics.step * (1 - 1e-12))));
  }

  std::size_t expected_rows(const Analysis& analysis) const {
    if (analysis.type == Analysis::Type::assembly) return 1;
    if (analysis.type == Analysis::Type::statics) return static_cast<std::size_t>(analysis.steps) + 1;
    return static_cast<std::size_t>(steps_of(analysis) / file_.output.every) + 2;  // and the first, and the last
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

  AnalysisSummary integrate(const Analysis& analysis) {
    AnalysisSummary summary;
    summary.name = fmt::format("dynamic, {}", analysis.scheme_name);
    const double begin = state_.time, end = begin + analysis.duration;
    const long steps = steps_of(analysis);
    const double h = analysis.duration / static_cast<double>(steps);
    if (std::abs(h - analysis.step) > 1e-9 * h)
      progress_.note(fmt::format("step {:.6g} s in place of {:.6g} s, so that {} steps fill the duration", h,
                                 analysis.step, steps));
    TimeIntegration integration(system_, environment_, analysis.scheme, std::move(state_));
    summary.start = integration.start_report();
    state_ = integration.state();
    EnergyBalance books;
    books.start(begin, system_.energy(state_, environment_));
    record(environment_, books, h, 0);
    summary.records = 1;
    integration.start(h);
    for (long k = 1; k <= steps; ++k) {
      // Counted, not summed: the last step ends on the end.
      const double target = k == steps ? end : begin + static_cast<double>(k) * h;
      const StepReport report = integration.step(target - integration.state().time);
      summary.iterations += report.iterations;
      ++summary.steps;
      books.advance(integration.state().time, system_.energy(integration.state(), environment_));
      if (k % file_.output.every == 0 || k == steps) {
        state_ = integration.state();
        record(environment_, books, h, report.iterations);
        ++summary.records;
      }
      progress_.update(static_cast<double>(k) / static_cast<double>(steps),
                       fmt::format("t = {:.4g} s", integration.state().time));
      guard_.check(integration.state().time);
    }
    state_ = integration.state();
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

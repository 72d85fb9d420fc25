#include "mechanism/io/run_analyses.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "mechanism/io/energy_balance.hpp"
#include "mechanism/io/interrupt_guard.hpp"
#include "mechanism/io/results_file.hpp"
#include "mechanism/io/step_log.hpp"
#include "mechanism/solvers/model_length.hpp"
#include "mechanism/solvers/redundancy.hpp"
#include "mechanism/solvers/statics.hpp"
#include "reduce/common/hdf5_file.hpp"

namespace bielle::mechanism {
namespace {

class Run {
 public:
  Run(const MechanismFile& file, const std::string& results_path, Progress& progress,
      const std::optional<Checkpoint>& checkpoint)
      : file_(file),
        system_(file.model),
        environment_(file.model.environment),
        state_(system_.start(0)),
        checkpoint_(checkpoint),
        results_(checkpoint ? ResultsFile(results_path, file.model, file.text, *checkpoint)
                            : ResultsFile(results_path, file.model, file.text)),
        progress_(progress) {
    if (file.output.log) log_.emplace(results_path, system_, checkpoint.has_value());
    advice_ = fmt::format("; `bielle-mechanism {} --restart {}` goes on from there",
                          file.path.empty() ? "MODEL.yaml" : file.path, results_path);
    results_.name_equations(system_);
    const std::vector<int> redundant = find_redundant(system_, environment_, state_);
    system_.set_aside(redundant);
    redundant_ = name_constraints(system_, redundant);
  }

  std::vector<AnalysisSummary> all() {
    std::vector<AnalysisSummary> summaries;
    for (std::size_t k = 0; k < file_.analyses.size(); ++k) {
      const Analysis& analysis = file_.analyses[k];
      const int number = static_cast<int>(k) + 1;
      if (checkpoint_ && number < checkpoint_->analysis) continue;
      progress_.start(analysis.name);
      if (checkpoint_ && number == checkpoint_->analysis) {
        summaries.push_back(integrate(analysis, &*checkpoint_));
        results_.end_analysis();
        summaries.back().redundant = redundant_;
        continue;
      }
      results_.begin_analysis(analysis.name, expected_rows(analysis));
      switch (analysis.type) {
        case Analysis::Type::assembly:
          summaries.push_back(assemble(analysis));
          break;
        case Analysis::Type::statics:
          summaries.push_back(solve_static(analysis));
          break;
        case Analysis::Type::dynamics:
          summaries.push_back(integrate(analysis, nullptr));
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

  void record(const State& state, const MarchStep& step, const EnergyBalance& books) {
    StepRecord row;
    row.energy = books.totals();
    row.balance = books.balance();
    row.step = step.report.size;
    row.newton_iterations = step.report.iterations;
    row.error_estimate = step.error;
    row.worst_residual = step.report.worst_ratio;
    row.worst_equation = step.report.worst_equation;
    results_.record(state, system_.slots(), environment_, row);
  }

  static long grid_steps(const Analysis& dynamics) {
    return std::max(1L, std::lround(std::ceil(dynamics.duration / dynamics.stepping.size * (1 - 1e-12))));
  }

  /// 0: unknown.
  std::size_t expected_rows(const Analysis& analysis) const {
    if (analysis.type == Analysis::Type::assembly) return 1;
    if (analysis.type == Analysis::Type::statics)
      return analysis.steps == 0 || analysis.path ? 0 : static_cast<std::size_t>(analysis.steps) + 1;
    if (!file_.output.times.empty()) return file_.output.times.size() + 1;
    if (analysis.stepping.tolerance > 0) return 0;
    return static_cast<std::size_t>(grid_steps(analysis) / file_.output.every) + 2;  // and the first, and the last
  }

  AnalysisSummary assemble(const Analysis& analysis) {
    AnalysisSummary summary;
    summary.name = analysis.name;
    assemble_positions(system_, environment_, state_, summary.start);
    MassSaddle saddle(system_);
    make_velocities_consistent(system_, environment_, state_, summary.start, saddle);
    system_.accept(state_, environment_);
    loaded_.motions = 1;
    EnergyBalance books;
    books.start(state_.time, system_.energy(state_, environment_));
    record(environment_, books, 0, 0);
    summary.records = 1;
    summary.end_time = state_.time;
    return summary;
  }

  AnalysisSummary solve_static(const Analysis& analysis) {
    AnalysisSummary summary;
    EnergyBalance books;
    const auto note = [&](const State& state, double factor, int iterations, double done) {
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
      progress_.update(done, fmt::format("load factor {:.4g}", factor));
    };
    VectorX v(system_.dofs()), unused(system_.dofs());
    system_.get_rates(state_, v, unused);
    if (!v.isZero(0))
      progress_.note(
          "a static analysis is at rest, and so is what comes behind it: the velocities are dropped (a dynamic "
          "analysis with `start: equilibrium` keeps them)");
    Environment statics = environment_;
    statics.statics = true;
    if (analysis.path) {
      loaded_ = follow_path(system_, statics, loaded_, *analysis.path, analysis.newton, state_,
                            [&](const State& state, const PathPoint& point) {
                              note(state, point.load_factor, point.iterations, point.done);
                              if (point.limit) summary.limit_points.push_back(point.load_factor);
                            });
      summary.name =
          fmt::format("static, arc length, {} points to load factor {:.6g}", summary.records, loaded_.factor);
    } else {
      const double begin = loaded_.factor;
      solve_statics(system_, statics, LoadSteps(analysis.steps, loaded_), analysis.newton, state_,
                    [&](const State& state, double factor, int iterations) {
                      note(state, factor, iterations, begin == 1 ? 1 : (factor - begin) / (1 - begin));
                    });
      loaded_ = {1, 1};
      summary.name = fmt::format("static, {} load step{}", summary.records, summary.records == 1 ? "" : "s");
    }
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
      progress_.note(fmt::format("{} kinks of loads and motions in {} steps: steps do not end on them",
                                 options.break_points.size(), steps));
      options.break_points.clear();
    }
    return options;
  }

  /// A dynamic analysis on its way.
  struct Motion {
    double begin = 0, end = 0;
    StepOptions stepping;
    std::optional<TimeIntegration> integration;
    std::optional<March> march;
    EnergyBalance books;
    long grid_steps = 0;     ///< done
    bool saved = false;      ///< nothing has happened since the last checkpoint
    bool cautioned = false;  ///< of joints that turn far in a step
  };

  /// @param checkpoint  to go on from, or nullptr
  AnalysisSummary integrate(const Analysis& analysis, const Checkpoint* checkpoint) {
    AnalysisSummary summary;
    Motion motion;
    summary.name = fmt::format("dynamic, {}", analysis.scheme_name);
    if (checkpoint) {
      go_on(analysis, *checkpoint, motion);
      summary.name += fmt::format(", continued from t = {:.6g} s", motion.integration->state().time);
    } else {
      set_off(analysis, motion, summary.start);
      summary.records = 1;
    }
    try {
      while (!motion.march->done()) {
        step(motion, summary);
        guard_.check(motion.integration->state().time, advice_);
      }
    } catch (const ComputationError&) {
      save(motion);
      throw;
    }
    save(motion);
    state_ = motion.integration->state();
    summary.march = motion.march->log();
    summary.steps = summary.march.steps;
    summary.iterations = summary.march.iterations;
    if (summary.march.slowest_equation >= 0)
      summary.slowest_equation = system_.equation_name(summary.march.slowest_equation);
    summary.end_time = state_.time;
    summary.energy = motion.books.totals();
    summary.energy_start = motion.books.energy_at_start();
    summary.balance = motion.books.balance();
    summary.largest_energy = motion.books.largest();
    summary.energy_noise = energy_noise();
    return summary;
  }

  /// Newton's method knows positions to some 1e-9 of the model's size; energies below the work of the largest forces
  /// along that mean nothing [J].
  double energy_noise() const {
    constexpr double positions = 1e-9;
    VectorX r(system_.size());
    ResidualScale scale;
    system_.residual(state_, environment_, r, &scale);
    return positions * (scale[Kind::translation] * model_length(state_) + scale[Kind::rotation]);
  }

  void set_off(const Analysis& analysis, Motion& motion, StartReport& start) {
    // All of the loads and of the prescribed motions act, wherever statics have stopped.
    loaded_ = {1, 1};
    if (state_.motion_factor != 1) {
      state_.motion_factor = 1;
      system_.displace(state_, State(state_), VectorX::Zero(system_.dofs()));
    }
    if (analysis.equilibrium) settle(system_, environment_, analysis.newton, state_, start);
    motion.begin = state_.time;
    motion.end = motion.begin + analysis.duration;
    motion.stepping = stepping_of(analysis, motion.begin);
    motion.integration.emplace(system_, environment_, analysis.scheme, std::move(state_), analysis.form,
                               analysis.newton);
    start.add(motion.integration->start_report());
    state_ = motion.integration->state();
    motion.books.start(motion.begin, system_.energy(state_, environment_));
    record(environment_, motion.books, motion.stepping.size, 0);
    make_march(motion);
  }

  void make_march(Motion& motion) {
    motion.march.emplace(*motion.integration, motion.begin, motion.end, motion.stepping);
    if (log_) motion.march->observe([this](const Attempt& attempt) { log_->write(attempt); });
  }

  void go_on(const Analysis& analysis, const Checkpoint& checkpoint, Motion& motion) {
    Archive archive(checkpoint.values);
    bool whole = true;
    try {
      exchange_books(archive, motion);
      motion.end = motion.begin + analysis.duration;
      motion.stepping = stepping_of(analysis, motion.begin);
      loaded_ = {1, 1};
      motion.integration.emplace(system_, environment_, analysis.scheme, archive, analysis.form, analysis.newton);
      make_march(motion);
      motion.march->exchange(archive);
    } catch (const std::out_of_range&) {
      whole = false;
    }
    if (!whole || !archive.exhausted())
      throw InputError(
          "the last checkpoint holds other numbers than this program goes on from: it was written by another version, "
          "or is damaged");
    motion.saved = true;
  }

  void exchange_books(Archive& archive, Motion& motion) {
    archive(motion.begin);
    archive(motion.grid_steps);
    motion.books.exchange(archive);
    results_.exchange(archive);
  }

  void save(Motion& motion) {
    if (motion.saved) return;
    Archive archive;
    exchange_books(archive, motion);
    motion.integration->exchange(archive);
    motion.march->exchange(archive);
    results_.checkpoint(archive);
    motion.saved = true;
  }

  /// A step with the rows that it asks for.
  void step(Motion& motion, AnalysisSummary& summary) {
    const TimeIntegration& integration = *motion.integration;
    const OutputOptions& output = file_.output;
    const double before = integration.state().time;
    const EnergyBalance books_before = motion.books;
    const MarchStep step = motion.march->advance();
    motion.saved = false;
    if (!motion.cautioned)
      if (const std::string caution = integration.caution(); !caution.empty()) {
        progress_.note(caution);
        motion.cautioned = true;
      }
    const State& now = integration.state();
    motion.books.advance(now.time, system_.energy(now, environment_));
    if (step.on_grid) ++motion.grid_steps;
    if (!output.times.empty()) {
      for (auto time = std::upper_bound(output.times.begin(), output.times.end(), before);
           time != output.times.end() && *time <= now.time; ++time) {
        const State state = *time == now.time ? now : integration.interpolated(*time);
        EnergyBalance books = books_before;
        books.advance(*time, system_.energy(state, environment_));
        record(state, step, books);
        ++summary.records;
      }
    } else if ((step.on_grid && motion.grid_steps % output.every == 0) || motion.march->done()) {
      record(now, step, motion.books);
      ++summary.records;
    }
    if (output.checkpoint > 0 && step.on_grid && motion.grid_steps % output.checkpoint == 0) save(motion);
    progress_.update((now.time - motion.begin) / (motion.end - motion.begin), fmt::format("t = {:.4g} s", now.time));
  }

  const MechanismFile& file_;
  System system_;
  Environment environment_;
  State state_;
  Loaded loaded_;  ///< what the analyses so far have brought about
  std::optional<Checkpoint> checkpoint_;
  ResultsFile results_;
  Progress& progress_;
  std::optional<StepLog> log_;
  InterruptGuard guard_;
  std::string advice_;  ///< how to go on after an interruption
  std::vector<std::string> redundant_;
};

/// What stands where the results will go may be results only: never a model, a superelement or a table.
void check_may_be_replaced(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code none;
  if (!fs::exists(path, none) || fs::file_size(path, none) == 0) return;
  try {
    if (Hdf5File::open(path).read_text_attribute("/", "format") == "bielle results") return;
  } catch (const InputError&) {
    // no HDF5 file at all, or none of ours
  }
  throw InputError(fmt::format(
      "{}: exists and is no results file; the results would replace it: choose another name with -o", path));
}

}  // namespace

std::vector<AnalysisSummary> run_analyses(const MechanismFile& file, const std::string& results_path,
                                          Progress& progress, const std::string& restart) {
  namespace fs = std::filesystem;
  check_may_be_replaced(results_path);
  std::optional<Checkpoint> checkpoint;
  if (!restart.empty()) {
    checkpoint = read_checkpoint(restart, file.model);
    if (checkpoint->analysis > static_cast<int>(file.analyses.size()))
      throw InputError(fmt::format("{}: its last checkpoint is of analysis {}, and the model has {}", restart,
                                   checkpoint->analysis, file.analyses.size()));
    const Analysis& analysis = file.analyses[static_cast<std::size_t>(checkpoint->analysis) - 1];
    if (analysis.type != Analysis::Type::dynamics)
      throw InputError(
          fmt::format("{}: its last checkpoint is of analysis {}, which is '{}' in the model and not a dynamic one",
                      restart, checkpoint->analysis, analysis.name));
    std::error_code none;
    if (!fs::equivalent(restart, results_path, none))
      fs::copy_file(restart, results_path, fs::copy_options::overwrite_existing);
  }
  return Run(file, results_path, progress, checkpoint).all();
}

}  // namespace bielle::mechanism

// The time of a step and its parts for superelements with many modes.
//
//   performance_mechanism_superelements [BODIES MODES ...]      default 20 50, then 1 100
//   performance_mechanism_superelements --steps BODIES MODES    the steps alone, for comparisons of two builds
//
// A chain of bodies of 1 m and 1 kg hangs from the ground by one end and is released from the horizontal, joined by
// hinges; 0.1 s in steps of 1 ms. Each is the straight beam of tests/support, reduced to its two ends and a number of
// fixed-boundary modes, and all are read from the same file. The steps run as for a user, but without output. The parts
// are then measured one by one at the last state.
//
// Processor time of the calling thread, the fastest of several rounds, unless labelled elapsed, for work that other
// threads shorten.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/solvers/constraints/redundancy.hpp"
#include "mechanism/solvers/dynamics/time_integration.hpp"
#include "reduce/common/command_line.hpp"
#include "reduce/dense/blas.hpp"
#include "tests/performance/processor_time.hpp"
#include "tests/support/beam_superelement.hpp"

namespace {

using namespace bielle;
using namespace bielle::mechanism;
using namespace bielle::performance;

constexpr double step = 1e-3;

/// The file of the bodies, which is deleted with this object.
class BodyFile {
 public:
  explicit BodyFile(int modes) {
    const test::BeamProperties stiff{1, 1e7, 130, 100, 80, 1e-4};  // bends by 0.01 of its length
    test::BeamChain beam = test::straight_beam(stiff, modes);
    beam.damping = 1e-4;
    write_superelement(beam.reduced().body, path_);
  }
  ~BodyFile() { std::filesystem::remove(path_); }
  BodyFile(const BodyFile&) = delete;
  BodyFile& operator=(const BodyFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_ = (std::filesystem::temp_directory_path() / "performance_mechanism_superelements.h5").string();
};

std::string chain(int bodies, const std::string& file) {
  std::string nodes, elements, joints;
  for (int k = 0; k < bodies; ++k) {
    nodes += fmt::format("  a{0}: {{position: [{0}, 0, 0]}}\n  b{0}: {{position: [{1}, 0, 0]}}\n", k, k + 1);
    elements += fmt::format(
        "  e{0}: {{type: superelement, file: {1}, nodes: {{a: a{0}, b: b{0}}}, position: [{0}, 0, 0]}}\n", k, file);
    joints += fmt::format("  j{}: {{type: hinge, axis: [0, 1, 0], nodes: [{}, a{}], position: [{}, 0, 0]}}\n", k,
                          k == 0 ? "ground" : fmt::format("b{}", k - 1), k, k);
  }
  return "gravity: [0, 0, -9.81]\nnodes:\n" + nodes + "elements:\n" + elements + "joints:\n" + joints;
}

struct Run {
  double processor = 0;                                                       ///< processor time of the calling thread,
                                                                              ///< per step [s]
  double all = 0;                                                             ///< processor time of all threads, per
                                                                              ///< step [s]
  double elapsed = 0;                                                         ///< per step [s]
  double iterations = 0, factorisations = 0, evaluations = 0, solutions = 0;  ///< per step
  State state;
};

Run integrate(const MechanismFile& file, const System& system, bool reuse) {
  NewtonOptions newton;
  newton.tangent = reuse ? Tangent::reused : Tangent::renewed;
  TimeIntegration integration(system, file.model.environment, Scheme::generalized_alpha(0.8), system.start(0),
                              ConstraintForm::corrected, newton);
  integration.start(step);
  Run run;
  constexpr int steps = 100;
  const double thread = processor_seconds(), all = processor_seconds(CLOCK_PROCESS_CPUTIME_ID),
               elapsed = processor_seconds(CLOCK_MONOTONIC);
  for (int k = 0; k < steps; ++k) {
    const StepReport report = integration.step(step);
    run.iterations += report.iterations;
    run.factorisations += report.factorisations;
    run.evaluations += report.evaluations;
    run.solutions += report.solutions;
    system.energy(integration.state(), file.model.environment);
  }
  run.processor = processor_seconds() - thread;
  run.all = processor_seconds(CLOCK_PROCESS_CPUTIME_ID) - all;
  run.elapsed = processor_seconds(CLOCK_MONOTONIC) - elapsed;
  for (double* each :
       {&run.processor, &run.all, &run.elapsed, &run.iterations, &run.factorisations, &run.evaluations, &run.solutions})
    *each /= steps;
  run.state = integration.state();
  return run;
}

/// Keeps the least times of several runs, since other work on the machine slows some of them.
void keep_fastest(const Run& run, Run& best) {
  if (best.state.nodes.empty()) best = run;
  best.processor = std::min(best.processor, run.processor);
  best.all = std::min(best.all, run.all);
  best.elapsed = std::min(best.elapsed, run.elapsed);
}

/// Measures steps by one thread and by all, alternately. @returns the last state
State measure_steps(const MechanismFile& file, System& system, bool reuse) {
  Run alone, together;
  for (int round = 0; round < 3; ++round)
    for (Run* best : {&alone, &together}) {
      system.use_threads(best == &alone ? 1 : available_processors());
      keep_fastest(integrate(file, system, reuse), *best);
    }
  fmt::print("  tangent {}: {:.2f} iterations, {:.2f} factorisations, {:.2f} evaluations, {:.2f} solutions per step\n",
             reuse ? "reused" : "renewed", alone.iterations, alone.factorisations, alone.evaluations, alone.solutions);
  fmt::print("    per step {:.0f} us of the processor with one thread, {:.0f} elapsed\n", 1e6 * alone.processor,
             1e6 * alone.elapsed);
  fmt::print("    with {} threads {:.0f} us of the calling one, {:.0f} of all, {:.0f} elapsed\n",
             system.workers().threads(), 1e6 * together.processor, 1e6 * together.all, 1e6 * together.elapsed);
  std::fflush(stdout);
  return together.state;
}

/// Evaluates the superelements one after the other, without assembly. Superelements keep their last evaluation, so that
/// residuals alternate between two states, and tangents follow a residual of the same state.
class Bodies {
 public:
  Bodies(const System& system, const State& state, const Environment& environment)
      : system_(system), state_(state), other_(state), environment_(environment) {
    for (NodeState& node : other_.nodes) node.x.x() += 1e-9;
    for (std::size_t m = 0; m < system.slots().size(); ++m)
      if (system.slots()[m].amplitudes > 0) members_.push_back(m);
    const int n = system.slots()[members_.front()].size();
    r_.setZero(n);
    for (MatrixX* matrix : {&K_, &C_, &M_}) matrix->setZero(n, n);
  }
  void residuals() {
    for (const std::size_t m : members_) component(m).add_residual(local(m, turn_ ? state_ : other_), r_);
    turn_ = !turn_;
  }
  void set_states() {
    for (const std::size_t m : members_) component(m).add_residual(local(m, state_), r_);
  }
  void tangents() {
    for (const std::size_t m : members_) {
      for (MatrixX* matrix : {&K_, &C_, &M_}) matrix->setZero();
      LocalTangent tangent{LocalMatrix(K_), LocalMatrix(C_), LocalMatrix(M_), true, true, true};
      component(m).add_tangent(local(m, state_), tangent);
    }
  }
  std::size_t count() const { return members_.size(); }
  int size() const { return static_cast<int>(r_.size()); }

 private:
  const Component& component(std::size_t m) const { return *system_.model().members()[m].component; }
  LocalState local(std::size_t m, const State& state) const { return {state, system_.slots()[m], environment_}; }

  const System& system_;
  const State& state_;
  State other_;
  const Environment& environment_;
  bool turn_ = false;
  std::vector<std::size_t> members_;
  VectorX r_;
  MatrixX K_, C_, M_;
};

/// Measures factors with and without condensation alternately, so that other work on the machine affects both.
template <class Line, class Products>
void compare_factors(const System& system, const NewtonMatrix& linear, const Line& line, const Products& products) {
  VectorX scales = VectorX::Ones(system.size());
  scales.tail(system.multipliers()).setConstant(linear.scale());
  CondensedLU condensed(system.condensed_pattern());
  SparseLU whole(system.pattern());
  Workers one;
  VectorX b = VectorX::LinSpaced(system.size(), -1, 1);
  double times[6] = {1e9, 1e9, 1e9, 1e9, 1e9, 1e9};
  for (int round = 0; round < 5; ++round) {
    const double now[] = {
        time_of([&] { whole.factor(linear.values(), scales); }),
        time_of([&] { condensed.factor(linear.values(), scales, one); }),
        time_of([&] { condensed.factor(linear.values(), scales, system.workers()); }, CLOCK_MONOTONIC),
        time_of([&] {
          whole.forget();
          whole.factor(linear.values(), scales);
        }),
        time_of([&] {
          condensed.forget();
          condensed.factor(linear.values(), scales, one);
        }),
        0};
    for (int k = 0; k < 6; ++k) times[k] = std::min(times[k], now[k]);
  }
  line("factors of the whole", times[0], products(times[0]));
  line(condensed.condensed() ? "factors, condensed" : "factors (nothing is condensed)", times[1],
       products(times[1]) + fmt::format(", ratio {:.2f}", times[1] / times[0]));
  line("the same, elapsed", times[2]);
  line("factors of the whole with new pivots", times[3]);
  line("the same, condensed", times[4], fmt::format("   ratio {:.2f}", times[4] / times[3]));
  const double solved = time_of([&] { whole.solve(b); });
  line("solution with the whole", solved);
  const double condensed_solved = time_of([&] { condensed.solve(b); });
  line("solution, condensed", condensed_solved, fmt::format("   ratio {:.2f}", condensed_solved / solved));
}

void measure_parts(const MechanismFile& file, const System& system, const State& state) {
  const Environment& environment = file.model.environment;
  NewtonMatrix linear(system);
  const TangentWeights weights{1, 2 / step, 4 / (step * step), 0, 1};
  const VectorX dq = VectorX::Constant(system.dofs(), 1e-3);
  VectorX r(system.size()), delta(system.size());
  ResidualScale scale;
  std::vector<double> values;
  Bodies bodies(system, state, environment);
  const auto line = [](const char* name, double seconds, const std::string& remark = {}) {
    fmt::print("    {:<44} {:9.1f} us{}\n", name, 1e6 * seconds, remark);
  };
  const auto count = static_cast<double>(bodies.count());
  const double residual = time_of([&] { bodies.residuals(); });
  bodies.set_states();
  const double tangent = time_of([&] { bodies.tangents(); });
  const int n = bodies.size();
  const MatrixX a = MatrixX::Random(n, n), b = MatrixX::Random(n, n);
  MatrixX c = MatrixX::Zero(n, n);
  const BlasThreads one(1);
  const double dgemm = time_of([&] {
    add_dense_product({a.data(), n, n, n, false}, {b.data(), n, n, n, false}, c.data(), n);
  });
  const auto products = [&](double seconds) {
    return fmt::format("   {:.2f} dgemm of {} rows per body", seconds / count / dgemm, n);
  };
  line("residuals of the bodies, one thread", residual, products(residual));
  line("tangents of the bodies, one thread", tangent, products(tangent));
  const auto all_residuals = [&] { system.residual(state, environment, r, &scale); };
  const auto all_tangents = [&] { system.tangent(state, environment, weights, &dq, values); };
  line("residual with assembly", time_of(all_residuals));
  line("the same, elapsed", time_of(all_residuals, CLOCK_MONOTONIC));
  line("tangent with assembly", time_of(all_tangents));
  line("the same, elapsed", time_of(all_tangents, CLOCK_MONOTONIC));
  linear.factor(state, environment, weights, &dq);
  compare_factors(system, linear, line, products);
  line("energies", time_of([&] { system.energy(state, environment); }));
  line("one dgemm", dgemm);
}

void measure(int bodies, int modes, bool steps_alone) {
  const BodyFile body(modes);
  const MechanismFile file = read_mechanism_text(chain(bodies, body.path()), "model.yaml");
  System system(file.model);
  system.set_aside(find_redundant(system, file.model.environment, system.start(0)));
  fmt::print("\n{} superelements of {} modes: {} equations, {} entries\n", bodies, modes, system.size(),
             system.pattern().entry_count());
  State state;
  for (const bool reuse : {false, true}) state = measure_steps(file, system, reuse);
  if (!steps_alone) measure_parts(file, system, state);
}

}  // namespace

int main(int argc, char** argv) {
  const bool steps_alone = argc > 1 && std::string(argv[1]) == "--steps";
  std::vector<int> numbers;
  for (int k = steps_alone ? 2 : 1; k < argc; ++k) numbers.push_back(std::atoi(argv[k]));
  if (numbers.empty()) numbers = {20, 50, 1, 100};
  for (std::size_t k = 0; k + 1 < numbers.size(); k += 2) measure(numbers[k], numbers[k + 1], steps_alone);
}

// The time of a step and its parts: chains of rigid links, and a beam.
//
//   performance_mechanism_chain [LINKS ...]      default 10 100 500, then a beam of 50 elements
//   performance_mechanism_chain --run MODEL automatic|reused|renewed LINKS STEPS      one run, for step_shares
//
// The joints are spherical, the cheapest type, or hinges; links between hinges are rigid, or elastic (one beam element
// each). The beam falls as well. Each model runs with every step recorded, as a user runs it, in turns with tangents
// renewed, reused, and as their counted costs decide (`automatic`). The parts are then measured one by one at the last
// state: residuals and tangents (elements with their assembly), energies and memory, the motion of the nodes (rotations
// and what follows from them), factorisation, solution; and output as the difference of the runs with and without it;
// all in time of the processor. The rest is the scheme's: prediction, tests of convergence, records. Work that a run
// does once, when its file is closed, is reported separately. step_shares measures the share of assembly in residuals
// and tangents.
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/results/results_file.hpp"
#include "mechanism/session/energy_balance.hpp"
#include "tests/performance/processor_time.hpp"
#include "tests/support/chain.hpp"

namespace {

using namespace bielle;
using namespace bielle::mechanism;
using namespace bielle::performance;
using namespace bielle::test;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::string beam(int elements) {
  return fmt::format(R"yaml(
gravity: [0, 0, -9.81]
nodes: {{a: {{position: [0, 0, 0]}}, b: {{position: [2, 0, 0]}}}}
elements:
  beam: {{type: beam, nodes: [a, b], elements: {}, section: {{circle: 0.01, young: 2.1e11, poisson: 0.3, density: 7800}}}}
joints: {{pivot: {{type: hinge, nodes: [ground, a], axis: [0, 1, 0]}}}}
)yaml",
                     elements);
}

struct Run {
  double seconds = 0;         ///< elapsed
  double processor = 0;       ///< processor time of the computing thread in the steps
  double end = 0;             ///< processor time of closing the file
  double all_processors = 0;  ///< processor time of all threads, including the one that writes
  long iterations = 0, factorisations = 0, evaluations = 0, solutions = 0, orders = 0, steps = 0;
  State state;
};

constexpr double step = 1e-3;

Run integrate(const MechanismFile& file, const System& system, Tangent tangent, const std::string& results_path,
              long steps = 2000) {
  NewtonOptions newton;
  newton.tangent = tangent;
  TimeIntegration integration(system, file.model.environment, Scheme::generalized_alpha(0.8), system.start(0),
                              ConstraintForm::position, newton);
  integration.start(step);
  EnergyBalance energy_balance;
  energy_balance.start(0, system.energy(integration.state(), file.model.environment));
  std::unique_ptr<ResultsFile> results;
  if (!results_path.empty()) {
    results = std::make_unique<ResultsFile>(results_path, file.model, file.text);
    results->begin_analysis("dynamic", static_cast<std::size_t>(steps) + 1);
  }
  Run run;
  const auto start = std::chrono::steady_clock::now();
  const double thread = processor_seconds(CLOCK_THREAD_CPUTIME_ID), all = processor_seconds(CLOCK_PROCESS_CPUTIME_ID);
  for (run.steps = 0; run.steps < steps; ++run.steps) {
    const StepReport report = integration.step(step);
    run.iterations += report.iterations;
    run.factorisations += report.factorisations;
    run.evaluations += report.evaluations;
    run.solutions += report.solutions;
    run.orders += report.order;
    energy_balance.advance(integration.state().time, system.energy(integration.state(), file.model.environment));
    if (results) {
      StepRecord row;
      row.energy = energy_balance.totals();
      row.balance = energy_balance.balance();
      row.step = step;
      row.newton_iterations = report.iterations;
      results->record(integration.state(), system.slots(), file.model.environment, row);
    }
  }
  run.processor = processor_seconds() - thread;
  if (results) {
    results->end_analysis();
    results->complete();
  }
  run.seconds = seconds_since(start);
  run.end = processor_seconds() - thread - run.processor;
  run.all_processors = processor_seconds(CLOCK_PROCESS_CPUTIME_ID) - all;
  run.state = integration.state();
  return run;
}

constexpr Tangent policies[] = {Tangent::renewed, Tangent::reused, Tangent::automatic};
constexpr const char* policy_names[] = {"renewed", "reused", "automatic"};
using Runs = std::array<Run, std::size(policies)>;

/// Returns the fastest of several alternating runs with each policy, since other work on the machine slows some of
/// them.
Runs fastest(const MechanismFile& file, const System& system, const std::string& results_path) {
  Runs best;
  for (int round = 0; round < 5; ++round)
    for (std::size_t k = 0; k < best.size(); ++k) {
      if (!results_path.empty()) std::filesystem::remove(results_path);
      Run run = integrate(file, system, policies[k], results_path);
      if (round == 0 || run.processor < best[k].processor) best[k] = std::move(run);
    }
  return best;
}

/// Evaluates the memory of components, which they keep from step to step.
void evaluate_memory(const System& system, const State& state, const Environment& environment) {
  static VectorX memory;
  memory = state.memory;
  for (std::size_t m = 0; m < system.slots().size(); ++m)
    if (const Slots& slots = system.slots()[m]; slots.memories > 0)
      system.model().members()[m].component->accept(LocalState(state, slots, environment),
                                                    memory.segment(slots.memory_begin, slots.memories));
}

std::string results_path() {
  return (std::filesystem::temp_directory_path() / "performance_mechanism_chain.h5").string();
}

/// Makes one long run, for a sampling profiler.
int run_only(const std::string& model, const std::string& tangents, int links, long steps) {
  const std::string text = model == "spherical"  ? chain(links, spherical)
                           : model == "hinges"   ? chain(links, hinge)
                           : model == "flexible" ? flexible_chain(links)
                                                 : "";
  const auto* const policy = std::find(std::begin(policy_names), std::end(policy_names), tangents);
  if (text.empty() || policy == std::end(policy_names) || links < 1 || steps < 1) {
    fmt::print(stderr, "expected --run spherical|hinges|flexible automatic|reused|renewed LINKS STEPS\n");
    return 1;
  }
  const MechanismFile file = read_mechanism_text(text, "model.yaml");
  System system(file.model);
  system.set_aside({});
  const Run run = integrate(file, system, policies[policy - policy_names], results_path(), steps);
  const auto per_step = [&](auto number) { return static_cast<double>(number) / static_cast<double>(run.steps); };
  fmt::print(
      "{:.2f} us per step, {:.2f} iterations, {:.3f} factorisations, {:.2f} evaluations, {:.2f} solutions, order "
      "{:.1f}\n",
      1e6 * per_step(run.processor), per_step(run.iterations), per_step(run.factorisations), per_step(run.evaluations),
      per_step(run.solutions), per_step(run.orders));
  return 0;
}

void measure(const std::string& title, const std::string& text) {
  const MechanismFile file = read_mechanism_text(text, "model.yaml");
  System system(file.model);
  system.set_aside({});
  const Environment& environment = file.model.environment;
  const std::string path = results_path();
  fmt::print("\n{}: {} equations\n", title, system.size());
  const Runs all_with = fastest(file, system, path), all_without = fastest(file, system, "");
  std::filesystem::remove(path);
  for (std::size_t policy = 0; policy < all_with.size(); ++policy) {
    const Run &with = all_with[policy], &without = all_without[policy];

    NewtonMatrix linear(system);
    const TangentWeights weights{1, 2 / step, 4 / (step * step), 0, 1};
    const VectorX dq = VectorX::Constant(system.dofs(), 1e-3);
    VectorX r(system.size()), delta(system.size());
    ResidualScale scale;
    std::vector<double> values;
    const State& state = with.state;
    linear.factor(state, environment, weights, &dq);
    // Each part has the weight of its calls per step.
    const auto steps = static_cast<double>(with.steps);
    const double iterations = static_cast<double>(with.iterations) / steps;
    const double tangents = static_cast<double>(with.factorisations) / steps;
    const double residuals = static_cast<double>(with.evaluations) / steps;
    const double solutions = static_cast<double>(with.solutions) / steps;
    const double energy = time_of([&] { system.energy(state, environment); });
    const double memory = time_of([&] { evaluate_memory(system, state, environment); });
    const double residual = time_of([&] { system.residual(state, environment, r, &scale); });
    const double tangent = time_of([&] { system.tangent(state, environment, weights, &dq, values); });
    const double factored = time_of([&] { linear.factor(state, environment, weights, &dq); }) - tangent;
    State moved = state;
    const double motion = time_of([&] {
      system.displace(moved, state, dq);
      system.set_rates(moved, dq, dq);
    });
    const double factor = tangents * factored;
    const double solved = time_of([&] { linear.solve(r, delta); }), solve = solutions * solved;

    const double total = 1e6 * with.processor / steps, output = total - 1e6 * without.processor / steps;
    const auto line = [&](const char* name, double us) {
      fmt::print("      {:<28} {:8.2f} us {:6.1f} %\n", name, us, 100 * us / total);
    };
    fmt::print(
        "  tangent {}: {:.2f} iterations, {:.2f} factorisations, {:.2f} evaluations, {:.2f} solutions per step from "
        "order "
        "{:.1f}\n    which costs {:.1f} times one evaluation and one solution\n",
        policy_names[policy], iterations, tangents, residuals, solutions, static_cast<double>(with.orders) / steps,
        without.processor / steps / (residual + motion + solved));
    fmt::print(
        "    per step {:.2f} us of the processor, {:.2f} per iteration; elapsed with all ends {:.2f}, both threads "
        "{:.2f}; closing the file {:.1f} ms\n",
        total, total / iterations, 1e6 * with.seconds / steps, 1e6 * with.all_processors / steps, 1e3 * with.end);
    const double parts[] = {
        residuals * residual, tangents * tangent, energy + memory, residuals * motion, factor, solve};
    const char* const names[] = {"residuals",       "tangents",      "energies, memory",
                                 "motion of nodes", "factorisation", "solution"};
    double rest = total - output;
    for (int k = 0; k < 6; ++k) {
      line(names[k], 1e6 * parts[k]);
      rest -= 1e6 * parts[k];
    }
    line("output", output);
    line("the scheme's rest", rest);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 6 && std::string(argv[1]) == "--run")
    return run_only(argv[2], argv[3], std::atoi(argv[4]), std::atol(argv[5]));
  std::vector<int> links;
  for (int k = 1; k < argc; ++k) links.push_back(std::atoi(argv[k]));
  if (links.empty()) links = {10, 100, 500};
  for (const int n : links) {
    measure(fmt::format("chain of {} links, spherical joints", n), chain(n, spherical));
    measure(fmt::format("chain of {} links, hinges", n), chain(n, hinge));
    measure(fmt::format("chain of {} flexible links, hinges", n), flexible_chain(n));
  }
  if (argc == 1) measure("beam of 50 elements", beam(50));
}

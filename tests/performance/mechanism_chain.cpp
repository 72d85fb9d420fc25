// What a Newton iteration costs, and on what the time goes: chains of rigid links, and a beam.
//
//   performance_mechanism_chain [LINKS ...]      default 10 100 500, then a beam of 50 elements
//
// A chain of links of 1 m and 1 kg, joined by spherical joints, hangs from the ground by one end and is released from
// the horizontal; 2 s in steps of 1 ms. The beam falls likewise. Each model runs with every step recorded, as a user
// runs it, and the time of the run is divided by its Newton iterations. The parts are then measured one by one at the
// last state: evaluation of the elements (residuals and tangents), assembly around it, factorisation, solution; and
// output as the difference of the runs with and without it; all in time of the processor. What is left is the scheme's:
// predicting, moving the nodes, judging convergence, energies.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "mechanism/io/energy_balance.hpp"
#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/io/results_file.hpp"
#include "tests/performance/chain.hpp"
#include "tests/performance/processor_time.hpp"

namespace {

using namespace bielle;
using namespace bielle::mechanism;
using namespace bielle::performance;

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
  double processor = 0;       ///< of the computing thread
  double all_processors = 0;  ///< and of the one that writes
  long iterations = 0, factorisations = 0, steps = 0;
  State state;
};

constexpr double step = 1e-3;

Run integrate(const MechanismFile& file, const System& system, bool reuse, const std::string& results_path) {
  NewtonOptions newton;
  newton.reuse_tangent = reuse;
  TimeIntegration integration(system, file.model.environment, Scheme::generalized_alpha(0.8), system.start(0),
                              ConstraintForm::position, newton);
  integration.start(step);
  EnergyBalance books;
  books.start(0, system.energy(integration.state(), file.model.environment));
  std::unique_ptr<ResultsFile> results;
  if (!results_path.empty()) {
    results = std::make_unique<ResultsFile>(results_path, file.model, file.text);
    results->begin_analysis("dynamic", 2001);
  }
  Run run;
  const auto start = std::chrono::steady_clock::now();
  const double thread = processor_seconds(CLOCK_THREAD_CPUTIME_ID), all = processor_seconds(CLOCK_PROCESS_CPUTIME_ID);
  for (run.steps = 0; run.steps < 2000; ++run.steps) {
    const StepReport report = integration.step(step);
    run.iterations += report.iterations;
    run.factorisations += report.factorisations;
    books.advance(integration.state().time, system.energy(integration.state(), file.model.environment));
    if (results) {
      StepRecord row;
      row.energy = books.totals();
      row.balance = books.balance();
      row.step = step;
      row.newton_iterations = report.iterations;
      results->record(integration.state(), system.slots(), file.model.environment, row);
    }
  }
  if (results) {
    results->end_analysis();
    results->complete();
  }
  run.seconds = seconds_since(start);
  run.processor = processor_seconds(CLOCK_THREAD_CPUTIME_ID) - thread;
  run.all_processors = processor_seconds(CLOCK_PROCESS_CPUTIME_ID) - all;
  run.state = integration.state();
  return run;
}

/// Processor time of one call [s]: the fastest of several rounds.
double time_of(const std::function<void()>& call) {
  call();
  double best = 1e9;
  for (int round = 0; round < 10; ++round) {
    const double start = processor_seconds(CLOCK_THREAD_CPUTIME_ID);
    const auto spent = [&] { return processor_seconds(CLOCK_THREAD_CPUTIME_ID) - start; };
    int calls = 0;
    do {
      call();
      ++calls;
    } while (spent() < 0.02);
    best = std::min(best, spent() / calls);
  }
  return best;
}

/// Residuals and tangents of all components into buffers, without assembly.
void evaluate(const System& system, const State& state, const Environment& environment) {
  static std::vector<double> buffers[4];
  for (std::size_t m = 0; m < system.slots().size(); ++m) {
    const Slots& slots = system.slots()[m];
    const auto n = static_cast<Eigen::Index>(slots.size());
    for (auto& buffer : buffers) buffer.assign(static_cast<std::size_t>(n * n), 0.0);
    Eigen::Map<MatrixX> K(buffers[0].data(), n, n), C(buffers[1].data(), n, n), M(buffers[2].data(), n, n);
    Eigen::Map<VectorX> r(buffers[3].data(), n);
    const Component& component = *system.model().members()[m].component;
    const LocalState local(state, slots, environment);
    component.add_residual(local, r);
    LocalTangent tangent{K, C, M};
    component.add_tangent(local, tangent);
  }
}

void evaluate_residuals(const System& system, const State& state, const Environment& environment) {
  static VectorX r;
  for (std::size_t m = 0; m < system.slots().size(); ++m) {
    const Slots& slots = system.slots()[m];
    r.setZero(slots.size());
    system.model().members()[m].component->add_residual(LocalState(state, slots, environment), r);
  }
}

void measure(const std::string& title, const std::string& text) {
  const MechanismFile file = read_mechanism_text(text, "model.yaml");
  System system(file.model);
  system.set_aside({});
  const Environment& environment = file.model.environment;
  const std::string path = (std::filesystem::temp_directory_path() / "performance_mechanism_chain.h5").string();
  fmt::print("\n{}: {} equations\n", title, system.size());
  for (const bool reuse : {false, true}) {
    const Run with = integrate(file, system, reuse, path), without = integrate(file, system, reuse, "");
    std::filesystem::remove(path);

    LinearStep linear(system);
    const TangentWeights weights{1, 2 / step, 4 / (step * step), 0, 1};
    const VectorX dq = VectorX::Constant(system.dofs(), 1e-3);
    VectorX r(system.size()), delta(system.size());
    ResidualScale scale;
    std::vector<double> values;
    const State& state = with.state;
    linear.factor(state, environment, weights, &dq);
    // Each part by how often a run needs it: residuals once more per step than there are iterations.
    const auto iterations = static_cast<double>(with.iterations), steps = static_cast<double>(with.steps);
    const auto factorisations = static_cast<double>(with.factorisations);
    const double tangents = factorisations / iterations, residuals = 1 + steps / iterations;
    const double residual_elements = time_of([&] { evaluate_residuals(system, state, environment); });
    const double all_elements = time_of([&] { evaluate(system, state, environment); });
    const double energy = time_of([&] { system.energy(state, environment); }) * steps / iterations;
    const double residual = time_of([&] { system.residual(state, environment, r, &scale); });
    const double tangent = time_of([&] { system.tangent(state, environment, weights, &dq, values); });
    const double factored = time_of([&] { linear.factor(state, environment, weights, &dq); }) - tangent;
    const double elements = residuals * residual_elements + tangents * (all_elements - residual_elements) + energy;
    const double assembly =
        residuals * (residual - residual_elements) + tangents * (tangent - (all_elements - residual_elements));
    const double factor = tangents * factored;
    const double solve = time_of([&] { linear.solve(r, delta); }) * (reuse ? residuals : 1);

    const auto per_iteration = [&](double seconds) { return 1e3 * seconds / iterations; };
    const double total = per_iteration(with.processor), output = total - per_iteration(without.processor);
    const auto line = [&](const char* name, double ms) {
      fmt::print("      {:<28} {:8.4f} ms {:6.1f} %\n", name, ms, 100 * ms / total);
    };
    fmt::print("  tangent {}: {} steps, {:.2f} iterations and {:.2f} factorisations per step, {:.4f} ms per step\n",
               reuse ? "reused" : "renewed", with.steps, iterations / steps, factorisations / steps,
               1e3 * with.processor / steps);
    fmt::print(
        "    per iteration {:.4f} ms of the processor ({:.4f} elapsed, {:.4f} with the writing thread's), of it\n",
        total, per_iteration(with.seconds), per_iteration(with.all_processors));
    line("elements", 1e3 * elements);
    line("assembly", 1e3 * assembly);
    line("factorisation", 1e3 * factor);
    line("solution", 1e3 * solve);
    line("output", output);
    const double work = 1e3 * (elements + factor + solve);
    line("the scheme's rest", total - output - work - 1e3 * assembly);
    line("all but elements and solver", total - work);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<int> links;
  for (int k = 1; k < argc; ++k) links.push_back(std::atoi(argv[k]));
  if (links.empty()) links = {10, 100, 500};
  for (const int n : links) measure(fmt::format("chain of {} links", n), chain(n));
  if (argc == 1) measure("beam of 50 elements", beam(50));
}

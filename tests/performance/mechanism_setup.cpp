// The cost of reading, checking and setting up mechanisms of many parts, phase by phase, and its growth with their
// size.
//
//   performance_mechanism_setup [MODEL ...] [PARTS ...]      default: all models, 1000 and 10000 parts
//   performance_mechanism_setup --orderings [MODEL ...] [PARTS ...]
//
// The models are those of tests/support/large_models.hpp. Each size runs in a separate process with its own peak of
// memory; times are processor times. Each figure is followed by its ratio to that of the previous size: 10 for ten
// times the parts is linear.
//
// The second form factorises the matrices of a step, of a consistent start and of statics with both orderings that KLU
// has, and shows operations, entries of the factors and times. Minimum degree is slow if its pivots leave the diagonal:
// begin with few parts.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <klu.h>
#include <sys/wait.h>
#include <unistd.h>

#include "mechanism/io/describe_model.hpp"
#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/io/mechanism_keys.hpp"
#include "mechanism/language/expand_model.hpp"
#include "mechanism/solvers/constraints/redundancy.hpp"
#include "mechanism/solvers/dynamics/time_integration.hpp"
#include "mechanism/solvers/start/assemble_positions.hpp"
#include "mechanism/solvers/start/consistent_start.hpp"
#include "mechanism/solvers/statics/statics.hpp"
#include "reduce/common/error.hpp"
#include "reduce/common/input/yaml_node.hpp"
#include "tests/performance/processor_time.hpp"
#include "tests/support/large_models.hpp"

namespace {

using namespace bielle;
using namespace bielle::mechanism;
using namespace bielle::performance;
using bielle::test::LargeModel;

struct Phase {
  char name[32] = "";
  double seconds = 0;  ///< processor time [s]
  double memory = 0;   ///< peak of the process so far [MB]
};

/// Reads the model with one more element, which names a missing node: the nearest of all names is searched.
void message_about_unknown_node(const std::string& text) {
  try {
    read_mechanism_text(text + "loads: {wrong: {node: noed, force: [0, 0, 1]}}\n", "model.yaml");
  } catch (const InputError&) {
    return;
  }
  throw std::runtime_error("the unknown node was not noticed");
}

/// Runs all phases one after the other. @param report  called with each finished phase
void run_phases(const std::string& text, bool stands, const std::function<void(const Phase&)>& report) {
  const auto phase = [&](const char* name, const std::function<void()>& work) {
    Phase done;
    std::snprintf(done.name, sizeof done.name, "%s", name);
    const double start = processor_seconds(CLOCK_PROCESS_CPUTIME_ID);
    try {
      work();
    } catch (const std::runtime_error& error) {
      fmt::print("    {}: {}\n", name, error.what());
      std::fflush(stdout);
    }
    done.seconds = processor_seconds(CLOCK_PROCESS_CPUTIME_ID) - start;
    done.memory = peak_memory_MB();
    report(done);
  };
  Tree tree;
  phase("text to YAML", [&] { tree = parse_yaml(text, "model.yaml"); });
  phase("parts written out", [&] { expand_model(tree, "model.yaml", mechanism_file_keys(), {}); });
  MechanismFile file;
  phase("text to model", [&] { file = read_mechanism_text(text, "model.yaml"); });
  const Environment& environment = file.model.environment;
  std::unique_ptr<System> system;
  phase("numbers and pattern", [&] { system = std::make_unique<System>(file.model); });
  State state = system->start(0);
  phase("redundancy", [&] { take_out_redundant(*system, environment, state); });
  StartReport report_of_start;
  phase("positions", [&] { assemble_positions(*system, environment, state, report_of_start); });
  State loaded = state;
  phase("consistent start", [&] { make_consistent(*system, environment, state); });
  phase("five steps", [&] {
    constexpr double step = 1e-4;
    TimeIntegration integration(*system, environment, Scheme::generalized_alpha(0.8), state);
    integration.start(step);
    for (int k = 0; k < 5; ++k) integration.step(step);
  });
  Environment statics = environment;
  statics.statics = true;
  if (stands) phase("static step", [&] { solve_statics(*system, statics, LoadSteps(1), NewtonOptions{}, loaded); });
  phase("--check", [&] { describe_model(file); });
  phase("message", [&] { message_about_unknown_node(text); });
}

/// Runs the phases in a separate process.
std::vector<Phase> run_apart(const LargeModel& model, int parts) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    run_phases(model.text(parts), model.stands, [&](const Phase& phase) {
      if (write(ends[1], &phase, sizeof phase) != static_cast<ssize_t>(sizeof phase)) std::_Exit(1);
    });
    std::fflush(stdout);
    std::_Exit(0);
  }
  close(ends[1]);
  std::vector<Phase> phases;
  for (Phase phase; read(ends[0], &phase, sizeof phase) == static_cast<ssize_t>(sizeof phase);) phases.push_back(phase);
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  return phases;
}

void measure(const LargeModel& model, const std::vector<int>& sizes) {
  fmt::print("\n{}: {}\n", model.name, model.what);
  std::vector<std::vector<Phase>> runs;
  for (const int parts : sizes) runs.push_back(run_apart(model, parts));
  fmt::print("  {:<20}", "");
  for (const int parts : sizes) fmt::print("{:>9} parts: s      ratio       MB   ratio", parts);
  fmt::print("\n");
  for (std::size_t k = 0; k < runs.front().size(); ++k) {
    fmt::print("  {:<20}", runs.front()[k].name);
    for (std::size_t run = 0; run < runs.size(); ++run) {
      if (k >= runs[run].size()) {
        fmt::print("{:>48}", "did not get here");
        continue;
      }
      const Phase& now = runs[run][k];
      fmt::print("{:>17.3f}", now.seconds);
      if (run == 0 || k >= runs[run - 1].size())
        fmt::print("{:>11} {:>8.0f} {:>7}", "", now.memory, "");
      else
        fmt::print("{:>11.1f} {:>8.0f} {:>7.1f}", now.seconds / runs[run - 1][k].seconds, now.memory,
                   now.memory / runs[run - 1][k].memory);
    }
    fmt::print("\n");
  }
  std::fflush(stdout);
}

/// Factorises the last tangent of a linear step by one of KLU's orderings, scaled as in SparseLU.
void factorise(const System& system, const NewtonMatrix& linear, const char* name, int ordering) {
  const SparsePattern& pattern = system.pattern();
  VectorX scale = VectorX::Ones(pattern.size()), row_size = VectorX::Zero(pattern.size());
  scale.tail(system.multipliers()).setConstant(linear.scale());
  std::vector<double> values = linear.values();
  pattern.for_each([&](int k, int row, int column) {
    double& value = values[static_cast<std::size_t>(k)];
    value *= scale[row] * scale[column];
    row_size[row] = std::max(row_size[row], std::abs(value));
  });
  pattern.for_each([&](int k, int row, int) {
    if (row_size[row] > 0) values[static_cast<std::size_t>(k)] /= row_size[row];
  });
  int *start = const_cast<int*>(pattern.column_start().data()), *rows = const_cast<int*>(pattern.row().data());
  klu_common common;
  klu_defaults(&common);
  common.scale = -1;
  common.btf = 0;
  common.ordering = ordering;
  const double begin = processor_seconds();
  klu_symbolic* symbolic = klu_analyze(pattern.size(), start, rows, &common);
  const double analysed = processor_seconds();
  klu_numeric* numeric = klu_factor(start, rows, values.data(), symbolic, &common);
  const double factored = processor_seconds();
  if (!numeric || common.status != KLU_OK) {
    fmt::print("    {:<8} singular\n", name);
    klu_free_symbolic(&symbolic, &common);
    return;
  }
  klu_flops(symbolic, numeric, &common);
  const double refactoring = processor_seconds();
  klu_refactor(start, rows, values.data(), symbolic, numeric, &common);
  fmt::print(
      "    {:<8} {:>10.3g} operations {:>9.3g} entries, {:>7} pivots off the diagonal; analysis {:.4f}, with "
      "pivoting {:.4f}, again {:.4f} s\n",
      name, common.flops, static_cast<double>(numeric->lnz + numeric->unz), numeric->nzoff + common.noffdiag,
      analysed - begin, factored - analysed, processor_seconds() - refactoring);
  std::fflush(stdout);
  klu_free_numeric(&numeric, &common);
  klu_free_symbolic(&symbolic, &common);
}

/// Factorises it by SparseLU, which chooses the ordering.
void factorise_by_choice(const System& system, const NewtonMatrix& linear) {
  VectorX scale = VectorX::Ones(system.size());
  scale.tail(system.multipliers()).setConstant(linear.scale());
  SparseLU factors(system.pattern());
  const double begin = processor_seconds();
  if (factors.factor(linear.values(), scale) != FactorStatus::good) return;
  fmt::print("    {:<8} {:>10.3g} operations {:>9.3g} entries, {:.4f} s with all that is tried\n", "chosen",
             factors.cost().operations, factors.cost().entries, processor_seconds() - begin);
  std::fflush(stdout);
}

void compare_orderings(const LargeModel& model, int parts) {
  const MechanismFile file = read_mechanism_text(model.text(parts), "model.yaml");
  System system(file.model);
  State state = system.start(0);
  take_out_redundant(system, file.model.environment, state);
  NewtonMatrix linear(system);
  const VectorX dq = VectorX::Zero(system.dofs());
  constexpr double h = 1e-3;
  fmt::print("\n{}: {}, {} parts, {} equations\n", model.name, model.what, parts, system.size());
  const std::pair<const char*, TangentWeights> matrices[] = {{"a step", {1, 2 / h, 4 / (h * h), 0, 1}},
                                                             {"consistent start", {0, 0, 1, 1, 1, true}},
                                                             {"statics", {1, 0, 0, 0, 1, true}}};
  for (const auto& [name, weights] : matrices) {
    linear.assemble(state, file.model.environment, weights, &dq);
    fmt::print("  {}\n", name);
    factorise_by_choice(system, linear);
    factorise(system, linear, "COLAMD", 1);
    factorise(system, linear, "AMD", 0);
  }
}

}  // namespace

int main(int argc, char** argv) {
  bool orderings = false;
  std::vector<int> sizes;
  std::vector<std::string> names;
  for (int k = 1; k < argc; ++k) {
    if (std::strcmp(argv[k], "--orderings") == 0)
      orderings = true;
    else if (const int parts = std::atoi(argv[k]); parts > 0)
      sizes.push_back(parts);
    else
      names.emplace_back(argv[k]);
  }
  if (sizes.empty()) sizes = orderings ? std::vector<int>{100} : std::vector<int>{1000, 10000};
  for (const LargeModel& model : bielle::test::large_models()) {
    if (!names.empty() && std::find(names.begin(), names.end(), model.name) == names.end()) continue;
    if (!orderings) measure(model, sizes);
    for (const int parts : sizes)
      if (orderings) compare_orderings(model, parts);
  }
}

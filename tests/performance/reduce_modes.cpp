// The cost of the fixed-boundary modes of the connecting rod: block Lanczos with blocks of several widths against
// ARPACK with single vectors, with the same factor, in one run.
//
//   reduce_modes [--size MM ...] [--modes N ...] [--block B ...] [--tolerance T] [--no-arpack] [--rounds R]
//
// For each mesh: the time of a solution with 1, 2, 4 .. 64 columns, of a product with the mass, then for each number of
// modes the time, sweeps (readings of the factor), columns and restarts of each method, its time over ARPACK's, and the
// largest relative difference of eigenvalues. The methods take turns, `rounds` times, and the fastest counts. Nothing
// is asserted, since times depend on the machine.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "reduce/body_file/body_file.hpp"
#include "reduce/common/command_line.hpp"
#include "reduce/common/progress.hpp"
#include "reduce/dense/blas.hpp"
#include "reduce/mesh/import.hpp"
#include "reduce/reduction/fixed_interface_body.hpp"
#include "reduce/spectral/eigenpairs.hpp"

namespace {

using namespace bielle;
using namespace bielle::reduce;

struct Settings {
  std::vector<double> sizes{3.4, 2.13};  // [mm]
  std::vector<int> modes{20, 200}, blocks{0};
  bool no_arpack = false;
  double tolerance = EigenpairOptions().tolerance;
  int rounds = 2, threads = available_processors();
};

/// Elapsed time, and processor time of all threads, which other work on the machine affects less.
struct Seconds {
  double elapsed = 1e300, processor = 1e300;

  void take_less(const Seconds& other) {
    elapsed = std::min(elapsed, other.elapsed);
    processor = std::min(processor, other.processor);
  }
};

template <class Work>
Seconds seconds_of(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t processor = std::clock();
  work();
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
          static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC};
}

/// Returns the shortest time of some rounds.
template <class Work>
Seconds best_of(int rounds, const Work& work) {
  Seconds best = seconds_of(work);
  for (int k = 1; k < rounds; ++k) best.take_less(seconds_of(work));
  return best;
}

void measure_parts(const ShiftInvertProblem& problem) {
  fmt::print("  columns          {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8}\n", 1, 2, 4, 8, 16, 32, 64);
  std::string solutions, of_processors, products, of_processors_too;
  for (int columns = 1; columns <= 64; columns *= 2) {
    const Eigen::MatrixXd b = Eigen::MatrixXd::Random(problem.size, columns);
    const Seconds solution = best_of(6, [&] { problem.solve(b); });
    solutions += fmt::format(" {:8.3f}", solution.elapsed);
    of_processors += fmt::format(" {:8.3f}", solution.processor);
    const Seconds product = best_of(6, [&] { problem.multiply_mass(b); });
    products += fmt::format(" {:8.3f}", product.elapsed);
    of_processors_too += fmt::format(" {:8.3f}", product.processor);
  }
  fmt::print("  solution [s]     {}\n    processor time {}\n", solutions, of_processors);
  fmt::print("  mass product [s] {}\n    processor time {}\n", products, of_processors_too);
  std::fflush(stdout);
}

struct Run {
  std::string name;
  EigenpairOptions options{};
  Seconds seconds{};
  Eigenpairs pairs{};
};

void measure_methods(const ShiftInvertProblem& problem, int modes, const Settings& settings) {
  std::vector<Run> runs;
  if (!settings.no_arpack) {
    runs.push_back({"ARPACK", {}});
    runs.back().options.method = EigenMethod::arpack;
  }
  for (const int block : settings.blocks) {
    runs.push_back({block == 0 ? "block (default)" : fmt::format("block of {}", block), {}});
    runs.back().options.method = EigenMethod::block_lanczos;
    runs.back().options.block = block;
  }
  for (Run& run : runs) {
    run.options.threads = settings.threads;
    run.options.tolerance = settings.tolerance;
  }
  for (int round = 0; round < settings.rounds; ++round) {
    for (Run& run : runs) {
      run.seconds.take_less(seconds_of([&] { run.pairs = shift_invert_eigenpairs(problem, modes + 1, run.options); }));
      run.pairs.vectors.resize(0, 0);
    }
  }
  fmt::print(
      "  {:<24} elapsed [s]  of the first  processor [s]  of the first  sweeps  columns  restarts  residual  "
      "difference\n",
      fmt::format("{} modes and one more", modes));
  for (const Run& run : runs) {
    const Eigen::VectorXd& values = run.pairs.values;
    const Seconds& own = run.seconds;
    const Seconds& first = runs[0].seconds;
    fmt::print("    {:<22} {:11.2f} {:13.3f} {:14.2f} {:13.3f} {:7} {:8} {:9} {:9.1e} {:11.1e}\n", run.name,
               own.elapsed, own.elapsed / first.elapsed, own.processor, own.processor / first.processor,
               run.pairs.sweeps, run.pairs.solves, run.pairs.restarts, run.pairs.residuals.maxCoeff(),
               (values.array() / runs[0].pairs.values.array() - 1).abs().maxCoeff());
  }
  std::fflush(stdout);
}

void measure(double size, const Settings& settings) {
  BodyFile file = read_body_file(BIELLE_SOURCE_DIR "/meshes/conrod.yaml");
  file.mesh.size = 1e-3 * size;
  Progress progress(true);
  const Mesh mesh = import_mesh(file.mesh, progress);
  progress.finish();
  const Solid solid = make_solid(mesh, file.options.materials, file.options.regions);
  const Ties ties = make_ties(solid, file.options.interfaces);
  HeldFreedoms freedoms(solid, ties);
  const std::unique_ptr<BodyMatrices> matrices = assembled_matrices(solid, freedoms.interior(), settings.threads);
  const FixedInterfaceBody held(std::move(freedoms), solid, *matrices, ties, settings.threads);
  fmt::print("\n{} dofs, {:.0f} MB of factor, factorised in {:.2f} s ({:.1f} GFLOP/s)\n", held.size(),
             held.statistics().memory_MB(), held.statistics().factorisation_seconds, held.statistics().speed());
  const ShiftInvertProblem problem{held.size(), 0, [&](const Eigen::MatrixXd& b) { return held.solve(b); },
                                   [&](const Eigen::MatrixXd& z) { return held.inertia(*matrices, z); }};
  measure_parts(problem);
  for (const int modes : settings.modes) measure_methods(problem, modes, settings);
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  CLI::App app("Fixed-boundary modes of the connecting rod: block Lanczos against ARPACK");
  app.add_option("--size", settings.sizes, "element edges [mm]");
  app.add_option("--modes", settings.modes, "numbers of modes");
  app.add_option("--block", settings.blocks, "columns of a block; 0: the default");
  app.add_flag("--no-arpack", settings.no_arpack);
  app.add_option("--tolerance", settings.tolerance, "relative, of the iteration");
  app.add_option("--rounds", settings.rounds);
  app.add_option("--threads", settings.threads);
  CLI11_PARSE(app, argc, argv);
  fmt::print("{}, {} threads\n{}\n", blas_description(), settings.threads, blas_warning());
  for (const double size : settings.sizes) measure(size, settings);
}

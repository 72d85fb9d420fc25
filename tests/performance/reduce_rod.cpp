// The cost of the reduction of the connecting rod, phase by phase, compared with the speed of the same machine in the
// same run.
//
//   reduce_rod [SIZE_IN_MM ...]      element edges; default 4.6 2.8 2.05: about 50, 150 and 300 thousand dofs
//
// For each mesh: dofs, time of each phase, peak memory, the factorisation's speed against a product of dense matrices
// (dgemm), and the whole reduction (from the mesh to the superelement, meshing and writing aside) against the sum of
// 2.5 factorisations and 80 solutions with one right-hand side, and against 2.5 times one factorisation with its 80
// solutions. Nothing is asserted, since times depend on the machine.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "reduce/body_file/body_file.hpp"
#include "reduce/common/command_line.hpp"
#include "reduce/common/progress.hpp"
#include "reduce/dense/blas.hpp"
#include "reduce/mesh/import.hpp"
#include "reduce/reduction/fixed_interface_body.hpp"
#include "reduce/reduction/reduce_body.hpp"

namespace {

using namespace bielle;
using namespace bielle::reduce;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The basic operations: one factorisation of the body held at its interfaces, and single solutions.
struct Bare {
  FactorStatistics factor;
  double solutions = 0;  ///< 80 single solutions [s]
};

Bare measure_bare(const Mesh& mesh, const ReductionOptions& options, int threads) {
  const Solid solid = make_solid(mesh, options.materials, options.regions);
  const Ties ties = make_ties(solid, options.interfaces);
  HeldFreedoms freedoms(solid, ties);
  const std::unique_ptr<BodyMatrices> matrices = assembled_matrices(solid, freedoms.interior(), threads);
  const FixedInterfaceBody held(std::move(freedoms), solid, *matrices, ties, threads);
  Bare bare;
  bare.factor = held.statistics();
  Eigen::MatrixXd b = Eigen::MatrixXd::Ones(held.size(), 1);
  const auto start = std::chrono::steady_clock::now();
  for (int k = 0; k < 80; ++k) b = held.solve(b).normalized();
  bare.solutions = seconds_since(start);
  return bare;
}

void measure(double size, int threads) {
  BodyFile file = read_body_file(BIELLE_SOURCE_DIR "/meshes/conrod.yaml");
  file.mesh.size = size;
  Progress progress(true);
  const Mesh mesh = import_mesh(file.mesh, progress);
  progress.finish();
  const std::size_t meshing = progress.phases().size();
  // The system provides memory slowly when it is first touched, especially on a virtual machine, and the first
  // factorisation would include that time. A factorisation beforehand avoids this, and is shown next to the one that
  // counts.
  const Bare cold = measure_bare(mesh, file.options, threads);
  ReductionReport report;
  const auto start = std::chrono::steady_clock::now();
  reduce_body(mesh, file.options, progress, threads, &report);
  const double reduction = seconds_since(start);
  progress.finish();
  const Bare bare = measure_bare(mesh, file.options, threads);
  const double dgemm = measure_dgemm(2000, threads);

  fmt::print("\n{} dofs ({} points, {} tet10), {} modes\n", 3 * report.points, report.points, report.cells,
             file.options.modes.count.value_or(0));
  for (std::size_t k = 0; k < progress.phases().size(); ++k) {
    const PhaseReport& phase = progress.phases()[k];
    fmt::print("  {:<28} {:8.2f} s  {:6.0f} MB{}\n", phase.name, phase.seconds, phase.peak_memory_MB,
               k < meshing ? "  (meshing)" : "");
  }
  const double factor = bare.factor.seconds();
  fmt::print(
      "  bare factorisation           {:8.2f} s  ({:.2f} s of it numerical, {:.1f} GFLOP/s; dgemm {:.1f} GFLOP/s: "
      "{:.0f} %)\n",
      factor, bare.factor.factorisation_seconds, bare.factor.speed(), dgemm, 100 * bare.factor.speed() / dgemm);
  fmt::print("    the first, in fresh memory {:8.2f} s\n", cold.factor.seconds());
  fmt::print("  80 single solutions          {:8.2f} s  (the reduction made {} in {} sweeps)\n", bare.solutions,
             report.solves, report.sweeps);
  fmt::print("  reduction without meshing    {:8.2f} s\n", reduction);
  fmt::print("    over 2.5 x (factorisation) + 80 solutions    {:6.2f}\n", reduction / (2.5 * factor + bare.solutions));
  fmt::print("    over 2.5 x (factorisation + 80 solutions)    {:6.2f}\n",
             reduction / (2.5 * (factor + bare.solutions)));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const int threads = available_processors();
  fmt::print("{}, {} threads\n{}\n", blas_description(), threads, blas_warning());
  std::vector<double> sizes;
  for (int k = 1; k < argc; ++k) sizes.push_back(1e-3 * std::atof(argv[k]));
  if (sizes.empty()) sizes = {4.6e-3, 2.8e-3, 2.05e-3};
  for (const double size : sizes) measure(size, threads);
}

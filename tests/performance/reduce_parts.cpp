// The basic operations of a reduction, and its matrices for other programs.
//
//   reduce_parts BODY.yaml FOLDER
//
// Writes into the folder the data that compare_reduction gives to SLEPc and CalculiX: stiffness and mass of the points
// inside (lower triangles by columns: starts, rows as int64, values as float64), the first unknown of each point and
// then their number, points [m], cells (their nodes, from 0, as int64) and the numbers of tied points. Rigid ties hold
// all points of their surfaces. Average ties leave them free, and a reduction holds the remaining motions by a few
// supports, which are held here as well. Prints, as JSON, the speed of a dense product (dgemm), the bandwidth of
// reading memory, and time and size of the factorisation and of solutions with 1 and 12 columns, all from this run.
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "reduce/body_file/body_file.hpp"
#include "reduce/common/progress.hpp"
#include "reduce/dense/blas.hpp"
#include "reduce/fe/assembly.hpp"
#include "reduce/mesh/import.hpp"
#include "reduce/reduction/held_freedoms.hpp"
#include "reduce/reduction/ties.hpp"
#include "reduce/sparse/symmetric_factor.hpp"
#include "tests/performance/compared_program.hpp"

namespace {

using namespace bielle;
using namespace bielle::reduce;

using performance::best_seconds_of;

template <class Range>
void write(const std::string& name, const Range& values) {
  std::ofstream file(name, std::ios::binary);
  file.write(reinterpret_cast<const char*>(values.data()),
             static_cast<std::streamsize>(values.size() * sizeof(*values.data())));
}

void write(const std::string& name, const SymmetricMatrix& matrix) {
  write(name + ".starts", matrix.starts);
  write(name + ".rows", matrix.rows);
  write(name + ".values", matrix.values);
}

/// m (x) I3, lower triangle, with the pattern that it needs.
SymmetricMatrix three_fold(const NodeMatrix& mass) {
  SymmetricMatrix result;
  result.size = 3 * mass.graph->size();
  for (std::int64_t a = 0; a < mass.graph->size(); ++a) {
    for (int c = 0; c < 3; ++c) {
      for (std::int64_t p = mass.graph->starts[a]; p < mass.graph->starts[a + 1]; ++p) {
        if (mass.graph->neighbours[p] < a) continue;
        result.rows.push_back(3 * std::int64_t{mass.graph->neighbours[p]} + c);
        result.values.push_back(mass.values[p]);
      }
      result.starts.push_back(static_cast<std::int64_t>(result.rows.size()));
    }
  }
  return result;
}

/// Returns the bandwidth of reading [GB/s], the best of some rounds.
double measure_bandwidth(int threads) {
  const std::vector<double> numbers(std::size_t{1} << 27, 1.0);  // 1 GB
  const auto count = static_cast<std::int64_t>(numbers.size());
  double sum = 0;
  const double best = best_seconds_of([&] {
#pragma omp parallel for simd num_threads(threads) reduction(+ : sum)
    for (std::int64_t i = 0; i < count; ++i) sum += numbers[static_cast<std::size_t>(i)];
  });
  return sum > 0 ? 8e-9 * static_cast<double>(count) / best : 0;
}

double measure_solution(const SymmetricFactor& factor, int columns) {
  const Eigen::MatrixXd b = Eigen::MatrixXd::Random(factor.size(), columns);
  return best_seconds_of([&] { factor.solve(b); });
}

void run(const std::string& body, const std::string& folder, int threads) {
  const BodyFile file = read_body_file(body);
  Progress progress(true);
  const Mesh mesh = import_mesh(file.mesh, progress);
  const Solid solid = make_solid(mesh, file.options.materials, file.options.regions);
  // Other programs accept only one type of cell.
  const Eigen::MatrixXi& nodes = solid.cells.nodes_of(solid.cells.ranges().front());
  const Ties ties = make_ties(solid, file.options.interfaces);
  const std::vector<std::int64_t> kept = HeldFreedoms(solid, ties).interior().kept;
  std::vector<std::int64_t> starts, tied;
  for (std::size_t k = 0; k < kept.size(); ++k)
    if (k == 0 || kept[k] / 3 != kept[k - 1] / 3) starts.push_back(static_cast<std::int64_t>(k));
  starts.push_back(static_cast<std::int64_t>(kept.size()));
  for (std::int64_t a = 0; a < solid.points(); ++a)
    if (ties.tied[a]) tied.push_back(a);
  const NodeGraph graph = node_graph(solid.mesh, threads);
  const SymmetricMatrix stiffness = principal_submatrix(assemble_stiffness(solid, graph, threads), kept);
  write(folder + "/K", stiffness);
  write(folder + "/K.blocks", starts);
  write(folder + "/M", principal_submatrix(three_fold(assemble_mass(solid, graph, threads)), kept));
  write(folder + "/points", mesh.points);
  write(folder + "/cells", Eigen::Matrix<std::int64_t, -1, -1>(nodes.cast<std::int64_t>()));
  write(folder + "/tied", tied);

  SymmetricFactor(stiffness, starts, threads);  // the first one allocates new memory
  const SymmetricFactor factor(stiffness, starts, threads);
  const FactorStatistics& statistics = factor.statistics();
  fmt::print(
      "{{\"unknowns\": {}, \"nodes_of_a_cell\": {}, \"factor_numbers\": {}, \"gflop\": {}, \"numbers_s\": {}, "
      "\"ordering_s\": {}, \"analysis_s\": {}, \"dgemm\": {}, \"bandwidth\": {}, \"solution_1_s\": {}, "
      "\"solution_12_s\": {}}}\n",
      statistics.unknowns, nodes.rows(), statistics.nonzeros, 1e-9 * statistics.flops, statistics.factorisation_seconds,
      statistics.ordering_seconds, statistics.analysis_seconds, measure_dgemm(3000, threads),
      measure_bandwidth(threads), measure_solution(factor, 1), measure_solution(factor, 12));
}

}  // namespace

int main(int argc, char** argv) {
  return bielle::performance::run_with_two_arguments(argc, argv, "reduce_parts BODY.yaml FOLDER", run);
}

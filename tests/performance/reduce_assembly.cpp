// Assembly of stiffness and mass by type of cell.
//
//   reduce_assembly [UNKNOWNS [ROUNDS [CELL]]]
//
// Prints, for a distorted cube of about as many unknowns (100,000), the entries of K per unknown and the processor time
// of one thread per unknown [us] of stiffness and mass, each the least of some rounds. Nothing is asserted.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "reduce/dense/blas.hpp"
#include "reduce/fe/assembly.hpp"
#include "tests/performance/processor_time.hpp"
#include "tests/support/cell_box.hpp"

namespace {

using namespace bielle;
using namespace bielle::reduce;

/// Returns the processor time [us] per unknown, the least of some rounds.
template <class Work>
double microseconds_of(double unknowns, int rounds, const Work& work) {
  double least = 1e300;
  for (int round = 0; round < rounds; ++round) {
    const double start = performance::processor_seconds();
    work();
    least = std::min(least, performance::processor_seconds() - start);
  }
  return 1e6 * least / unknowns;
}

void measure(CellType type, double wanted, int rounds) {
  const Eigen::Vector3d size(1, 1, 1);
  const auto box = [&](int n) { return test::cell_box(type, size, {n, n, n}, test::distortion(size, 0.05)); };
  // Points grow with the third power of the number of bricks along an edge.
  const double few = 4, of_few = 3 * static_cast<double>(box(4).point_count());
  const Mesh mesh = box(std::max(1, static_cast<int>(few * std::cbrt(wanted / of_few))));
  const Solid solid = make_solid(mesh, {{"m", Material::isotropic(2.1e11, 0.3, 7850)}}, {{"all", "m"}});
  const NodeGraph graph = node_graph(mesh);
  const auto unknowns = 3 * static_cast<double>(mesh.point_count());
  double entries = 0;
  const double stiffness = microseconds_of(unknowns, rounds, [&] {
    entries = static_cast<double>(assemble_stiffness(solid, graph).values.size()) / unknowns;
  });
  const double mass = microseconds_of(unknowns, rounds, [&] { assemble_mass(solid, graph); });
  fmt::print("| {:<9} | {:8.0f} | {:7.0f} | {:9.2f} | {:4.2f} |\n", cell_name(type), unknowns, entries, stiffness,
             mass);
}

}  // namespace

int main(int argc, char** argv) {
  const double unknowns = argc > 1 ? std::atof(argv[1]) : 1e5;
  const int rounds = argc > 2 ? std::atoi(argv[2]) : 5;
  if (!(unknowns >= 100) || rounds < 1) {
    fmt::print(stderr, "reduce_assembly [UNKNOWNS [ROUNDS [CELL]]], at least 100 unknowns and 1 round\n");
    return 2;
  }
  fmt::print("{} {}\n| cell      | unknowns | entries | stiffness | mass |\n", blas_description(), blas_warning());
  for (const CellInfo& cell : cell_table())
    if (cell.dimension == 3 && (argc < 4 || cell.name == argv[3])) measure(cell.type, unknowns, rounds);
}

// The cost of fields of a superelement: frames recovered together, one by one, and searched for peaks, compared with
// the time for moving the same bytes in memory in the same run.
//
//   performance_mechanism_recovery [NODES] [FRAMES] [COORDINATES]      24000 60 32
//
// Elapsed times, the fastest of several rounds, with as many threads as OpenMP has (OMP_NUM_THREADS). Bytes are the
// minimum that must be moved: the recovery matrices once, and the fields. Bandwidth is that of a copy by the same
// threads, counting bytes read and written. With more than about ten coordinates the limit is not memory but
// multiplications, which are measured as a product of square matrices.
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <vector>

#include <fmt/format.h>
#include <omp.h>

#include "mechanism/elements/superelement/recovery/recovered_outputs.hpp"
#include "mechanism/elements/superelement/recovery/stress_peaks.hpp"
#include "reduce/dense/blas.hpp"

namespace {

using namespace bielle;
using namespace bielle::mechanism;

template <class Act>
double fastest(Act&& act) {
  constexpr int rounds = 7;
  double least = 1e30;
  for (int round = 0; round < rounds; ++round) {
    const auto begin = std::chrono::steady_clock::now();
    act();
    least = std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  return least;
}

Superelement body_of(int nodes, int coordinates) {
  Superelement body;
  body.name = "random";
  body.mesh.points = Eigen::Matrix3Xd::Random(3, nodes);
  body.displacement_recovery = Eigen::MatrixXd::Random(3 * nodes, coordinates);
  body.stress_recovery = Eigen::MatrixXd::Random(6 * nodes, coordinates);
  for (int k = 0; k < nodes; ++k) body.stress_nodes.push_back(k);
  return body;
}

/// Returns the bandwidth of a copy, bytes read and written [B/s].
double bandwidth(std::size_t numbers) {
  std::vector<double> from(numbers, 1.0), to(numbers, 0.0);
  const double time = fastest([&] {
#pragma omp parallel
    {
      const auto threads = static_cast<std::size_t>(omp_get_num_threads());
      const std::size_t begin = numbers * static_cast<std::size_t>(omp_get_thread_num()) / threads,
                        end = numbers * static_cast<std::size_t>(omp_get_thread_num() + 1) / threads;
      std::memcpy(to.data() + begin, from.data() + begin, (end - begin) * sizeof(double));
    }
  });
  return 2.0 * static_cast<double>(numbers) * sizeof(double) / time;
}

void measure(int nodes, int frames, int coordinates) {
  const Superelement body = body_of(nodes, coordinates);
  RecoveredOutputs outputs;
  outputs.add_field("displacement", body);
  outputs.add_field("stress", body);
  const std::size_t row = 9 * static_cast<std::size_t>(nodes);
  std::vector<double> values(row * static_cast<std::size_t>(frames));
  const Eigen::MatrixXd q = Eigen::MatrixXd::Random(coordinates, frames);
  std::vector<double*> rows;
  for (int k = 0; k < frames; ++k) rows.push_back(values.data() + row * static_cast<std::size_t>(k));
  FrameBlock block;
  const auto together = [&] {
    block.reset(coordinates, frames);
    for (int k = 0; k < frames; ++k) block.set(k, q.col(k).data());
    outputs.write(block, rows, 0);
  };
  const auto one_by_one = [&] {
    for (int k = 0; k < frames; ++k) {
      block.reset(coordinates, 1);
      block.set(0, q.col(k).data());
      outputs.write(block, {&rows[static_cast<std::size_t>(k)], 1}, 0);
    }
  };
  int next = 0;
  const auto stress = std::make_shared<const StressRecovery>(body);
  StressPeaks peaks("random", stress, StressPeaks::names(), [&](const LocalState&, double* to) {
    std::copy_n(q.col(next).data(), coordinates, to);
    next = (next + 1) % frames;
  });
  const State state;
  const Slots slots;
  const Environment environment;
  const auto look = [&] {
    peaks.begin();
    for (int k = 0; k < frames; ++k) peaks.add(LocalState(state, slots, environment));
    peaks.results();
  };
  const double copy = bandwidth(row * static_cast<std::size_t>(frames) / 2);
  const double matrices = 9.0 * nodes * coordinates * sizeof(double), fields = static_cast<double>(row) * frames * 8;
  const double least = (matrices + fields) / copy;
  const double blocked = fastest(together), single = fastest(one_by_one), peak = fastest(look);
  const double operations = 2.0 * static_cast<double>(row) * coordinates * frames;
  fmt::print("{} nodes, {} coordinates, {} frames, {}: {:.0f} MB of matrices, {:.0f} MB of fields; copy {:.1f} GB/s\n",
             nodes, coordinates, frames, fmt::format("{} threads", omp_get_max_threads()), matrices / 1e6, fields / 1e6,
             copy / 1e9);
  fmt::print("bytes over bandwidth       {:8.1f} ms\n", 1e3 * least);
  const double dgemm = 1e9 * measure_dgemm(600, omp_get_max_threads());
  fmt::print("operations at dgemm speed  {:8.1f} ms ({:.0f} GFLOP/s)\n", 1e3 * operations / dgemm, dgemm / 1e9);
  fmt::print("frames together            {:8.1f} ms, {:.2f} times the larger of both\n", 1e3 * blocked,
             blocked / std::max(least, operations / dgemm));
  fmt::print("frames one by one          {:8.1f} ms, {:.2f} times as long as together\n", 1e3 * single,
             single / blocked);
  fmt::print("peaks of the same frames   {:8.1f} ms, {:.2f} ms each\n", 1e3 * peak, 1e3 * peak / frames);
}

}  // namespace

int main(int count, char** words) {
  const auto argument = [&](int k, int otherwise) { return count > k ? std::atoi(words[k]) : otherwise; };
  measure(argument(1, 24000), argument(2, 60), argument(3, 32));
}

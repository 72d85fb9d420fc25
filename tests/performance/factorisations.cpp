// One factorisation of one library, for compare_factorisations.
//
//   factorisations bielle|cholmod|eigen|spooles FOLDER
//
// Reads the stiffness K that reduce_parts has written into the folder and prints, as JSON: seconds of order and
// structure, of the numbers in memory that the process has not had yet and again, flops, numbers kept, the most memory
// that it took to the end of the first numbers beyond the matrix that it was given [GB], seconds of solutions with 1, 8
// and 20 columns (the best of some), and |K x - b| / |b|. What is not built in prints null.
#include <algorithm>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "tests/performance/compared_program.hpp"
#include "tests/performance/measured_factor.hpp"

namespace {

using namespace bielle;

using performance::best_seconds_of;
using performance::seconds_of;

template <class Number>
std::vector<Number> read(const std::string& name) {
  std::ifstream file(name, std::ios::binary | std::ios::ate);
  if (!file) throw std::runtime_error(fmt::format("there is no file {}", name));
  std::vector<Number> numbers(static_cast<std::size_t>(file.tellg()) / sizeof(Number));
  file.seekg(0);
  file.read(reinterpret_cast<char*>(numbers.data()), static_cast<std::streamsize>(numbers.size() * sizeof(Number)));
  return numbers;
}

/// Of this process, in GB. @param key  "VmRSS:" now, "VmHWM:" the most since `forget_peak`
double memory(const std::string& key) {
  std::ifstream file("/proc/self/status");
  std::string word;
  while (file >> word)
    if (word == key) {
      double kilobytes = 0;
      file >> kilobytes;
      return 1024e-9 * kilobytes;
    }
  return 0;
}

void forget_peak() { std::ofstream("/proc/self/clear_refs") << "5"; }

std::unique_ptr<MeasuredFactor> factor_of(const std::string& method, const FactorRequest& request) {
  const std::map<std::string, std::unique_ptr<MeasuredFactor> (*)(const FactorRequest&)> methods{
      {"bielle", measured_bielle},
      {"cholmod", measured_cholmod},
      {"eigen", measured_eigen},
      {"spooles", measured_spooles}};
  return methods.at(method)(request);
}

void run(const std::string& method, const std::string& folder, int threads) {
  SymmetricMatrix matrix;
  matrix.starts = read<std::int64_t>(folder + "/K.starts");
  matrix.rows = read<std::int64_t>(folder + "/K.rows");
  matrix.values = read<double>(folder + "/K.values");
  matrix.size = static_cast<std::int64_t>(matrix.starts.size()) - 1;
  const std::vector<std::int64_t> blocks = read<std::int64_t>(folder + "/K.blocks");
  const std::unique_ptr<MeasuredFactor> factor = factor_of(method, {matrix, blocks, threads});
  if (!factor) {
    fmt::print("null\n");
    return;
  }
  forget_peak();
  const double before = memory("VmRSS:");
  const double analysis = seconds_of([&] { factor->analyse(); });
  const double fresh = seconds_of([&] { factor->factorise(); });
  const double peak = memory("VmHWM:") - before;
  constexpr double long_enough = 20;  // seconds
  const double again = fresh > long_enough ? fresh : seconds_of([&] { factor->factorise(); });
  std::string solutions;
  double error = 0;
  for (const int columns : {1, 8, 20}) {
    const Eigen::MatrixXd b = Eigen::MatrixXd::Random(matrix.size, columns);
    Eigen::MatrixXd x;
    const double best = best_seconds_of([&] { x = factor->solve(b); });
    solutions += fmt::format("{}\"{}\": {}", solutions.empty() ? "" : ", ", columns, best);
    error = std::max(error, (matrix.multiply(x) - b).norm() / b.norm());
  }
  fmt::print(
      "{{\"analysis\": {}, \"fresh\": {}, \"again\": {}, \"flops\": {}, \"stored\": {}, \"peak\": {}, \"solutions\": "
      "{{{}}}, \"error\": {}}}\n",
      analysis, fresh, again, factor->flops(), factor->stored(), peak, solutions, error);
}

}  // namespace

int main(int argc, char** argv) {
  return bielle::performance::run_with_two_arguments(argc, argv, "factorisations bielle|cholmod|eigen|spooles FOLDER",
                                                     run);
}

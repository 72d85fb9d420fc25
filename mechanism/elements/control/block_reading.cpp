#include "mechanism/elements/control/block_reading.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace bielle::mechanism {
namespace {

/// Reads coefficients in descending powers; leading zeros are removed.
std::vector<double> read_coefficients(const YamlValue& list, const std::string& variable) {
  const VectorX all = list.vector();
  std::vector<double> coefficients(all.begin(), all.end());
  const auto first = std::find_if(coefficients.begin(), coefficients.end(), [](double each) { return each != 0; });
  coefficients.erase(coefficients.begin(), first);
  if (coefficients.empty())
    list.fail(fmt::format("expected coefficients in descending powers of {}, not all of them zero", variable));
  return coefficients;
}

}  // namespace

LinearBlock read_quotient(const YamlValue& function, const std::string& variable, const std::string& so_rises) {
  const std::vector<double> numerator = read_coefficients(function.at("numerator"), variable),
                            denominator = read_coefficients(function.at("denominator"), variable);
  if (denominator.size() < 2)
    function.at("denominator")
        .fail(
            fmt::format("has no power of {}: what is proportional to its input is a formula of `measures`", variable));
  if (numerator.size() > denominator.size())
    function.at("numerator")
        .fail(fmt::format("its degree, {}, exceeds that of the denominator, {}: {}", numerator.size() - 1,
                          denominator.size() - 1, so_rises));
  return realisation(numerator, denominator);
}

LinearBlock read_matrices(const YamlValue& matrices, Eigen::Index inputs) {
  const auto n = static_cast<Eigen::Index>(matrices.at("A").size());
  if (n == 0) matrices.at("A").fail("expected a square matrix, row by row");
  LinearBlock block;
  block.A = matrices.at("A").matrix(n, n);
  block.B = matrices.at("B").matrix(n, inputs);
  const auto C = matrices.find("C"), D = matrices.find("D");
  const auto outputs = C ? static_cast<Eigen::Index>(C->size()) : n;
  block.C = C ? MatrixX(C->matrix(outputs, n)) : MatrixX(MatrixX::Identity(n, n));
  if (outputs == 0) C->fail("expected at least one row, an output");
  block.D = D ? MatrixX(D->matrix(outputs, inputs)) : MatrixX(MatrixX::Zero(outputs, inputs));
  return block;
}

std::string name_of_output(const std::string& name, Eigen::Index outputs, Eigen::Index k) {
  return outputs == 1 ? name : fmt::format("{}.y{}", name, k + 1);
}

std::vector<std::string> read_block_units(const YamlValue& units, std::size_t recorded) {
  if (!units.is_sequence()) return {units.text()};
  std::vector<std::string> list;
  for (const YamlValue& each : units.items()) list.push_back(each.text());
  if (list.size() != recorded)
    units.fail(fmt::format("expected {}, one for each output, found {}", recorded, list.size()));
  return list;
}

}  // namespace bielle::mechanism

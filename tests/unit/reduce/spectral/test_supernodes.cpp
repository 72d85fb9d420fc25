#include <algorithm>
#include <numeric>
#include <set>
#include <vector>

#include <catch2/catch.hpp>

#include "reduce/spectral/bordered_part.hpp"
#include "reduce/spectral/factor_structure.hpp"
#include "reduce/spectral/fill_reducing_order.hpp"
#include "reduce/spectral/supernodes.hpp"
#include "reduce/spectral/symmetric_factor.hpp"
#include "tests/unit/reduce/spectral/laplacian.hpp"

using namespace bielle;

namespace {

/// A grid whose points have 1, 2 or 3 unknowns, or 3 each, all coupled with those of their neighbours.
BlockGraph grid_of_blocks(std::array<int, 3> n, bool equal) {
  BlockGraph graph = block_graph(test::grid_laplacian(n), {});
  for (int b = 0; b < graph.size(); ++b) graph.first[b + 1] = graph.first[b] + (equal ? 3 : 1 + b * 7 % 3);
  return graph;
}

/// Every unknown by itself.
BlockGraph of_unknowns(const BlockGraph& blocks) {
  BlockGraph graph;
  for (int b = 0; b < blocks.size(); ++b) {
    for (std::int64_t i = blocks.first[b]; i < blocks.first[b + 1]; ++i) {
      for (int p = blocks.starts[b]; p < blocks.starts[b + 1]; ++p)
        for (std::int64_t j = std::max(i, blocks.first[blocks.rows[p]]); j < blocks.first[blocks.rows[p] + 1]; ++j)
          graph.rows.push_back(static_cast<int>(j));
      graph.starts.push_back(static_cast<int>(graph.rows.size()));
      graph.first.push_back(i + 1);
    }
  }
  return graph;
}

/// Rows of each column of L, by eliminating one unknown after the other: those of a column get coupled.
std::vector<std::set<std::int64_t>> eliminated(const BlockGraph& unknowns, const std::vector<std::int64_t>& order) {
  std::vector<std::int64_t> place(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) place[order[k]] = static_cast<std::int64_t>(k);
  std::vector<std::set<std::int64_t>> columns(order.size());
  for (int j = 0; j < unknowns.size(); ++j)
    for (int p = unknowns.starts[j]; p < unknowns.starts[j + 1]; ++p) {
      const std::int64_t a = place[j], b = place[unknowns.rows[p]];
      columns[std::min(a, b)].insert(std::max(a, b));
    }
  for (std::size_t k = 0; k < columns.size(); ++k)
    if (columns[k].size() > 1) {
      const std::int64_t next = *std::next(columns[k].begin());
      columns[next].insert(std::next(columns[k].begin()), columns[k].end());
    }
  return columns;
}

void check_holds(const Supernodes& found, const std::vector<std::set<std::int64_t>>& columns) {
  std::int64_t nonzeros = 0;
  double flops = 0;
  for (const auto& column : columns) {
    nonzeros += static_cast<std::int64_t>(column.size());
    flops += static_cast<double>(column.size() * column.size());
  }
  CHECK(found.nonzeros == nonzeros);
  CHECK(found.flops == flops);
  REQUIRE(found.columns.back() == static_cast<std::int64_t>(columns.size()));
  for (std::size_t s = 0; s + 1 < found.columns.size(); ++s) {
    const auto first = found.rows.begin() + found.row_starts[s], end = found.rows.begin() + found.row_starts[s + 1];
    REQUIRE(std::is_sorted(first, end));
    for (std::int64_t j = found.columns[s]; j < found.columns[s + 1]; ++j) {
      REQUIRE(first[j - found.columns[s]] == j);
      REQUIRE(std::includes(first, end, columns[j].begin(), columns[j].end()));
    }
    REQUIRE(found.value_starts[s + 1] - found.value_starts[s] ==
            (end - first) * (found.columns[s + 1] - found.columns[s]));
  }
}

}  // namespace

TEST_CASE("supernodes: found on blocks, they hold what elimination of the unknowns gives", "[spectral]") {
  for (const auto& n : {std::array{60, 1, 1}, std::array{13, 11, 1}, std::array{7, 6, 5}, std::array{2, 1, 1}}) {
    for (const bool equal : {true, false}) {
      const BlockGraph graph = grid_of_blocks(n, equal);
      const std::vector<int> order = fill_reducing_order(graph);
      for (const bool merged : {false, true}) {
        CAPTURE(n, equal, merged);
        const Supernodes found = find_supernodes(graph, order, merged);
        std::vector<std::int64_t> sorted = found.order;
        std::sort(sorted.begin(), sorted.end());
        std::vector<std::int64_t> all(sorted.size());
        std::iota(all.begin(), all.end(), 0);
        REQUIRE(sorted == all);
        check_holds(found, eliminated(of_unknowns(graph), found.order));
        // Fundamental supernodes hold nothing else below the diagonal.
        std::int64_t stored = 0;
        for (std::size_t s = 0; s + 1 < found.columns.size(); ++s) {
          const std::int64_t width = found.columns[s + 1] - found.columns[s];
          stored += found.value_starts[s + 1] - found.value_starts[s] - width * (width - 1) / 2;
        }
        CHECK((merged ? stored >= found.nonzeros : stored == found.nonzeros));
      }
    }
  }
}

TEST_CASE("supernodes: those of blocks are those of their unknowns", "[spectral]") {
  const BlockGraph graph = grid_of_blocks({12, 11, 10}, false);
  const std::vector<int> order = fill_reducing_order(graph);
  std::vector<int> of_each;
  for (const int b : order)
    for (std::int64_t i = graph.first[b]; i < graph.first[b + 1]; ++i) of_each.push_back(static_cast<int>(i));
  for (const bool merged : {false, true}) {
    const Supernodes blocks = find_supernodes(graph, order, merged);
    const Supernodes unknowns = find_supernodes(of_unknowns(graph), of_each, merged);
    CHECK(blocks.order == unknowns.order);
    CHECK(blocks.columns == unknowns.columns);
    CHECK(blocks.rows == unknowns.rows);
    CHECK(blocks.value_starts == unknowns.value_starts);
    CHECK(blocks.nonzeros == unknowns.nonzeros);
    CHECK(blocks.flops == unknowns.flops);
  }
}

TEST_CASE("A part of a matrix with a border is factorised as its copy is", "[spectral]") {
  const SymmetricMatrix whole = test::grid_laplacian({12, 11, 10});
  std::vector<std::int64_t> kept;
  for (std::int64_t k = 0; k < whole.size; ++k)
    if (k % 7 != 3) kept.push_back(k);
  const auto count = static_cast<Eigen::Index>(kept.size());
  Eigen::MatrixXd border = Eigen::MatrixXd::Zero(count, 2);
  border.block(5, 0, 40, 1).setConstant(0.1);
  border.block(30, 1, 60, 1).setConstant(-0.05);
  const Eigen::MatrixXd corner = (Eigen::Matrix2d() << 9, 1, 1, 8).finished();
  const SymmetricMatrix copy = bordered(principal_submatrix(whole, kept), border, corner);
  const Eigen::MatrixXd b = Eigen::MatrixXd::Random(copy.size, 3);
  const auto structure = std::make_shared<const FactorStructure>(block_graph(copy, {}));
  for (const int threads : {1, 2, 3}) {
    const SymmetricFactor part({whole, kept, border, corner}, structure, threads);
    const Eigen::MatrixXd x = part.solve(b);
    CHECK(x == SymmetricFactor(copy, {}, threads).solve(b));
    CHECK((Eigen::MatrixXd(copy.multiply(x)) - b).norm() < 1e-12 * b.norm());
    CHECK(part.statistics().nonzeros == structure->nonzeros());
  }
  SymmetricMatrix bad = whole;
  bad.values[static_cast<std::size_t>(bad.starts[static_cast<std::size_t>(kept[17])])] = -1;
  try {
    SymmetricFactor({bad, kept, border, corner}, structure, 2);
    FAIL("accepted");
  } catch (const NotPositiveDefinite& error) {
    CHECK(error.unknown() == 17);
  }
}

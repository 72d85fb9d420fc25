#include "mechanism/math/condensed.hpp"

#include <algorithm>
#include <cmath>

#include "reduce/dense/dense_solves.hpp"

namespace bielle::mechanism {
namespace {

/// Returns the pattern by rows: column numbers of each row.
SparsePattern transposed(const SparsePattern& pattern) {
  std::vector<int> start(static_cast<std::size_t>(pattern.size()) + 1, 0);
  for (const int row : pattern.row()) ++start[static_cast<std::size_t>(row) + 1];
  for (std::size_t k = 1; k < start.size(); ++k) start[k] += start[k - 1];
  std::vector<int> column(pattern.row().size()), next(start.begin(), start.end() - 1);
  pattern.for_each([&](int, int row, int of_column) {
    column[static_cast<std::size_t>(next[static_cast<std::size_t>(row)]++)] = of_column;
  });
  return SparsePattern(std::move(start), std::move(column));
}

/// Copies the values at the given places, zero for a place of -1.
void gather(const std::vector<int>& places, const std::vector<double>& values, MatrixX& to) {
  double* each = to.data();
  for (const int place : places) *each++ = place >= 0 ? values[static_cast<std::size_t>(place)] : 0.0;
}

}  // namespace

CondensedPattern::CondensedPattern(const SparsePattern& whole, const std::vector<std::vector<int>>& candidates)
    : whole_(&whole) {
  choose_blocks(candidates);
  if (!blocks_.empty()) build_rest();
}

void CondensedPattern::choose_blocks(const std::vector<std::vector<int>>& candidates) {
  const auto large = [](const std::vector<int>& inner) {
    return inner.size() >= static_cast<std::size_t>(least_block);
  };
  if (std::none_of(candidates.begin(), candidates.end(), large)) return;
  const SparsePattern rows = transposed(*whole_);
  std::vector<char> taken(static_cast<std::size_t>(whole_->size()), 0);
  for (const std::vector<int>& inner : candidates)
    if (large(inner)) add_block(inner, rows, taken);
}

/// @param taken  unknowns of blocks, and unknowns that couple to them
bool CondensedPattern::add_block(const std::vector<int>& inner, const SparsePattern& rows, std::vector<char>& taken) {
  constexpr char in_block = 1, coupled = 2;
  const auto mark = [&](int unknown) -> char& { return taken[static_cast<std::size_t>(unknown)]; };
  for (const int unknown : inner)
    if (mark(unknown) != 0) return false;
  for (const int unknown : inner) mark(unknown) = in_block;
  Block block{inner, {}, {}, {}, {}, {}};
  std::size_t own = 0;
  bool alone = true;
  for (const SparsePattern* each : {whole_, &rows})
    for (const int unknown : inner)
      for (int k = each->column_start()[static_cast<std::size_t>(unknown)];
           k < each->column_start()[static_cast<std::size_t>(unknown) + 1]; ++k) {
        const int other = each->row()[static_cast<std::size_t>(k)];
        if (std::binary_search(inner.begin(), inner.end(), other))
          ++own;
        else if (mark(other) == in_block)
          alone = false;
        else
          block.outer.push_back(other);
      }
  // Entries were counted twice, by columns and by rows. A sparse block is not treated as dense.
  const bool dense = own >= inner.size() * inner.size();
  if (!alone || !dense) {
    for (const int unknown : inner) mark(unknown) = 0;
    return false;
  }
  std::sort(block.outer.begin(), block.outer.end());
  block.outer.erase(std::unique(block.outer.begin(), block.outer.end()), block.outer.end());
  for (const int unknown : block.outer) mark(unknown) = coupled;
  blocks_.push_back(std::move(block));
  return true;
}

void CondensedPattern::build_rest() {
  number_in_rest_.assign(static_cast<std::size_t>(whole_->size()), 0);
  for (const Block& block : blocks_)
    for (const int unknown : block.inner) number_in_rest_[static_cast<std::size_t>(unknown)] = -1;
  for (int unknown = 0; unknown < whole_->size(); ++unknown) {
    int& number = number_in_rest_[static_cast<std::size_t>(unknown)];
    if (number < 0) continue;
    number = static_cast<int>(kept_.size());
    kept_.push_back(unknown);
  }
  const auto number = [&](int unknown) { return number_in_rest_[static_cast<std::size_t>(unknown)]; };
  std::vector<std::pair<int, int>> entries;
  whole_->for_each([&](int, int row, int column) {
    if (number(row) >= 0 && number(column) >= 0) entries.emplace_back(number(row), number(column));
  });
  for (const Block& block : blocks_)
    for (const int column : block.outer)
      for (const int row : block.outer) entries.emplace_back(number(row), number(column));
  rest_ = SparsePattern(static_cast<int>(kept_.size()), std::move(entries));
  rest_from_.assign(static_cast<std::size_t>(rest_.entry_count()), -1);
  whole_->for_each([&](int place, int row, int column) {
    if (number(row) >= 0 && number(column) >= 0)
      rest_from_[static_cast<std::size_t>(rest_.find(number(row), number(column)))] = place;
  });
  std::vector<int> intermittent;
  for (int place = 0; place < rest_.entry_count(); ++place)
    if (const int from = rest_from_[static_cast<std::size_t>(place)];
        from >= 0 && std::binary_search(whole_->intermittent().begin(), whole_->intermittent().end(), from))
      intermittent.push_back(place);
  rest_.set_intermittent(std::move(intermittent));
  for (Block& block : blocks_) find_places(block);
}

void CondensedPattern::find_places(Block& block) const {
  const auto find_all = [](const SparsePattern& pattern, const std::vector<int>& rows,
                           const std::vector<int>& columns) {
    std::vector<int> places;
    places.reserve(rows.size() * columns.size());
    for (const int column : columns)
      for (const int row : rows) places.push_back(pattern.find(row, column));
    return places;
  };
  block.inner_place = find_all(*whole_, block.inner, block.inner);
  block.right_place = find_all(*whole_, block.inner, block.outer);
  block.below_place = find_all(*whole_, block.outer, block.inner);
  for (int& unknown : block.outer) unknown = number_in_rest_[static_cast<std::size_t>(unknown)];
  block.rest_place = find_all(rest_, block.outer, block.outer);
}

/// Factors of one block, and its contribution to the Schur complement.
struct CondensedLU::Block {
  const CondensedPattern::Block* pattern;
  LUFactors lu;          ///< LU factors of R A_aa
  VectorX row_scale;     ///< R: scales rows to a largest entry of one, for any units
  MatrixX inner, right;  ///< R A_aa, R A_ab
  MatrixX below;         ///< A_ba
  MatrixX solved;        ///< A_aa^-1 A_ab
  MatrixX change;        ///< A_ba A_aa^-1 A_ab
  VectorX row_floor;     ///< largest entry of the outer rows of A
  double condition = 0;  ///< ratio of smallest to largest pivot
  bool good = false;
  mutable VectorX part;  ///< block's part of a right-hand side
  mutable VectorX permuted, outside;

  explicit Block(const CondensedPattern::Block& of) : pattern(&of) {
    const auto m = static_cast<Eigen::Index>(of.inner.size()), n = static_cast<Eigen::Index>(of.outer.size());
    inner.resize(m, m);
    right.resize(m, n);
    solved.resize(m, n);
    below.resize(n, m);
    change.resize(n, n);
    for (VectorX* vector : {&row_scale, &part, &permuted}) vector->resize(m);
    for (VectorX* vector : {&row_floor, &outside}) vector->resize(n);
  }
  void factor(const std::vector<double>& values, const std::vector<double>& rest_values, const VectorX& rest_scale);
  void set_row_floor(const std::vector<double>& rest_values, const VectorX& rest_scale);
  bool harmless(const VectorX& rest_scale) const;
};

void CondensedLU::Block::factor(const std::vector<double>& values, const std::vector<double>& rest_values,
                                const VectorX& rest_scale) {
  gather(pattern->inner_place, values, inner);
  gather(pattern->right_place, values, right);
  gather(pattern->below_place, values, below);
  good = false;
  row_scale = inner.cwiseAbs().rowwise().maxCoeff();
  for (Eigen::Index j = 0; j < right.cols(); ++j)
    row_scale = row_scale.cwiseMax(rest_scale[pattern->outer[static_cast<std::size_t>(j)]] * right.col(j).cwiseAbs());
  if (!(row_scale.minCoeff() > 0)) return;
  row_scale = row_scale.cwiseInverse();
  inner.array().colwise() *= row_scale.array();
  right.array().colwise() *= row_scale.array();
  lu.compute(inner);
  const double least = lu.pivots().cwiseAbs().minCoeff(), most = lu.pivots().cwiseAbs().maxCoeff();
  if (!(least > 0) || !std::isfinite(most)) return;
  condition = least / most;
  lu.solve(right, solved);
  change.noalias() = below * solved;
  set_row_floor(rest_values, rest_scale);
  good = harmless(rest_scale);
}

void CondensedLU::Block::set_row_floor(const std::vector<double>& rest_values, const VectorX& rest_scale) {
  row_floor = below.cwiseAbs().rowwise().maxCoeff();
  const int* place = pattern->rest_place.data();
  for (Eigen::Index j = 0; j < change.cols(); ++j) {
    const double scale = rest_scale[pattern->outer[static_cast<std::size_t>(j)]];
    for (Eigen::Index i = 0; i < change.rows(); ++i)
      row_floor[i] = std::max(row_floor[i], scale * std::abs(rest_values[static_cast<std::size_t>(*place++)]));
  }
}

/// Returns whether entries have grown so little that rounding errors of the pivots are negligible.
bool CondensedLU::Block::harmless(const VectorX& rest_scale) const {
  constexpr double most_growth = 1e4;
  for (Eigen::Index j = 0; j < change.cols(); ++j) {
    const double scale = rest_scale[pattern->outer[static_cast<std::size_t>(j)]];
    for (Eigen::Index i = 0; i < change.rows(); ++i)
      if (!(scale * std::abs(change(i, j)) <= most_growth * row_floor[i])) return false;
  }
  return true;
}

CondensedLU::CondensedLU(const CondensedPattern& pattern)
    : pattern_(pattern), whole_(pattern.whole()), rest_(pattern.rest()) {
  if (pattern.blocks().empty()) return;
  for (const CondensedPattern::Block& block : pattern.blocks()) blocks_.emplace_back(block);
  rest_values_.resize(static_cast<std::size_t>(pattern.rest().entry_count()));
  for (VectorX* vector : {&rest_scale_, &row_floor_, &rest_vector_}) vector->resize(pattern.rest().size());
}
CondensedLU::CondensedLU(CondensedLU&&) noexcept = default;
CondensedLU::~CondensedLU() = default;

FactorStatus CondensedLU::factor(const std::vector<double>& values, const VectorX& scale, Workers& workers) {
  condensed_ = !blocks_.empty() && condense(values, scale, workers);
  // If the blocks cannot be eliminated, the whole matrix is factorised. It may have pivots elsewhere; otherwise the
  // unknown without a pivot is reported.
  return condensed_ ? FactorStatus::good : whole_.factor(values, scale);
}

bool CondensedLU::condense(const std::vector<double>& values, const VectorX& scale, Workers& workers) {
  for (std::size_t k = 0; k < rest_values_.size(); ++k) {
    const int place = pattern_.rest_from()[k];
    rest_values_[k] = place >= 0 ? values[static_cast<std::size_t>(place)] : 0.0;
  }
  for (std::size_t k = 0; k < pattern_.kept().size(); ++k)
    rest_scale_[static_cast<Eigen::Index>(k)] = scale[pattern_.kept()[k]];
  workers.for_each(blocks_.size(), [&](std::size_t k) { blocks_[k].factor(values, rest_values_, rest_scale_); });
  row_floor_.setZero();
  for (const Block& block : blocks_) {
    if (!block.good) return false;
    const double* change = block.change.data();
    for (const int place : block.pattern->rest_place) rest_values_[static_cast<std::size_t>(place)] -= *change++;
    for (Eigen::Index i = 0; i < block.row_floor.size(); ++i) {
      const int row = block.pattern->outer[static_cast<std::size_t>(i)];
      row_floor_[row] = std::max(row_floor_[row], rest_scale_[row] * block.row_floor[i]);
    }
  }
  return rest_.factor(rest_values_, rest_scale_, &row_floor_) == FactorStatus::good;
}

void CondensedLU::forget() {
  whole_.forget();
  rest_.forget();
}

void CondensedLU::solve(Eigen::Ref<VectorX> b) const {
  if (!condensed_) {
    whole_.solve(b);
    return;
  }
  for (std::size_t k = 0; k < pattern_.kept().size(); ++k)
    rest_vector_[static_cast<Eigen::Index>(k)] = b[pattern_.kept()[k]];
  for (const Block& block : blocks_) {
    for (Eigen::Index i = 0; i < block.permuted.size(); ++i)
      block.permuted[i] = block.row_scale[i] * b[block.pattern->inner[static_cast<std::size_t>(i)]];
    block.lu.solve(block.permuted, block.part);
    block.outside.noalias() = block.below * block.part;
    for (Eigen::Index i = 0; i < block.outside.size(); ++i)
      rest_vector_[block.pattern->outer[static_cast<std::size_t>(i)]] -= block.outside[i];
  }
  rest_.solve(rest_vector_);
  for (std::size_t k = 0; k < pattern_.kept().size(); ++k)
    b[pattern_.kept()[k]] = rest_vector_[static_cast<Eigen::Index>(k)];
  for (const Block& block : blocks_) {
    for (Eigen::Index i = 0; i < block.outside.size(); ++i)
      block.outside[i] = rest_vector_[block.pattern->outer[static_cast<std::size_t>(i)]];
    block.part.noalias() -= block.solved * block.outside;
    for (Eigen::Index i = 0; i < block.part.size(); ++i)
      b[block.pattern->inner[static_cast<std::size_t>(i)]] = block.part[i];
  }
}

FactorCost CondensedLU::cost() const {
  if (!condensed_) return whole_.cost();
  FactorCost cost = rest_.cost();
  for (const Block& block : blocks_) {
    const auto m = static_cast<double>(block.below.cols()), n = static_cast<double>(block.below.rows());
    cost.dense_operations += 2 * m * (m * m / 3 + m * n + n * n);
    cost.dense_entries += m * (m + 2 * n);
  }
  return cost;
}

int CondensedLU::singular_column() const { return condensed_ ? -1 : whole_.singular_column(); }

int CondensedLU::determinant_sign() const {
  if (!condensed_) return whole_.determinant_sign();
  int sign = rest_.determinant_sign();
  for (const Block& block : blocks_) sign *= block.lu.sign();
  return sign;
}

double CondensedLU::reciprocal_condition() const {
  if (!condensed_) return whole_.reciprocal_condition();
  double least = rest_.reciprocal_condition();
  for (const Block& block : blocks_) least = std::min(least, block.condition);
  return least;
}

}  // namespace bielle::mechanism

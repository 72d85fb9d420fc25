#include "reduce/spectral/bordered_structure.hpp"

namespace bielle {

BorderedStructure::BorderedStructure(const SupernodalFactor& inner, std::int64_t border) : structure_(inner) {
  if (border == 0) return;
  const auto end_supernode = [&] {
    for (std::int64_t k = 0; k < border; ++k) rows_.push_back(inner.size + k);
    row_starts_.push_back(static_cast<std::int64_t>(rows_.size()));
    const std::int64_t rows = row_starts_.back() - row_starts_[row_starts_.size() - 2];
    value_starts_.push_back(value_starts_.back() + rows * (columns_.back() - columns_[columns_.size() - 2]));
  };
  columns_ = row_starts_ = value_starts_ = {0};
  rows_.reserve(static_cast<std::size_t>(inner.row_starts[inner.supernodes] + (inner.supernodes + 1) * border));
  for (std::int64_t s = 0; s < inner.supernodes; ++s) {
    columns_.push_back(inner.columns[s + 1]);
    rows_.insert(rows_.end(), inner.rows + inner.row_starts[s], inner.rows + inner.row_starts[s + 1]);
    end_supernode();
  }
  columns_.push_back(inner.size + border);
  end_supernode();
  order_.assign(inner.order, inner.order + inner.size);
  for (std::int64_t k = 0; k < border; ++k) order_.push_back(inner.size + k);
  structure_ = {inner.size + border,  inner.supernodes + 1, columns_.data(), row_starts_.data(),
                value_starts_.data(), rows_.data(),         order_.data()};
}

}  // namespace bielle

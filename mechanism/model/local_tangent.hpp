// The local matrices K, C, M to which a component adds its derivatives, independent of how they are stored.
//
// A local matrix takes blocks. They are stored either in a dense matrix of the component's own size, or in the global
// sparse matrix: then each block is weighted and added directly to its place. A component that gathers its entries from
// many points requests the whole dense matrix instead of writing blocks; a component that never needs the whole matrix
// declares it (Declaration::in_blocks) and is then given sparse targets.
#pragma once

#include <cassert>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

/// Places of a component's local entries among the values of a sparse matrix.
struct SparsePlaces {
  int size = 0;            ///< size of the local matrix
  int multiplier_row = 0;  ///< first local row of constraints
  std::vector<int> place;  ///< place of each entry (size x size), by columns; -1 if the entry is dropped
  /// For each local column that begins the three rotations of a free node, that node; otherwise -1.
  std::vector<int> turned_node;
};

class LocalMatrix {
 public:
  /// Constructs a matrix whose blocks are added unchanged to a dense matrix.
  /// @param blocks_only  the component has declared that it requests no dense matrix: a request throws
  explicit LocalMatrix(Eigen::Ref<MatrixX> dense, bool blocks_only = false)
      : values_(dense.data()),
        stride_(dense.outerStride()),
        rows_(dense.rows()),
        columns_(dense.cols()),
        blocks_only_(blocks_only) {}
  /// Constructs a matrix whose blocks are weighted and added to the values of a sparse matrix: rows and columns of
  /// constraints by `constraint`, the others by `weight`; columns of rotations are first multiplied by the T of their
  /// node.
  /// @param turns  T of each node, or nullptr: columns of rotations are not multiplied
  LocalMatrix(const SparsePlaces& places, double* values, double weight, double constraint, const Matrix3* turns)
      : values_(values),
        places_(&places),
        weight_(weight),
        constraint_(constraint),
        turns_(turns),
        blocks_only_(true) {}

  /// A map, whose blocks may outlive it (those of an Eigen::Ref may not).
  using Dense = Eigen::Map<MatrixX, 0, Eigen::OuterStride<>>;
  /// Returns the whole matrix, to add to. It is requested once, before the loops over points.
  /// @throws std::logic_error if the component declares `in_blocks`
  Dense dense() {
    if (blocks_only_) throw std::logic_error("a component that declares in_blocks asks for a dense matrix");
    return {values_, rows_, columns_, Eigen::OuterStride<>(stride_)};
  }

  /// Adds a block of one or three rows and columns: directions of a node, or of constraints. Three columns begin at a
  /// node's displacements or rotations; a single column must not be a rotation. Either all of the block's entries
  /// belong to the component's pattern, or none does.
  template <int rows, int columns>
  void add(int row, int column, const Eigen::Matrix<double, rows, columns, rows == 1 && columns != 1>& block) {
    static_assert((rows == 1 || rows == 3) && (columns == 1 || columns == 3));
    if (!places_) {
      for (int c = 0; c < columns; ++c)
        for (int r = 0; r < rows; ++r) values_[row + r + (column + c) * stride_] += block(r, c);
      return;
    }
    const double weight = weight_of(row, column);
    if constexpr (columns == 3)
      if (const int node = turns_ ? places_->turned_node[static_cast<std::size_t>(column)] : -1; node >= 0) {
        put<rows, columns>(row, column, weight * (block * turns_[node]).eval());
        return;
      }
    put<rows, columns>(row, column, weight * block);
  }
  void add(int row, int column, const Matrix3& block) { add<3, 3>(row, column, block); }
  void add_row(int row, int column, const Vector3& entries) { add<1, 3>(row, column, entries.transpose()); }
  void add_column(int row, int column, const Vector3& entries) { add<3, 1>(row, column, entries); }
  /// Adds `value` times the identity. @param column  first column of displacements or constraints, not of rotations
  void add_identity(int row, int column, double value) {
    const double weighted = places_ ? weight_of(row, column) * value : value;
    for (int k = 0; k < 3; ++k) add_entry(row + k, column + k, weighted);
  }

 private:
  double weight_of(int row, int column) const {
    return row >= places_->multiplier_row || column >= places_->multiplier_row ? constraint_ : weight_;
  }
  void add_entry(int row, int column, double value) {
    if (!places_) {
      values_[row + column * stride_] += value;
      return;
    }
    if (const int place = places_->place[static_cast<std::size_t>(row + column * places_->size)]; place >= 0)
      values_[place] += value;
  }
  template <int rows, int columns>
  void put(int row, int column, const Eigen::Matrix<double, rows, columns, rows == 1 && columns != 1>& block) {
    const int* place = places_->place.data() + row + column * places_->size;
    if (*place < 0) return;
    for (int c = 0; c < columns; ++c, place += places_->size)
      for (int r = 0; r < rows; ++r) {
        assert(place[r] >= 0 && "a block of which only a part is in the component's pattern");
        values_[place[r]] += block(r, c);
      }
  }

  double* values_;
  const SparsePlaces* places_ = nullptr;
  Eigen::Index stride_ = 0, rows_ = 0, columns_ = 0;  ///< layout of a dense matrix
  double weight_ = 1, constraint_ = 1;
  const Matrix3* turns_ = nullptr;
  bool blocks_only_;
};

/// Local matrices that a component adds to. Only those requested (and declared) are written; all are zero on entry.
struct LocalTangent {
  LocalMatrix K;  ///< d r / d(q, y, lambda) at fixed rates; unsymmetric in moment rows off equilibrium
  LocalMatrix C;  ///< d r / d(v, ydot)
  LocalMatrix M;  ///< d r / d a
  bool wants_K = true, wants_C = true, wants_M = true;
};

/// The entries of a component's local tangent that can differ from zero at some state.
class LocalPattern {
 public:
  explicit LocalPattern(int size) : entries_(size, size) { entries_.setConstant(false); }
  int size() const { return static_cast<int>(entries_.rows()); }
  void add_all() { entries_.setConstant(true); }
  void add_block(int row, int column, int rows = 3, int columns = 3) {
    entries_.block(row, column, rows, columns).setConstant(true);
  }
  void add_diagonal(int row, int column, int count = 3) {
    for (int k = 0; k < count; ++k) entries_(row + k, column + k) = true;
  }
  bool has(int row, int column) const { return entries_(row, column); }

 private:
  Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> entries_;
};

}  // namespace bielle::mechanism

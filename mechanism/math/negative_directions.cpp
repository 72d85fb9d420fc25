#include "mechanism/math/negative_directions.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>

#include "reduce/dense/orthogonal_factors.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"

namespace bielle::mechanism {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

template <class Act>
void for_each_entry(const Sparse& A, const Act& act) {
  for (int j = 0; j < A.outerSize(); ++j)
    for (Sparse::InnerIterator it(A, j); it; ++it)
      if (it.value() != 0) act(static_cast<int>(it.row()), j, it.value());
}

class GroupSizes {
 public:
  GroupSizes(const Sparse& K, const Sparse& B, const std::vector<int>& group)
      : K_(K), B_(B), group_(group), sizes_(VectorX::Zero(group.empty() ? K.rows() : group.back() + 1)) {}

  VectorX run() {
    const VectorX diagonal = K_.diagonal();
    for (int i = 0; i < diagonal.size(); ++i) raise(sizes_, i, std::abs(diagonal[i]));
    const VectorX own = sizes_;
    for_each_entry(K_, [&](int row, int column, double value) {
      const double other = own[group_of(column)];
      if (own[group_of(row)] == 0 && other > 0) raise(sizes_, row, value * value / other);
    });
    while (spread()) continue;
    VectorX result(diagonal.size());
    for (int i = 0; i < result.size(); ++i) result[i] = sizes_[group_of(i)] > 0 ? sizes_[group_of(i)] : 1;
    return result;
  }

 private:
  int group_of(int unknown) const { return group_.empty() ? unknown : group_[static_cast<std::size_t>(unknown)]; }
  void raise(VectorX& sizes, int unknown, double size) const {
    double& most = sizes[group_of(unknown)];
    most = std::max(most, size);
  }

  /// Sets the sizes of groups that rows of B couple to groups of known size. @returns whether any size was set
  bool spread() {
    if (sizes_.size() == 0 || sizes_.minCoeff() > 0) return false;
    VectorX compliance = VectorX::Zero(B_.rows());
    for_each_entry(B_, [&](int row, int column, double b) {
      if (const double size = sizes_[group_of(column)]; size > 0) compliance[row] += b * b / size;
    });
    VectorX met = sizes_;
    for_each_entry(B_, [&](int row, int column, double b) {
      if (sizes_[group_of(column)] == 0 && compliance[row] > 0) raise(met, column, b * b / compliance[row]);
    });
    const bool any = (met.array() > 0).count() > (sizes_.array() > 0).count();
    sizes_ = met;
    return any;
  }

  const Sparse &K_, &B_;
  const std::vector<int>& group_;
  VectorX sizes_;
};

constexpr double stiff = 100, give = 1e-12, indifferent = 1e-15;  // see the head of negative_directions.hpp
/// Bound and diagonal entry for unknowns without stiffness of their own. If B^T B mixes them in oblique axes, only
/// rounding errors are left of them.
constexpr double hardly_own = 1e-10, of_none = 1e-12;

/// The matrix that is factorised, with scaled unknowns and with rows of B of length one.
class Saddle {
 public:
  Saddle(const Sparse& K, const Sparse& B, const VectorX& sizes) {
    const VectorX scale = sizes.cwiseSqrt().cwiseInverse();
    VectorX squares = VectorX::Zero(B.rows());
    for_each_entry(B, [&](int row, int column, double b) { squares[row] += std::pow(b * scale[column], 2); });
    const VectorX lengths = (squares.array() > 0).select(squares.cwiseSqrt(), 1);
    B_ = lengths.cwiseInverse().asDiagonal() * B * scale.asDiagonal();
    K_ = scale.asDiagonal() * K * scale.asDiagonal();
    A_ = K_ + Sparse(stiff * Sparse(Sparse(B_.transpose()) * B_));
    order();
  }

  int rows() const { return static_cast<int>(B_.rows()); }

  /// Counts by eigenvalues on a basis of the null space of B. This is used for small matrices whose pivots grow.
  int count_densely() const {
    constexpr double dependent = 1e-11, rounding = 1e-13;
    MatrixX allowed = MatrixX::Identity(K_.rows(), K_.rows());
    if (B_.rows() > 0) allowed = null_space(MatrixX(B_), dependent);
    if (allowed.cols() == 0) return 0;
    const MatrixX resisted = K_ * allowed;
    const VectorX values = symmetric_eigenpairs(MatrixX(allowed.transpose() * resisted)).values;
    return static_cast<int>((values.array() < -rounding * values.cwiseAbs().maxCoeff()).count());
  }

  /// Returns the lower triangle of the matrix, in the order of elimination.
  Sparse lower() const {
    std::vector<Eigen::Triplet<double>> entries;
    const auto add = [&](int i, int j, double value) { entries.emplace_back(std::max(i, j), std::min(i, j), value); };
    for_each_entry(A_, [&](int row, int column, double value) {
      if (row >= column) add(place_[row], place_[column], value);
    });
    const VectorX own = K_.diagonal();
    for (int i = 0; i < own.size(); ++i)
      add(place_[i], place_[i], std::abs(own[i]) < hardly_own ? of_none : indifferent);
    const auto n = static_cast<int>(A_.rows());
    for_each_entry(B_, [&](int row, int column, double value) { add(place_[n + row], place_[column], value); });
    for (int k = 0; k < B_.rows(); ++k) add(place_[n + k], place_[n + k], -give);
    Sparse whole(place_.size(), place_.size());
    whole.setFromTriplets(entries.begin(), entries.end());
    return whole;
  }

  /// Sizes with which entries of L D L^T are compared, in the same order.
  VectorX sizes() const {
    VectorX result = VectorX::Constant(place_.size(), 1 / stiff);
    const VectorX diagonal = A_.diagonal();
    for (int i = 0; i < diagonal.size(); ++i) result[place_[i]] = std::max(1.0, std::abs(diagonal[i]));
    return result;
  }

 private:
  /// A row of B comes immediately after the last of its unknowns. It adds no fill there, because B^T B couples them
  /// already. Unknowns that have almost no stiffness of their own come last, because they would cause large element
  /// growth as first pivots.
  void order() {
    constexpr double hardly = 1e-6;
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> inverse;
    Eigen::AMDOrdering<int>()(A_, inverse);
    const auto n = static_cast<int>(A_.rows()), m = static_cast<int>(B_.rows());
    const VectorX diagonal = A_.diagonal();
    std::vector<std::pair<int, int>> keys(static_cast<std::size_t>(n + m));  // unknowns before rows of the same key
    for (int k = 0; k < n; ++k) {
      const int i = inverse.indices()[k];
      keys[static_cast<std::size_t>(i)] = {std::abs(diagonal[i]) < hardly ? n + k : k, i};
    }
    for (int k = 0; k < m; ++k) keys[static_cast<std::size_t>(n + k)] = {-1, n + k};
    for_each_entry(B_, [&](int row, int column, double) {
      int& key = keys[static_cast<std::size_t>(n + row)].first;
      key = std::max(key, keys[static_cast<std::size_t>(column)].first);
    });
    std::sort(keys.begin(), keys.end());
    place_.resize(n + m);
    for (int k = 0; k < n + m; ++k) place_[keys[static_cast<std::size_t>(k)].second] = k;
  }

  Sparse K_, A_, B_;
  Eigen::VectorXi place_;  ///< place of each unknown, then of each row, in the order of elimination
};

struct Signs {
  int negative = 0;   ///< number of negative pivots, minus one for each row of B
  double growth = 0;  ///< square of the element growth: infinite if a pivot is zero
};

Signs signs_of(const Saddle& saddle) {
  const Eigen::SimplicialLDLT<Sparse, Eigen::Lower, Eigen::NaturalOrdering<int>> factors(saddle.lower());
  if (factors.info() != Eigen::Success) return {0, INFINITY};
  const VectorX pivots = factors.vectorD(), compared = saddle.sizes();
  if (!pivots.allFinite()) return {0, INFINITY};
  Signs signs{static_cast<int>((pivots.array() < 0).count()) - saddle.rows(), 0};
  const Sparse& L = factors.matrixL().nestedExpression();
  for_each_entry(L, [&](int row, int column, double l) {
    signs.growth = std::max(signs.growth, l * l * std::abs(pivots[column]) / compared[row]);
  });
  return signs;
}

}  // namespace

VectorX group_sizes(const Sparse& K, const Sparse& B, const std::vector<int>& group) {
  return GroupSizes(K, B, group).run();
}

std::optional<int> count_negative_directions(const Sparse& K, const Sparse& B, const VectorX& sizes) {
  constexpr double harmless = 1e6, most_growth = 1e8;  // squared element growth: ten digits are left, or half of them
  constexpr Eigen::Index small = 600;                  // number of unknowns
  if (K.rows() == 0) return 0;
  const Saddle saddle(K, B, sizes);
  const Signs signs = signs_of(saddle);
  if (signs.growth < harmless) return signs.negative;
  if (K.rows() <= small) return saddle.count_densely();
  if (signs.growth < most_growth) return signs.negative;
  return {};
}

}  // namespace bielle::mechanism

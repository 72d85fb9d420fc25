#include "reduce/spectral/supernodal_solver.hpp"

#include <algorithm>
#include <numeric>
#include <queue>

#include <cblas.h>
#include <omp.h>

#include "reduce/spectral/blas.hpp"
#include "reduce/spectral/few_columns.hpp"
#include "reduce/spectral/symmetric_matrix.hpp"

namespace bielle {

namespace {

constexpr Eigen::Index most_columns = 64;  // at a time: more bring no more speed, but need more memory

/// Less of the factor than this is not worth another thread, or that threads wait for each other.
constexpr std::int64_t entries_of_a_thread = 100000;

int blas_integer(std::int64_t k) { return static_cast<int>(k); }

struct Range {
  std::int64_t first, count;
};

Range share_of(std::int64_t count, int part, int parts) {
  const std::int64_t first = count * part / parts;
  return {first, count * (part + 1) / parts - first};
}

/// A supernode with the vectors of its rows. Blocks of vectors are by rows: transposed matrices by columns for BLAS.
struct Supernode {
  std::int64_t first, width, below;  // own columns, rows below
  const std::int64_t* rows_below;
  const double* values;

  std::int64_t stride() const { return width + below; }

  /// own <- L11^-1 own, for some of the columns of `own`.
  void solve_forwards(double* own, int columns, int row_stride) const {
    for (std::int64_t begin = 0; begin < width; begin += block) {
      const std::int64_t count = std::min(block, width - begin), end = begin + count;
      solve_block(CblasTrans, begin, count, own, columns, row_stride);
      subtract_product_with_few(width - end, count, values + end + begin * stride(), stride(), own + begin * row_stride,
                                own + end * row_stride, columns, row_stride);
    }
  }
  /// own <- L11^-T own
  void solve_backwards(double* own, int columns, int row_stride) const {
    for (std::int64_t begin = (width - 1) / block * block; begin >= 0; begin -= block) {
      const std::int64_t count = std::min(block, width - begin), end = begin + count;
      subtract_transposed_product_with_few(width - end, count, values + end + begin * stride(), stride(),
                                           own + end * row_stride, own + begin * row_stride, columns, row_stride);
      solve_block(CblasNoTrans, begin, count, own, columns, row_stride);
    }
  }
  /// out <- -L21 own, of some of the rows below.
  void multiply(Range rows, const double* own, double* out, int columns) const {
    std::fill_n(out, rows.count * columns, 0.0);
    subtract_product_with_few(rows.count, width, values + width + rows.first, stride(), own, out, columns, columns);
  }
  /// own <- own - L21^T in, of some of its own columns.
  void subtract_transposed(Range own_columns, const double* in, double* own, int columns) const {
    subtract_transposed_product_with_few(below, own_columns.count, values + width + own_columns.first * stride(),
                                         stride(), in, own + own_columns.first * columns, columns, columns);
  }

 private:
  static constexpr std::int64_t block = 32;

  void solve_block(CBLAS_TRANSPOSE order, std::int64_t begin, std::int64_t count, double* own, int columns,
                   int row_stride) const {
    cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, order, CblasNonUnit, columns, blas_integer(count), 1,
                values + begin * (stride() + 1), blas_integer(stride()), own + begin * row_stride, row_stride);
  }
};

void add_row(double* to, const double* from, int columns) {
  for (int c = 0; c < columns; ++c) to[c] += from[c];
}

}  // namespace

/// One solution with some columns.
class SupernodalSolver::Sweep {
 public:
  Sweep(const SupernodalSolver& solver, const Eigen::MatrixXd& b, Eigen::MatrixXd& x, Eigen::Index first, int columns)
      : solver_(solver),
        factor_(solver.factor_),
        parts_(blas_integer(static_cast<std::int64_t>(solver.of_threads_.size()))),
        columns_((columns + vectors_abreast - 1) / vectors_abreast * vectors_abreast),
        given_(columns),
        first_(first),
        b_(b),
        x_(x),
        y_(RowMatrix::Zero(factor_.size, columns_)),
        rooms_(static_cast<std::size_t>(parts_), RowMatrix(solver.longest_, columns_)),
        sums_(static_cast<std::size_t>(parts_), RowMatrix::Zero(solver.rows_above_, columns_)) {}

  void run() {
    // Where fewer threads come than were asked for (inside of other parallel work), each does several parts.
#pragma omp parallel num_threads(parts_)
    {
      each_part([&](int part) { copy_in(part); });
      each_part([&](int part) {
        for (const std::int64_t s : own(part)) forwards(supernode(s), part);
      });
      each_part([&](int part) { add_sums(part); });
      for_above(
          solver_.above_, [&](const Supernode& node) { forwards_together(node); },
          [&](const Supernode& node) { forwards(node, 0, true); });
      for_above(
          std::vector<std::int64_t>(solver_.above_.rbegin(), solver_.above_.rend()),
          [&](const Supernode& node) { backwards_together(node); }, [&](const Supernode& node) { backwards(node, 0); });
      each_part([&](int part) {
        for (auto s = own(part).rbegin(); s != own(part).rend(); ++s) backwards(supernode(*s), part);
      });
      each_part([&](int part) { copy_out(part); });
    }
  }

 private:
  /// Called by all threads, which wait for each other at the end.
  template <class Work>
  void each_part(const Work& work) const {
    for (int part = omp_get_thread_num(); part < parts_; part += omp_get_num_threads()) work(part);
#pragma omp barrier
  }

  /// Large supernodes together, small ones in a row by one thread: to wait for each other takes longer.
  template <class Together, class Alone>
  void for_above(const std::vector<std::int64_t>& nodes, const Together& together, const Alone& alone) {
    const auto is_large = [&](std::int64_t s) { return entries(supernode(s)) > entries_of_a_thread; };
    for (std::size_t k = 0; k < nodes.size();) {
      if (is_large(nodes[k])) {
        together(supernode(nodes[k++]));
        continue;
      }
      const std::size_t first = k;
      while (k < nodes.size() && !is_large(nodes[k])) ++k;
      if (omp_get_thread_num() == 0)
        for (std::size_t j = first; j < k; ++j) alone(supernode(nodes[j]));
#pragma omp barrier
    }
  }
  static std::int64_t entries(const Supernode& node) { return node.width * (node.width + node.below); }

  const std::vector<std::int64_t>& own(int part) const { return solver_.of_threads_[static_cast<std::size_t>(part)]; }
  double* room(int part) { return rooms_[static_cast<std::size_t>(part)].data(); }

  Supernode supernode(std::int64_t s) const {
    const std::int64_t width = factor_.columns[s + 1] - factor_.columns[s];
    const std::int64_t rows = factor_.row_starts[s + 1] - factor_.row_starts[s];
    return {factor_.columns[s], width, rows - width, factor_.rows + factor_.row_starts[s] + width,
            factor_.values + factor_.value_starts[s]};
  }
  double* row(std::int64_t k) { return y_.data() + k * columns_; }

  void copy_in(int part) {
    const Range rows = share_of(factor_.size, part, parts_);
    for (std::int64_t k = rows.first; k < rows.first + rows.count; ++k) {
      const double* from = &b_(factor_.order[k], first_);
      double* to = row(k);
      for (int c = 0; c < given_; ++c) to[c] = from[c * b_.rows()];
    }
  }
  void copy_out(int part) {
    const Range rows = share_of(factor_.size, part, parts_);
    for (std::int64_t k = rows.first; k < rows.first + rows.count; ++k) {
      double* to = &x_(factor_.order[k], first_);
      const double* from = row(k);
      for (int c = 0; c < given_; ++c) to[c * x_.rows()] = from[c];
    }
  }
  /// What the subtrees of all threads give to the rows above them.
  void add_sums(int part) {
    const Range rows = share_of(solver_.rows_above_, part, parts_);
    for (const RowMatrix& sum : sums_) {
      const double* from = sum.data() + rows.first * columns_;
      for (std::int64_t k = rows.first; k < rows.first + rows.count; ++k, from += columns_)
        add_row(row(solver_.unknowns_above_[static_cast<std::size_t>(k)]), from, columns_);
    }
  }

  /// @param is_above  what is given to rows above is not kept apart
  void forwards(const Supernode& node, int part, bool is_above = false) {
    double* const own = row(node.first);
    node.solve_forwards(own, columns_, columns_);
    if (node.below == 0) return;
    double* update = room(part);
    node.multiply({0, node.below}, own, update, columns_);
    double* const sums = sums_[static_cast<std::size_t>(part)].data();
    for (std::int64_t k = 0; k < node.below; ++k, update += columns_) {
      const std::int64_t to = node.rows_below[k];
      const std::int64_t above = is_above ? -1 : solver_.place_above_[static_cast<std::size_t>(to)];
      add_row(above < 0 ? row(to) : sums + above * columns_, update, columns_);
    }
  }
  void backwards(const Supernode& node, int part) {
    double* const own = row(node.first);
    if (node.below > 0) {
      gather_below(node, part);
      node.subtract_transposed({0, node.width}, room(part), own, columns_);
    }
    node.solve_backwards(own, columns_, columns_);
  }

  // All threads at one supernode: each with some columns of the vectors, then with some rows of the supernode.
  void solve_triangle_together(const Supernode& node, bool forwards) {
    each_part([&](int part) {
      const Range quads = share_of(columns_ / vectors_abreast, part, parts_);
      double* const own = row(node.first) + quads.first * vectors_abreast;
      const int columns = blas_integer(quads.count) * vectors_abreast;
      if (columns == 0) return;
      forwards ? node.solve_forwards(own, columns, columns_) : node.solve_backwards(own, columns, columns_);
    });
  }
  void forwards_together(const Supernode& node) {
    solve_triangle_together(node, true);
    each_part([&](int part) {
      const Range rows = share_of(node.below, part, parts_);
      if (rows.count == 0) return;
      double* update = room(part);
      node.multiply(rows, row(node.first), update, columns_);
      for (std::int64_t k = rows.first; k < rows.first + rows.count; ++k, update += columns_)
        add_row(row(node.rows_below[k]), update, columns_);
    });
  }
  void backwards_together(const Supernode& node) {
    each_part([&](int part) {
      const Range columns = share_of(node.width, part, parts_);
      if (node.below == 0 || columns.count == 0) return;
      gather_below(node, part);
      node.subtract_transposed(columns, room(part), row(node.first), columns_);
    });
    solve_triangle_together(node, false);
  }

  void gather_below(const Supernode& node, int part) {
    double* to = room(part);
    for (std::int64_t k = 0; k < node.below; ++k, to += columns_) std::copy_n(row(node.rows_below[k]), columns_, to);
  }

  const SupernodalSolver& solver_;
  const SupernodalFactor& factor_;
  int parts_, columns_, given_;  // columns are made a multiple of `vectors_abreast` by zeros
  Eigen::Index first_;
  const Eigen::MatrixXd& b_;
  Eigen::MatrixXd& x_;
  RowMatrix y_;
  std::vector<RowMatrix> rooms_, sums_;
};

SupernodalSolver::SupernodalSolver(const SupernodalFactor& factor, int threads) : factor_(factor) {
  std::vector<std::int64_t> owner(static_cast<std::size_t>(factor.size));
  for (std::int64_t s = 0; s < factor.supernodes; ++s)
    std::fill(owner.begin() + factor.columns[s], owner.begin() + factor.columns[s + 1], s);
  parents_.resize(static_cast<std::size_t>(factor.supernodes), -1);
  for (std::int64_t s = 0; s < factor.supernodes; ++s) {
    const std::int64_t below = factor.row_starts[s] + factor.columns[s + 1] - factor.columns[s];
    longest_ = std::max(longest_, factor.row_starts[s + 1] - below);
    if (below < factor.row_starts[s + 1])
      parents_[static_cast<std::size_t>(s)] = owner[static_cast<std::size_t>(factor.rows[below])];
  }
  share_out(threads);
}

/// Cuts the largest subtree off its root until there are enough for each thread, and gives each in turn to the thread
/// that has least.
void SupernodalSolver::share_out(int threads) {
  const auto count = static_cast<std::size_t>(factor_.supernodes);
  std::vector<std::int64_t> work(count);
  std::vector<std::vector<std::int64_t>> children(count);
  using Subtree = std::pair<std::int64_t, std::int64_t>;  // work, root
  std::priority_queue<Subtree> subtrees;
  std::int64_t all = 0;
  for (std::size_t s = 0; s < count; ++s) {
    const std::int64_t own =
        (factor_.columns[s + 1] - factor_.columns[s]) * (factor_.row_starts[s + 1] - factor_.row_starts[s]);
    work[s] += own;
    all += own;
    if (parents_[s] < 0) {
      subtrees.emplace(work[s], s);
    } else {
      const auto parent = static_cast<std::size_t>(parents_[s]);
      work[parent] += work[s];
      children[parent].push_back(static_cast<std::int64_t>(s));
    }
  }
  const std::int64_t useful = std::clamp<std::int64_t>(all / entries_of_a_thread, 1, std::max(1, threads));
  threads = blas_integer(useful);
  of_threads_.resize(static_cast<std::size_t>(threads));
  if (threads > 1) {
    const std::int64_t small = all / (4 * threads);
    while (!subtrees.empty() && subtrees.top().first > small) {
      const auto root = static_cast<std::size_t>(subtrees.top().second);
      subtrees.pop();
      above_.push_back(static_cast<std::int64_t>(root));
      for (const std::int64_t child : children[root]) subtrees.emplace(work[static_cast<std::size_t>(child)], child);
    }
    std::sort(above_.begin(), above_.end());
  }
  std::vector<std::int64_t> load(of_threads_.size(), 0), thread_of(count, -1);
  for (; !subtrees.empty(); subtrees.pop()) {
    const auto [weight, root] = subtrees.top();
    const auto least = std::min_element(load.begin(), load.end()) - load.begin();
    load[static_cast<std::size_t>(least)] += weight;
    thread_of[static_cast<std::size_t>(root)] = least;
  }
  for (std::size_t s = count; s-- > 0;)  // parents come after their children
    if (parents_[s] >= 0 && thread_of[s] < 0 && !std::binary_search(above_.begin(), above_.end(), s))
      thread_of[s] = thread_of[static_cast<std::size_t>(parents_[s])];
  for (std::size_t s = 0; s < count; ++s)
    if (thread_of[s] >= 0) of_threads_[static_cast<std::size_t>(thread_of[s])].push_back(static_cast<std::int64_t>(s));
  place_above_.assign(static_cast<std::size_t>(factor_.size), -1);
  for (const std::int64_t s : above_) {
    for (std::int64_t k = factor_.columns[s]; k < factor_.columns[s + 1]; ++k) {
      place_above_[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(unknowns_above_.size());
      unknowns_above_.push_back(k);
    }
  }
  rows_above_ = static_cast<std::int64_t>(unknowns_above_.size());
}

Eigen::MatrixXd SupernodalSolver::solve(const Eigen::MatrixXd& b) const {
  const BlasThreads one(1);
  Eigen::MatrixXd x(b.rows(), b.cols());
  for (Eigen::Index first = 0; first < b.cols(); first += most_columns)
    Sweep(*this, b, x, first, blas_integer(std::min(most_columns, b.cols() - first))).run();
  return x;
}

}  // namespace bielle

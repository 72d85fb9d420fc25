#include "reduce/spectral/supernodal_solver.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>
#include <new>

#include <omp.h>

#include "reduce/spectral/elimination_tree.hpp"
#include "reduce/spectral/huge_pages.hpp"
#include "reduce/spectral/spread_entries.hpp"
#include "reduce/spectral/supernode.hpp"

namespace bielle {

namespace {

constexpr Eigen::Index most_columns = 64;  // at a time: more bring no more speed, but need more memory

/// Less of the factor than this is not worth another thread, or that threads wait for each other.
constexpr std::int64_t entries_of_a_thread = 100000;

/// Vectors by rows. Not set to anything: each thread touches first what it will use.
class RowsOfVectors {
 public:
  RowsOfVectors(std::int64_t rows, int vectors)
      : stride_(vectors),
        numbers_(static_cast<double*>(allocate_in_huge_pages(
            std::max<std::size_t>(1, static_cast<std::size_t>(rows * vectors)) * sizeof(double)))) {
    if (!numbers_) throw std::bad_alloc();
  }
  double* row(std::int64_t k) const { return numbers_.get() + k * stride_; }

 private:
  struct Freed {
    void operator()(double* memory) const { std::free(memory); }
  };
  std::int64_t stride_;
  std::unique_ptr<double, Freed> numbers_;
};

void add_row(double* to, const double* from, int columns) {
  for (int c = 0; c < columns; ++c) to[c] += from[c];
}

}  // namespace

/// What one solution writes to.
struct SupernodalSolver::Room {
  int columns;
  RowsOfVectors y;
  std::vector<RowsOfVectors> sums;  // what the subtrees of each thread give to the rows above them

  Room(const SupernodalSolver& solver, int count) : columns(count), y(solver.factor_.size, count) {
    for (std::size_t part = 0; part < solver.of_threads_.size(); ++part) sums.emplace_back(solver.rows_above_, count);
  }
};

/// One solution with some columns.
class SupernodalSolver::Sweep {
 public:
  /// @param given  columns of b and x from the first on
  Sweep(const SupernodalSolver& solver, Room& room, const Eigen::MatrixXd& b, Eigen::MatrixXd& x, Eigen::Index first,
        int given)
      : solver_(solver),
        factor_(solver.factor_),
        parts_(static_cast<int>(solver.of_threads_.size())),
        columns_(room.columns),
        given_(given),
        first_(first),
        b_(b),
        x_(x),
        y_(room.y),
        sums_(room.sums) {}

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
          [&](const Supernode& node) { backwards_together(node); }, [&](const Supernode& node) { backwards(node); });
      each_part([&](int part) {
        for (auto s = own(part).rbegin(); s != own(part).rend(); ++s) backwards(supernode(*s));
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
  Supernode supernode(std::int64_t s) const {
    const std::int64_t width = factor_.columns[s + 1] - factor_.columns[s];
    const std::int64_t rows = factor_.row_starts[s + 1] - factor_.row_starts[s];
    return {factor_.columns[s], width, rows - width, factor_.rows + factor_.row_starts[s] + width,
            factor_.values + factor_.value_starts[s]};
  }
  double* row(std::int64_t k) const { return y_.row(k); }
  Vectors all_vectors() const { return {0, columns_, columns_}; }

  // Along the columns of the vectors: unknowns that follow each other in the factor are all over the place in them,
  // while the rows here are as long as a line of the cache or longer.
  void copy_in(int part) {
    const Range unknowns = share_of(factor_.size, part, parts_);
    for (std::int64_t i = unknowns.first; i < unknowns.first + unknowns.count; ++i) {
      const double* const from = &b_(i, first_);
      double* const to = row(solver_.places_[static_cast<std::size_t>(i)]);
      for (int c = 0; c < given_; ++c) to[c] = from[c * b_.rows()];
      std::fill(to + given_, to + columns_, 0.0);
    }
    std::fill_n(sums_[static_cast<std::size_t>(part)].row(0), solver_.rows_above_ * columns_, 0.0);
  }
  void copy_out(int part) {
    const Range unknowns = share_of(factor_.size, part, parts_);
    for (std::int64_t i = unknowns.first; i < unknowns.first + unknowns.count; ++i) {
      double* const to = &x_(i, first_);
      const double* const from = row(solver_.places_[static_cast<std::size_t>(i)]);
      for (int c = 0; c < given_; ++c) to[c * x_.rows()] = from[c];
    }
  }
  /// What the subtrees of all threads give to the rows above them.
  void add_sums(int part) {
    const Range rows = share_of(solver_.rows_above_, part, parts_);
    for (const RowsOfVectors& sums : sums_)
      for (std::int64_t k = rows.first; k < rows.first + rows.count; ++k)
        add_row(row(solver_.unknowns_above_[static_cast<std::size_t>(k)]), sums.row(k), columns_);
  }

  /// Where the vectors of the rows of a panel below a supernode are.
  using RowAddresses = std::array<double*, lines_abreast>;
  RowAddresses rows_of(const Supernode& node, Range rows) const {
    RowAddresses addresses{};
    for (std::int64_t k = 0; k < rows.count; ++k)
      addresses[static_cast<std::size_t>(k)] = row(node.rows_below[rows.first + k]);
    return addresses;
  }
  /// Where a subtree puts what it gives to them: rows above all subtrees have a sum in each of them.
  RowAddresses sums_of(const Supernode& node, Range rows, int part) const {
    RowAddresses addresses{};
    for (std::int64_t k = 0; k < rows.count; ++k) {
      const std::int64_t to = node.rows_below[rows.first + k];
      const std::int64_t above = solver_.place_above_[static_cast<std::size_t>(to)];
      addresses[static_cast<std::size_t>(k)] = above < 0 ? row(to) : sums_[static_cast<std::size_t>(part)].row(above);
    }
    return addresses;
  }

  /// @param is_above  what is given to rows above is not kept apart
  void forwards(const Supernode& node, int part, bool is_above = false) {
    double* const own = row(node.first);
    node.substitute_forwards(own, all_vectors());
    for (std::int64_t panel = 0; panel < node.panels_below(); ++panel) {
      const Range rows = node.rows_of_panel(panel);
      const RowAddresses to = is_above ? rows_of(node, rows) : sums_of(node, rows, part);
      FewVectors::fastest().subtract_product(node.panel_below(rows, {0, node.width}), own, to.data(), all_vectors());
    }
  }
  /// own <- own - L21^T of the rows below, some of its own columns.
  void take_from_below(const Supernode& node, Range own_columns) {
    double* const own = row(node.first + own_columns.first);
    for (std::int64_t panel = 0; panel < node.panels_below(); ++panel) {
      const Range rows = node.rows_of_panel(panel);
      FewVectors::fastest().subtract_transposed_product(node.panel_below(rows, own_columns), rows_of(node, rows).data(),
                                                        own, all_vectors());
    }
  }
  void backwards(const Supernode& node) {
    take_from_below(node, {0, node.width});
    node.substitute_backwards(row(node.first), all_vectors());
  }

  // All threads at one supernode: each with some of the vectors, then with some rows or columns of the supernode.
  Vectors own_vectors(int part) const {
    const Range own = share_of(columns_ / vectors_abreast, part, parts_);
    return {static_cast<int>(own.first) * vectors_abreast, static_cast<int>(own.count) * vectors_abreast, columns_};
  }
  void forwards_together(const Supernode& node) {
    each_part([&](int part) { node.substitute_forwards(row(node.first), own_vectors(part)); });
    each_part([&](int part) {
      const Range panels = share_of(node.panels_below(), part, parts_);
      for (std::int64_t panel = panels.first; panel < panels.first + panels.count; ++panel) {
        const Range rows = node.rows_of_panel(panel);
        FewVectors::fastest().subtract_product(node.panel_below(rows, {0, node.width}), row(node.first),
                                               rows_of(node, rows).data(), all_vectors());
      }
    });
  }
  void backwards_together(const Supernode& node) {
    each_part([&](int part) { take_from_below(node, share_of(node.width, part, parts_)); });
    each_part([&](int part) { node.substitute_backwards(row(node.first), own_vectors(part)); });
  }

  const SupernodalSolver& solver_;
  const SupernodalFactor& factor_;
  int parts_, columns_, given_;  // columns are made a multiple of `vectors_abreast` by zeros
  Eigen::Index first_;
  const Eigen::MatrixXd& b_;
  Eigen::MatrixXd& x_;
  RowsOfVectors& y_;
  std::vector<RowsOfVectors>& sums_;
};

SupernodalSolver::SupernodalSolver(const SupernodalFactor& factor, double* values, int threads)
    : factor_(factor), places_(places_in_order(factor)) {
  factor_.values = values;
  share_out(threads);
  cut_into_panels(values);
}

void SupernodalSolver::cut_into_panels(double* values) const {
  std::int64_t largest = 0;
  for (std::int64_t s = 0; s < factor_.supernodes; ++s)
    largest = std::max(largest, factor_.value_starts[s + 1] - factor_.value_starts[s]);
  std::vector<RowsOfVectors> rooms;
  for (std::size_t part = 0; part < of_threads_.size(); ++part) rooms.emplace_back(largest, 1);
#pragma omp parallel num_threads(static_cast <int>(rooms.size()))
  {
    double* const room = rooms[static_cast<std::size_t>(omp_get_thread_num())].row(0);
#pragma omp for schedule(dynamic, 1)
    for (std::int64_t k = 0; k < factor_.supernodes; ++k) {
      const std::int64_t s = factor_.supernodes - 1 - k;  // the largest come last
      bielle::cut_into_panels(factor_.row_starts[s + 1] - factor_.row_starts[s],
                              factor_.columns[s + 1] - factor_.columns[s], values + factor_.value_starts[s], room);
    }
  }
}

SupernodalSolver::~SupernodalSolver() = default;

void SupernodalSolver::share_out(int threads) {
  const auto count = static_cast<std::size_t>(factor_.supernodes);
  const EliminationTree tree(factor_);
  std::vector<double> entries(count);  // of each subtree
  for (std::size_t s = 0; s < count; ++s) {
    entries[s] += static_cast<double>((factor_.columns[s + 1] - factor_.columns[s]) *
                                      (factor_.row_starts[s + 1] - factor_.row_starts[s]));
    if (tree.parents[s] >= 0) entries[static_cast<std::size_t>(tree.parents[s])] += entries[s];
  }
  const TreeShares shares = bielle::share_out(tree, entries, static_cast<double>(entries_of_a_thread), threads);
  give_subtrees(tree, shares, entries);
  number_rows_above(shares);
}

/// Each in turn to the thread that has least.
void SupernodalSolver::give_subtrees(const EliminationTree& tree, const TreeShares& shares,
                                     const std::vector<double>& entries) {
  of_threads_.resize(static_cast<std::size_t>(shares.threads));
  const std::size_t count = tree.parents.size();
  std::vector<double> load(of_threads_.size(), 0);
  std::vector<std::int64_t> thread_of(count, -1);
  for (const std::int64_t root : shares.roots) {
    const auto least = std::min_element(load.begin(), load.end()) - load.begin();
    load[static_cast<std::size_t>(least)] += entries[static_cast<std::size_t>(root)];
    thread_of[static_cast<std::size_t>(root)] = least;
  }
  for (std::size_t s = count; s-- > 0;)  // parents come after their children
    if (tree.parents[s] >= 0 && thread_of[s] < 0 && !shares.is_above[s])
      thread_of[s] = thread_of[static_cast<std::size_t>(tree.parents[s])];
  for (std::size_t s = 0; s < count; ++s)
    if (thread_of[s] >= 0) of_threads_[static_cast<std::size_t>(thread_of[s])].push_back(static_cast<std::int64_t>(s));
}

void SupernodalSolver::number_rows_above(const TreeShares& shares) {
  place_above_.assign(static_cast<std::size_t>(factor_.size), -1);
  for (std::int64_t s = 0; s < factor_.supernodes; ++s) {
    if (!shares.is_above[static_cast<std::size_t>(s)]) continue;
    above_.push_back(s);
    for (std::int64_t k = factor_.columns[s]; k < factor_.columns[s + 1]; ++k) {
      place_above_[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(unknowns_above_.size());
      unknowns_above_.push_back(k);
    }
  }
  rows_above_ = static_cast<std::int64_t>(unknowns_above_.size());
}

Eigen::MatrixXd SupernodalSolver::solve(const Eigen::MatrixXd& b) const {
  Eigen::MatrixXd x(b.rows(), b.cols());
  for (Eigen::Index first = 0; first < b.cols(); first += most_columns) {
    const auto given = static_cast<int>(std::min(most_columns, b.cols() - first));
    std::unique_ptr<Room> room = take_room((given + vectors_abreast - 1) / vectors_abreast * vectors_abreast);
    Sweep(*this, *room, b, x, first, given).run();
    keep(std::move(room));
  }
  return x;
}

std::unique_ptr<SupernodalSolver::Room> SupernodalSolver::take_room(int columns) const {
  {
    const std::lock_guard lock(guard_);
    if (kept_ && kept_->columns == columns) return std::move(kept_);
  }
  return std::make_unique<Room>(*this, columns);
}

void SupernodalSolver::keep(std::unique_ptr<Room> room) const {
  constexpr int most_kept = 16;  // columns: little next to the factor
  if (room->columns > most_kept) return;
  const std::lock_guard lock(guard_);
  kept_ = std::move(room);
}

}  // namespace bielle

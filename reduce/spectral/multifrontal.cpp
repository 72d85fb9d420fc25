#include "reduce/spectral/multifrontal.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>
#include <new>
#include <utility>

#include <omp.h>

#include "reduce/spectral/blas.hpp"
#include "reduce/spectral/child_update.hpp"
#include "reduce/spectral/front.hpp"
#include "reduce/spectral/huge_pages.hpp"
#include "reduce/spectral/spread_entries.hpp"
#include "reduce/spectral/team.hpp"

namespace bielle {

namespace {

/// The elimination of all supernodes. `Columns` gives a supernode its columns and takes them when it is eliminated:
///   Front begin(std::int64_t s, Team&)          columns of A; no update matrix yet
///   double* pivots()                            for D; none: L L^T
///   void end(const SupernodeShape&, const Front&, Team&)
/// Each thread has one; that of the first serves all threads together.
template <class Columns>
class Elimination {
 public:
  Elimination(const SupernodalFactor& structure, const UpdatePlan& plan, std::vector<Columns>& columns)
      : structure_(structure),
        plan_(plan),
        threads_(static_cast<int>(columns.size())),
        memory_(plan, threads_),
        columns_(columns),
        failed_(plan.subtrees() + 1, -1) {}

  /// @returns the column where a pivot was not positive, or -1
  std::int64_t run() {
    // Fewer threads may come than are asked for.
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads_)
    for (std::size_t k = 0; k < plan_.subtrees(); ++k) {
      Team alone;
      failed_[k] = eliminate(plan_.of_subtree(k), omp_get_thread_num(), alone);
    }
    if (plan_.above().empty() || first_failed() >= 0) return first_failed();
    memory_.leave_subtrees();
    TeamWork work;
#pragma omp parallel num_threads(threads_)
    {
      Team team(omp_get_thread_num(), omp_get_num_threads(), work);
      const std::int64_t column = eliminate(plan_.above(), 0, team);
      if (team.rank() == 0) failed_.back() = column;
    }
    return failed_.back();
  }

 private:
  std::int64_t first_failed() const {
    const auto failed = std::find_if(failed_.begin(), failed_.end(), [](std::int64_t column) { return column >= 0; });
    return failed == failed_.end() ? -1 : *failed;
  }

  /// @param worker  whose stacks
  std::int64_t eliminate(const std::vector<std::int64_t>& supernodes, int worker, Team& team) {
    Columns& columns = columns_[static_cast<std::size_t>(worker)];
    for (const std::int64_t s : supernodes) {
      const SupernodeShape shape(structure_, s);
      Front front = columns.begin(s, team);
      front.update = memory_.of(s, worker);
      take_up_children(s, front, worker, team);
      const std::int64_t failed = eliminate_columns(front, columns.pivots(), team);
      if (failed >= 0) return shape.first + failed;
      add_to_update(front, plan_.children(s).empty(), team);
      columns.end(shape, front, team);
    }
    return -1;
  }

  void take_up_children(std::int64_t s, const Front& front, int worker, Team& team) {
    const std::vector<std::int64_t>& children = plan_.children(s);
    if (children.empty()) return team.wait();
    const SupernodeShape shape(structure_, s);
    std::vector<ChildUpdate> updates;
    for (const std::int64_t child : children)
      updates.emplace_back(memory_.of(child, worker), SupernodeShape(structure_, child), shape);
    // A few columns at a time, which stay in the cache while all that belongs to them is added.
    constexpr std::int64_t few = 32;
    const auto groups = [](std::int64_t columns) { return (columns + few - 1) / few; };
    const std::int64_t of_own = groups(front.width);
    team.share(of_own + groups(front.below()), [&](std::int64_t k) {
      const std::int64_t first = k < of_own ? k * few : front.width + (k - of_own) * few;
      const std::int64_t end = std::min(first + few, k < of_own ? front.width : front.rows);
      for (std::int64_t column = std::max(first, front.width); column < end; ++column) front.clear_update(column);
      for (const ChildUpdate& update : updates) update.add_to(front, first, end);
    });
    team.once([&] {
      for (const std::int64_t child : children) memory_.free(child);
    });
  }

  const SupernodalFactor& structure_;
  const UpdatePlan& plan_;
  int threads_;
  UpdateMemory memory_;
  std::vector<Columns>& columns_;
  std::vector<std::int64_t> failed_;  // of each subtree, and at last of what is above: the column, or -1
};

/// L where it is to stay.
class KeptColumns {
 public:
  KeptColumns(const SupernodalFactor& structure, double* values) : structure_(&structure), values_(values) {}
  Front begin(std::int64_t s, Team&) {
    const SupernodeShape shape(*structure_, s);
    return {shape.rows, shape.width, values_ + structure_->value_starts[s]};
  }
  double* pivots() { return nullptr; }
  void end(const SupernodeShape&, const Front&, Team&) {}

 private:
  const SupernodalFactor* structure_;
  double* values_;
};

/// The lower triangle of P A P^T by columns.
struct OrderedEntries {
  std::vector<std::int64_t> starts;
  std::vector<std::int32_t> rows;
  std::vector<double> values;

  OrderedEntries(const SupernodalFactor& structure, const SymmetricMatrix& a)
      : starts(static_cast<std::size_t>(a.size) + 1, 0), rows(a.rows.size()), values(a.rows.size()) {
    const std::vector<std::int64_t> places = places_in_order(structure);
    const auto each = [&](const auto& work) {
      for (std::int64_t j = 0; j < a.size; ++j) {
        const std::int64_t place = places[static_cast<std::size_t>(j)];
        for (std::int64_t p = a.starts[j]; p < a.starts[j + 1]; ++p) {
          const std::int64_t other = places[static_cast<std::size_t>(a.rows[p])];
          work(static_cast<std::size_t>(std::min(place, other)), std::max(place, other), a.values[p]);
        }
      }
    };
    each([&](std::size_t column, std::int64_t, double) { ++starts[column + 1]; });
    for (std::size_t k = 1; k < starts.size(); ++k) starts[k] += starts[k - 1];
    std::vector<std::int64_t> next(starts.begin(), starts.end() - 1);
    each([&](std::size_t column, std::int64_t row, double value) {
      const auto at = static_cast<std::size_t>(next[column]++);
      rows[at] = static_cast<std::int32_t>(row);
      values[at] = value;
    });
  }
};

/// Columns that are dropped when the signs of their pivots are counted.
class CountedColumns {
 public:
  /// @param inverse_scale  of each row of L; outlives this, as do the others
  CountedColumns(const SupernodalFactor& structure, const OrderedEntries& entries,
                 const std::vector<double>& inverse_scale)
      : structure_(&structure), entries_(&entries), inverse_scale_(&inverse_scale) {
    std::int64_t widest = 0, largest = 0;
    for (std::int64_t s = 0; s < structure.supernodes; ++s) {
      const SupernodeShape shape(structure, s);
      widest = std::max(widest, shape.width);
      largest = std::max(largest, shape.width * shape.rows);
    }
    pivots_.resize(static_cast<std::size_t>(widest));
    columns_.reset(
        static_cast<double*>(allocate_in_huge_pages(2 * sizeof(double) * static_cast<std::size_t>(largest))));
    if (!columns_) throw std::bad_alloc();
    largest_ = largest;
  }

  Front begin(std::int64_t s, Team& team) {
    const SupernodeShape shape(*structure_, s);
    Front front{shape.rows, shape.width, columns_.get(), columns_.get() + largest_};
    RowFinder finder(*structure_);
    team.share(shape.width, [&](std::int64_t k) {
      double* const column = front.columns + k * shape.rows;
      std::fill_n(column, shape.rows, 0.0);
      const auto number = static_cast<std::size_t>(shape.first + k);
      for (auto p = static_cast<std::size_t>(entries_->starts[number]);
           p < static_cast<std::size_t>(entries_->starts[number + 1]); ++p)
        column[finder.find(s, entries_->rows[p])] = entries_->values[p];
    });
    if (finder.is_outside()) {
#pragma omp atomic write
      is_outside_ = true;
    }
    return front;
  }
  double* pivots() { return pivots_.data(); }
  void end(const SupernodeShape& shape, const Front& front, Team& team) {
    team.once([&] {
      for (std::int64_t k = 0; k < shape.width; ++k) {
        const double pivot = pivots_[static_cast<std::size_t>(k)];
        signs_.negative += pivot < 0;
        const double* const L = front.scaled + k * shape.rows;
        double largest = relative(shape, k);
        for (std::int64_t i = k + 1; i < shape.rows; ++i) largest = std::max(largest, L[i] * L[i] * relative(shape, i));
        const double growth = largest * std::abs(pivot);
        if (!(growth <= signs_.growth)) signs_.growth = std::isnan(growth) ? infinite : growth;
      }
    });
  }
  /// Growth is infinite where A has entries outside of the structure.
  PivotSigns signs() const { return {signs_.negative, is_outside_ ? infinite : signs_.growth}; }

 private:
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  double relative(const SupernodeShape& shape, std::int64_t i) const {
    return (*inverse_scale_)[static_cast<std::size_t>(shape.row_numbers[i])];
  }

  struct Freed {
    void operator()(double* memory) const { std::free(memory); }
  };
  const SupernodalFactor* structure_;
  const OrderedEntries* entries_;
  const std::vector<double>* inverse_scale_;
  std::vector<double> pivots_;
  std::unique_ptr<double, Freed> columns_;
  std::int64_t largest_ = 0;
  PivotSigns signs_;
  bool is_outside_ = false;
};

}  // namespace

Multifrontal::Multifrontal(const SupernodalFactor& structure, int threads)
    : structure_(structure), threads_(threads), tree_(structure), plan_(structure, tree_, share_out(tree_, threads)) {}

double Multifrontal::working_bytes() const { return 8.0 * static_cast<double>(plan_.numbers(workers())); }

int Multifrontal::workers() const {
  return static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(threads_), plan_.subtrees()));
}

std::optional<std::int64_t> Multifrontal::factorise(const BorderedPart& a, double* values) const {
  const BlasThreads one(1);
  SpreadEntries(structure_, values).spread(a, threads_);
  std::vector<KeptColumns> columns(static_cast<std::size_t>(workers()), KeptColumns(structure_, values));
  const std::int64_t failed = Elimination<KeptColumns>(structure_, plan_, columns).run();
  if (failed < 0) return std::nullopt;
  return failed;
}

PivotSigns Multifrontal::count_signs(SymmetricMatrix a, const std::vector<double>& scale) const {
  const BlasThreads one(1);
  const OrderedEntries entries(structure_, a);
  a = {};
  std::vector<double> inverse_scale(scale.size());
  for (std::size_t k = 0; k < scale.size(); ++k)
    inverse_scale[k] = 1 / scale[static_cast<std::size_t>(structure_.order[k])];
  std::vector<CountedColumns> columns;
  for (int k = 0; k < workers(); ++k) columns.emplace_back(structure_, entries, inverse_scale);
  Elimination<CountedColumns>(structure_, plan_, columns).run();
  PivotSigns all;
  for (const CountedColumns& part : columns) {
    all.negative += part.signs().negative;
    all.growth = std::max(all.growth, part.signs().growth);
  }
  return all;
}

}  // namespace bielle

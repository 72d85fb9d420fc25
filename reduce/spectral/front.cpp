#include "reduce/spectral/front.hpp"

#include <algorithm>
#include <cmath>

#include <cblas.h>

extern "C" void dpotrf_(const char* triangle, const int* n, double* a, const int* stride, int* info);

namespace bielle {

namespace {

constexpr std::int64_t narrow = 64, narrow_of_team = 128;  // columns that LAPACK eliminates while others wait
constexpr std::int64_t product_strip = 256;  // columns of a product, of which the rows above the diagonal are left out

int integer(std::int64_t k) { return static_cast<int>(k); }

/// C <- C - A B^T, (rows,columns), by columns; `depth` columns of A and B, all with the same stride but C.
void subtract_product(std::int64_t rows, std::int64_t columns, std::int64_t depth, const double* a, const double* b,
                      std::int64_t stride, double scale, double* c, std::int64_t c_stride) {
  if (rows <= 0 || columns <= 0) return;
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, integer(rows), integer(columns), integer(depth), -1, a,
              integer(stride), b, integer(stride), scale, c, integer(c_stride));
}

/// L D L^T of a small matrix (n,n), lower triangle: L below the diagonal, D on it.
void factorise_indefinite(std::int64_t n, double* a, std::int64_t stride) {
  for (std::int64_t k = 0; k < n; ++k) {
    const double* const pivot_column = a + k * stride;
    const double inverse = 1 / pivot_column[k];
    for (std::int64_t j = k + 1; j < n; ++j) {
      const double factor = pivot_column[j] * inverse;
      double* const column = a + j * stride;
      for (std::int64_t i = j; i < n; ++i) column[i] -= factor * pivot_column[i];
    }
    double* const own = a + k * stride;
    for (std::int64_t i = k + 1; i < n; ++i) own[i] *= inverse;
  }
}

struct RowShare {
  std::int64_t first, count;
};

/// Rows `first` to `end` of the front, a part for each of the team.
RowShare own_share(std::int64_t first, std::int64_t end, const Team& team) {
  constexpr std::int64_t line = 8;  // numbers of a line of the cache
  const auto bound = [&](std::int64_t k) {
    return std::min(end, first + ((end - first) * k / team.size() + line - 1) / line * line);
  };
  const std::int64_t from = bound(team.rank());
  return {from, (team.rank() + 1 == team.size() ? end : bound(team.rank() + 1)) - from};
}

/// The elimination of columns first .. first + width of a front; the rows are shared out.
class ColumnElimination {
 public:
  ColumnElimination(const Front& front, double* pivots, Team& team) : front_(front), pivots_(pivots), team_(team) {}

  /// One half, then the other less what it takes from the first, so that most is done by large products. What columns
  /// further left take is gone already.
  /// @returns the column of a pivot that is not positive, or -1
  std::int64_t eliminate(std::int64_t first, std::int64_t width) {
    if (width <= (team_.size() == 1 ? narrow : narrow_of_team)) return eliminate_narrow(first, width);
    constexpr std::int64_t of_vector = 16;
    const std::int64_t half = (width / 2 + of_vector - 1) / of_vector * of_vector;
    if (const std::int64_t failed = eliminate(first, half); failed >= 0) return failed;
    for (std::int64_t done = half; done < width; done += product_strip)
      subtract(first, half, first + done, std::min(product_strip, width - done));
    team_.wait();
    return eliminate(first + half, width - half);
  }

 private:
  double* at(std::int64_t row, std::int64_t column) const { return front_.columns + row + column * front_.rows; }

  /// What `width` columns from `to` on take from `depth` columns from `from` on.
  void subtract(std::int64_t from, std::int64_t depth, std::int64_t to, std::int64_t width) const {
    const auto [row, count] = own_share(to, front_.rows, team_);
    const double* const left = front_.scaled != nullptr ? front_.scaled : front_.columns;
    subtract_product(count, width, depth, at(row, from), left + to + from * front_.rows, front_.rows, 1, at(row, to),
                     front_.rows);
  }
  std::int64_t eliminate_narrow(std::int64_t first, std::int64_t width) {
    std::int64_t& failed = team_.common();
    team_.once([&] { failed = factorise_diagonal(first, width); });
    if (failed >= 0) return failed;
    solve_below(first, width);
    team_.wait();
    return -1;
  }
  std::int64_t factorise_diagonal(std::int64_t first, std::int64_t width) const {
    double* const diagonal = at(first, first);
    if (pivots_ == nullptr) {
      int info = 0;
      const int n = integer(width), stride = integer(front_.rows);
      dpotrf_("L", &n, diagonal, &stride, &info);
      return info > 0 ? first + info - 1 : -1;
    }
    factorise_indefinite(width, diagonal, front_.rows);
    for (std::int64_t k = 0; k < width; ++k) {
      const double* const column = diagonal + k * front_.rows;
      pivots_[first + k] = column[k];
      std::copy(column + k, column + width, front_.scaled + first + k + (first + k) * front_.rows);
    }
    return -1;
  }
  void solve_below(std::int64_t first, std::int64_t width) const {
    const auto [row, count] = own_share(first + width, front_.rows, team_);
    if (count <= 0) return;
    cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, pivots_ != nullptr ? CblasUnit : CblasNonUnit,
                integer(count), integer(width), 1, at(first, first), integer(front_.rows), at(row, first),
                integer(front_.rows));
    if (pivots_ == nullptr) return;
    for (std::int64_t k = 0; k < width; ++k) {
      const double inverse = 1 / pivots_[first + k];
      const double* const from = at(row, first + k);
      double* const to = front_.scaled + row + (first + k) * front_.rows;
      for (std::int64_t i = 0; i < count; ++i) to[i] = inverse * from[i];
    }
  }

  const Front& front_;
  double* pivots_;
  Team& team_;
};

}  // namespace

std::int64_t eliminate_columns(const Front& front, double* pivots, Team& team) {
  return ColumnElimination(front, pivots, team).eliminate(0, front.width);
}

void add_to_update(const Front& front, bool is_empty, Team& team) {
  const UpdatePanels panels = front.panels();
  const double before = is_empty ? 0 : 1;
  const double* const a = front.columns + front.width;
  team.share(panels.count(), [&](std::int64_t k) {
    const std::int64_t first = k * panels.width(), width = panels.columns(k), rows = panels.rows(k);
    double* const to = front.update + panels.offset(k);
    if (front.scaled != nullptr)
      return subtract_product(rows, width, front.width, a + first, front.scaled + front.width + first, front.rows,
                              before, to, rows);
    cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, integer(width), integer(front.width), -1, a + first,
                integer(front.rows), before, to, integer(rows));
    subtract_product(rows - width, width, front.width, a + first + width, a + first, front.rows, before, to + width,
                     rows);
  });
}

}  // namespace bielle

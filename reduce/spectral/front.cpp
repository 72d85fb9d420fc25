#include "reduce/spectral/front.hpp"

#include <algorithm>
#include <cmath>

#include <cblas.h>

extern "C" void dpotrf_(const char* triangle, const int* n, double* a, const int* stride, int* info);

namespace bielle {

namespace {

constexpr std::int64_t panel_width = 128;

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

/// Columns first .. first + width of L, of which the rows below the panel are shared out.
class Panel {
 public:
  Panel(const Front& front, std::int64_t first)
      : front_(front), first_(first), width_(std::min(panel_width, front.width - first)) {}

  /// What the columns to the left take from it.
  void subtract_left(const Team& team) const {
    if (first_ == 0) return;
    const auto [row, count] = own_share(first_, front_.rows, team);
    const double* const left = front_.scaled != nullptr ? front_.scaled : front_.columns;
    subtract_product(count, width_, first_, front_.columns + row, left + first_, front_.rows, 1, at(row), front_.rows);
  }
  /// @returns the column of a pivot that is not positive, or -1
  std::int64_t factorise_diagonal(double* pivots) const {
    if (pivots == nullptr) {
      int info = 0;
      const int n = integer(width_), stride = integer(front_.rows);
      dpotrf_("L", &n, at(first_), &stride, &info);
      return info > 0 ? first_ + info - 1 : -1;
    }
    factorise_indefinite(width_, at(first_), front_.rows);
    for (std::int64_t k = 0; k < width_; ++k) {
      const double* const column = at(first_) + k * front_.rows;
      pivots[first_ + k] = column[k];
      std::copy(column + k, column + width_, front_.scaled + first_ + k + (first_ + k) * front_.rows);
    }
    return -1;
  }
  void solve_below(const double* pivots, const Team& team) const {
    const auto [row, count] = own_share(first_ + width_, front_.rows, team);
    if (count <= 0) return;
    cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, pivots != nullptr ? CblasUnit : CblasNonUnit,
                integer(count), integer(width_), 1, at(first_), integer(front_.rows), at(row), integer(front_.rows));
    if (pivots == nullptr) return;
    for (std::int64_t k = 0; k < width_; ++k) {
      const double inverse = 1 / pivots[first_ + k];
      const double* const from = at(row) + k * front_.rows;
      double* const to = front_.scaled + row + (first_ + k) * front_.rows;
      for (std::int64_t i = 0; i < count; ++i) to[i] = inverse * from[i];
    }
  }

 private:
  double* at(std::int64_t row) const { return front_.columns + row + first_ * front_.rows; }

  const Front& front_;
  std::int64_t first_, width_;
};

}  // namespace

std::int64_t eliminate_columns(const Front& front, double* pivots, Team& team) {
  for (std::int64_t first = 0; first < front.width; first += panel_width) {
    const Panel panel(front, first);
    panel.subtract_left(team);
    team.wait();
    std::int64_t& failed = team.common();
    team.once([&] { failed = panel.factorise_diagonal(pivots); });
    if (failed >= 0) return failed;
    panel.solve_below(pivots, team);
    team.wait();
  }
  return -1;
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

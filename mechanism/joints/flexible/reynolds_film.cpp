#include "mechanism/joints/flexible/reynolds_film.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/SparseCholesky>

#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

using std::numbers::pi;
using FilmMatrix = Eigen::SparseMatrix<double>;

/// Weights of Clenshaw and Curtis at z = sin(pi j/(2 m)), j < m, for even functions over |z| < 1 that vanish at its
/// ends.
VectorX weights_along(int m) {
  VectorX weights(m);
  for (int j = 0; j < m; ++j) {
    double sum = 1;
    for (int k = 1; k <= m; ++k)
      sum -= (k == m ? 1 : 2) / (4.0 * k * k - 1) * std::cos(k * pi * static_cast<double>(m - j) / m);
    weights[j] = (j == 0 ? 1 : 2) * sum / m;
  }
  return weights;
}

/// The discrete equations: row i around, j along, i.e. cell i m + j.
class FilmCells {
 public:
  FilmCells(double a, double d, double slenderness, int around, int along);
  int around() const { return n_; }
  const std::vector<char>& wet() const { return wet_; }
  /// Begins with the cells whose source is positive.
  void begin();
  /// Begins with the wet cells of a grid of half as many cells around.
  void begin(const std::vector<char>& coarse);
  /// Finds the wet cells and their pressure.
  void solve();
  Vector2 force() const;

 private:
  double thickness(double s) const { return 1 - a_ * std::cos(s) - d_ * std::sin(s); }
  int before(int i) const { return (i + n_ - 1) % n_; }
  int after(int i) const { return (i + 1) % n_; }
  Eigen::Index at(int i, int j) const { return static_cast<Eigen::Index>(i) * m_ + j; }
  double diagonal(int i, int j) const {
    return height_[j] * (flow_[before(i)] + flow_[i]) + side_[i] * (reach_[j] + (j > 0 ? reach_[j - 1] : 0));
  }
  void find_pressure();
  bool move_edge();

  double a_, d_, slenderness_;
  int n_, m_, first_ = 0;       // first_: the row at s = pi, at which the numbers of the equations begin
  VectorX s_, width_, source_;  // of rows
  VectorX flow_, side_;         // conductance from row to row, and along z
  VectorX height_, reach_;      // of cells along z: size, 1/distance to the next one
  std::vector<char> wet_;
  VectorX p_;
};

FilmCells::FilmCells(double a, double d, double slenderness, int around, int along)
    : a_(a), d_(d), slenderness_(slenderness), n_(around), m_(along) {
  const double e = std::hypot(a, d), middle = e > 0 ? std::atan2(d, a) : 0;
  // s = middle + 2 atan(ratio tan(t/2)): a peak has the width sqrt(1 - e), and the wide gap needs cells as well.
  constexpr double grading = 0.3;
  const double ratio = std::pow((1 - e) / (1 + e), grading), step = 2 * pi / n_;
  const auto angle = [&](double i) {
    const double half = 0.5 * (step * i - pi);
    return middle + 2 * std::atan2(ratio * std::sin(half), std::cos(half));
  };
  const auto resistance = [&](double i) {  // h^-3 ds/dt
    const double half = 0.5 * (step * i - pi), cosine = std::cos(half), sine = std::sin(half);
    return ratio / (cosine * cosine + ratio * ratio * sine * sine) / std::pow(thickness(angle(i)), 3);
  };
  s_.resize(n_);
  width_.resize(n_);
  source_.resize(n_);
  flow_.resize(n_);
  side_.resize(n_);
  double nearest = 2 * pi;
  for (int i = 0; i < n_; ++i) {
    s_[i] = angle(i);
    const double begin = angle(i - 0.5), end = angle(i + 0.5);
    width_[i] = end - begin;
    source_[i] = std::sin(end) - std::sin(begin);
    side_[i] = std::pow(thickness(s_[i]), 3) * width_[i];
    flow_[i] = 6 / (step * (resistance(i) + 4 * resistance(i + 0.5) + resistance(i + 1)));
    const double turn = std::remainder(s_[i] - pi, 2 * pi);
    if (turn >= 0 && turn < nearest) {
      nearest = turn;
      first_ = i;
    }
  }
  const auto place = [&](double j) { return slenderness * std::sin(0.5 * pi * j / m_); };
  height_.resize(m_);
  reach_.resize(m_);
  for (int j = 0; j < m_; ++j) {
    reach_[j] = 1 / (place(j + 1) - place(j));
    height_[j] = 0.5 * (place(j + 1) - (j > 0 ? place(j - 1) : 0));
  }
}

void FilmCells::begin() {
  wet_.assign(static_cast<std::size_t>(n_) * static_cast<std::size_t>(m_), 0);
  for (int i = 0; i < n_; ++i)
    for (int j = 0; j < m_; ++j) wet_[static_cast<std::size_t>(at(i, j))] = source_[i] > 0;
}

void FilmCells::begin(const std::vector<char>& coarse) {
  wet_.resize(static_cast<std::size_t>(n_) * static_cast<std::size_t>(m_));
  for (int i = 0; i < n_; ++i)
    for (int j = 0; j < m_; ++j)
      wet_[static_cast<std::size_t>(at(i, j))] = coarse[static_cast<std::size_t>(at(i / 2, j))];
}

/// Solves the equations of the wet cells, in the order around from s = pi: their band is as wide as the length.
void FilmCells::find_pressure() {
  std::vector<int> number(wet_.size(), -1);
  std::vector<std::pair<int, int>> cells;
  for (int k = 0; k < n_; ++k)
    for (int i = (first_ + k) % n_, j = 0; j < m_; ++j)
      if (wet_[static_cast<std::size_t>(at(i, j))] != 0) {
        number[static_cast<std::size_t>(at(i, j))] = static_cast<int>(cells.size());
        cells.emplace_back(i, j);
      }
  const auto count = static_cast<Eigen::Index>(cells.size());
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(3 * cells.size());
  VectorX known(count);
  for (int row = 0; row < count; ++row) {
    const auto [i, j] = cells[static_cast<std::size_t>(row)];
    known[row] = source_[i] * height_[j];
    entries.emplace_back(row, row, diagonal(i, j));
    const auto couple = [&](Eigen::Index to, double conductance) {
      const int other = number[static_cast<std::size_t>(to)];
      if (other >= 0) entries.emplace_back(std::max(row, other), std::min(row, other), -conductance);
    };
    couple(at(after(i), j), height_[j] * flow_[i]);
    if (j + 1 < m_) couple(at(i, j + 1), side_[i] * reach_[j]);
  }
  FilmMatrix matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLLT<FilmMatrix, Eigen::Lower, Eigen::NaturalOrdering<int>> factor(matrix);
  if (factor.info() != Eigen::Success) throw ComputationError("the pressure of an oil film has no finite value");
  const VectorX found = factor.solve(known);
  p_.setZero(static_cast<Eigen::Index>(wet_.size()));
  for (std::size_t row = 0; row < cells.size(); ++row)
    p_[at(cells[row].first, cells[row].second)] = found[static_cast<Eigen::Index>(row)];
}

/// Dries cells of negative pressure and wets dry ones that would gain pressure; tells whether there were any.
bool FilmCells::move_edge() {
  constexpr double rounding = 1e-12;
  const double most = p_.maxCoeff();
  bool moved = false;
  std::vector<char> next = wet_;
  for (int i = 0; i < n_; ++i)
    for (int j = 0; j < m_; ++j) {
      const auto cell = static_cast<std::size_t>(at(i, j));
      if (wet_[cell] != 0) {
        next[cell] = p_[at(i, j)] >= 0;
      } else {
        double gain =
            height_[j] * (source_[i] + flow_[before(i)] * p_[at(before(i), j)] + flow_[i] * p_[at(after(i), j)]);
        if (j + 1 < m_) gain += side_[i] * reach_[j] * p_[at(i, j + 1)];
        if (j > 0) gain += side_[i] * reach_[j - 1] * p_[at(i, j - 1)];
        next[cell] = gain > rounding * diagonal(i, j) * most;
      }
      moved = moved || next[cell] != wet_[cell];
    }
  wet_ = std::move(next);
  return moved;
}

void FilmCells::solve() {
  constexpr int most = 200;
  for (int iteration = 0; iteration < most; ++iteration) {
    find_pressure();
    if (!move_edge()) return;
  }
  throw ComputationError("the edge of an oil film is not found");
}

Vector2 FilmCells::force() const {
  const VectorX along = slenderness_ * weights_along(m_);
  Vector2 W = Vector2::Zero();
  for (int i = 0; i < n_; ++i)
    W += width_[i] * along.dot(p_.segment(at(i, 0), m_)) * Vector2(std::cos(s_[i]), std::sin(s_[i]));
  return 12 / std::pow(2 * slenderness_, 3) * W;
}

}  // namespace

Vector2 reynolds_film(double a, double d, double slenderness, const FilmGrid& grid) {
  std::vector<char> wet;
  for (const int coarser : {4, 2, 1}) {
    FilmCells cells(a, d, slenderness, grid.around / coarser, grid.along);
    if (wet.empty())
      cells.begin();
    else
      cells.begin(wet);
    cells.solve();
    if (coarser == 1) return cells.force();
    wet = cells.wet();
  }
  return Vector2::Zero();
}

}  // namespace bielle::mechanism

#include "mechanism/solvers/linearised/harmonic_equations.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace bielle::mechanism {
namespace {

using Sparse = LinearisedEquations::Sparse;
using Entries = std::vector<Eigen::Triplet<double>>;

/// Returns the function f_p at an azimuth.
double harmonic_function(int p, double psi) {
  const int m = (p + 1) / 2;
  return p == 0 ? 1 : p % 2 == 1 ? std::cos(m * psi) : std::sin(m * psi);
}

/// Returns the mean of e_p f_r e_q, where e are the functions f with the mean square 1. Products of two functions are
/// sums of cosines (none is left if one or three of the functions are sines).
double product_coefficient(int p, int r, int q) {
  std::array<int, 3> functions{p, r, q};
  const auto is_sine = [](int k) { return k > 0 && k % 2 == 0; };
  const auto sines = std::partition(functions.begin(), functions.end(), is_sine) - functions.begin();
  if (sines % 2 == 1) return 0;
  const auto order = [](int k) { return (k + 1) / 2; };
  const int a = order(functions[0]), b = order(functions[1]), c = order(functions[2]);
  const auto mean = [c](int k) { return std::abs(k) != c ? 0 : c == 0 ? 1 : 0.5; };  // mean of cos(k psi) cos(c psi)
  const double size = (p > 0 ? std::numbers::sqrt2 : 1) * (q > 0 ? std::numbers::sqrt2 : 1);
  return size * 0.5 * (mean(a - b) + (sines == 2 ? -1 : 1) * mean(a + b));
}

/// Largest entries of a matrix over the azimuths, for each kind of row and of column.
struct EntrySizes {
  std::array<std::array<double, 2>, 2> most{};
  EntrySizes(const std::vector<const Sparse*>& A, const std::vector<char>& row_kind,
             const std::vector<char>& column_kind)
      : row_kind_(row_kind), column_kind_(column_kind) {
    for (const Sparse* each : A)
      for (int j = 0; j < each->outerSize(); ++j)
        for (Sparse::InnerIterator it(*each, j); it; ++it) {
          double& size = most[kind(row_kind_, it.row())][kind(column_kind_, j)];
          size = std::max(size, std::abs(it.value()));
        }
  }
  void at_least(double factor, const EntrySizes& other) {
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < 2; ++j) most[i][j] = std::max(most[i][j], factor * other.most[i][j]);
  }
  /// Calculates the rounding errors that the largest entries cause in the others by lever arms.
  /// @param row,column  scales of both kinds: 1 and the mechanism's length, or 1 and 1
  void calc_rounding(const std::array<double, 2>& row, const std::array<double, 2>& column) {
    constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();
    double largest = 0;
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < 2; ++j) largest = std::max(largest, most[i][j] / (row[i] * column[j]));
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < 2; ++j) rounding_[i][j] = rounding * largest * row[i] * column[j];
  }
  /// Returns this share of the size of entries of the same kinds, but no less than their rounding.
  double share(double part, Eigen::Index i, Eigen::Index j) const {
    const std::size_t a = kind(row_kind_, i), b = kind(column_kind_, j);
    return std::max(part * most[a][b], rounding_[a][b]);
  }

 private:
  static std::size_t kind(const std::vector<char>& kinds, Eigen::Index k) {
    return kinds[static_cast<std::size_t>(k)] != 0 ? 1 : 0;
  }
  const std::vector<char>&row_kind_, &column_kind_;
  std::array<std::array<double, 2>, 2> rounding_{};
};

std::vector<const Sparse*> list_of(const std::vector<LinearisedEquations>& azimuths,
                                   Sparse LinearisedEquations::*matrix) {
  std::vector<const Sparse*> list;
  for (const LinearisedEquations& equations : azimuths) list.push_back(&(equations.*matrix));
  return list;
}

/// Computes the coefficients, without those that are only rounding errors. @param resolved  set to false if the last of
/// them is not negligible
HarmonicMatrix decompose(const std::vector<const Sparse*>& A, const EntrySizes& sizes, bool& resolved) {
  const auto count = static_cast<int>(A.size());
  constexpr double rounding = 1e-12, rapid = 1e-8;
  HarmonicMatrix result;
  for (int p = 0; p < count; ++p) {
    const int m = (p + 1) / 2;
    const bool last = 2 * m == count;
    const double weight = (p == 0 || last ? 1.0 : 2.0) / count;
    Sparse sum(A[0]->rows(), A[0]->cols());
    for (int k = 0; k < count; ++k)
      sum += (weight * harmonic_function(p, 2 * std::numbers::pi * k / count)) * *A[static_cast<std::size_t>(k)];
    sum.prune([&](Eigen::Index i, Eigen::Index j, double value) {
      return p == 0 ? value != 0 : std::abs(value) > sizes.share(last ? rapid : rounding, i, j);
    });
    if (last && sum.nonZeros() > 0) resolved = false;
    result.push_back(sum);
  }
  return result;
}

bool varies(const HarmonicMatrix& A) {
  return std::any_of(A.begin() + 1, A.end(), [](const Sparse& part) { return part.nonZeros() > 0; });
}

}  // namespace

PeriodicEquations::PeriodicEquations(const std::vector<LinearisedEquations>& azimuths, double rate, double length)
    : rate_(rate), first_(azimuths.front()) {
  const std::vector<char>& kinds = first_.turns;
  const std::vector<char> rows(static_cast<std::size_t>(first_.constraints()), 0);
  const auto M = list_of(azimuths, &LinearisedEquations::M), C = list_of(azimuths, &LinearisedEquations::C),
             K = list_of(azimuths, &LinearisedEquations::K), B = list_of(azimuths, &LinearisedEquations::B),
             S = list_of(azimuths, &LinearisedEquations::S), F = list_of(azimuths, &LinearisedEquations::F);
  EntrySizes of_M(M, kinds, kinds), of_B(B, rows, kinds), of_C(C, kinds, kinds), of_K(K, kinds, kinds),
      of_S(S, rows, kinds), of_F(F, kinds, rows);
  of_C.at_least(std::abs(rate), of_M);
  of_K.at_least(std::abs(rate), of_C);
  of_S.at_least(std::abs(rate), of_B);
  const std::array<double, 2> of_motion{1, length}, of_rows{1, 1};
  for (EntrySizes* each : {&of_M, &of_C, &of_K}) each->calc_rounding(of_motion, of_motion);
  for (EntrySizes* each : {&of_B, &of_S}) each->calc_rounding(of_rows, of_motion);
  of_F.calc_rounding(of_motion, of_rows);
  M_ = decompose(M, of_M, resolved_);
  C_ = decompose(C, of_C, resolved_);
  K_ = decompose(K, of_K, resolved_);
  B_ = decompose(B, of_B, resolved_);
  S_ = decompose(S, of_S, resolved_);
  F_ = decompose(F, of_F, resolved_);
  for (const HarmonicMatrix* each : {&M_, &C_, &K_, &B_, &S_, &F_}) constant_ = constant_ && !varies(*each);
}

double PeriodicEquations::function(int p, double psi) {
  return (p > 0 ? std::numbers::sqrt2 : 1) * harmonic_function(p, psi);
}

int PeriodicEquations::index(int function, int unknown, int h) const {
  const int n = first_.unknowns(), d = first_.dofs, functions = 2 * h + 1;
  return unknown < d ? function * d + unknown : functions * d + function * (n - d) + unknown - d;
}

Eigen::MatrixXcd PeriodicEquations::amplitudes(const Eigen::VectorXcd& y, int h) const {
  const int functions = 2 * h + 1;
  const auto n = static_cast<int>(y.size()) / functions;
  const auto part = [&](int p) {
    Eigen::VectorXcd u(n);
    for (int i = 0; i < n; ++i) u[i] = y[index(p, i, h)];
    return u;
  };
  Eigen::MatrixXcd result(n, functions);
  result.col(h) = part(0);
  const std::complex<double> i(0, 1);
  for (int m = 1; m <= h; ++m) {
    const Eigen::VectorXcd c = part(2 * m - 1), s = part(2 * m);
    result.col(h + m) = (c - i * s) / std::numbers::sqrt2;
    result.col(h - m) = (c + i * s) / std::numbers::sqrt2;
  }
  return result;
}

Eigen::VectorXcd PeriodicEquations::coefficients(const Eigen::MatrixXcd& amplitudes) const {
  const auto n = static_cast<int>(amplitudes.rows()), h = static_cast<int>(amplitudes.cols() / 2);
  Eigen::VectorXcd y(amplitudes.size());
  const auto set_function = [&](int p, const Eigen::VectorXcd& part) {
    for (int i = 0; i < n; ++i) y[index(p, i, h)] = part[i];
  };
  set_function(0, amplitudes.col(h));
  const std::complex<double> i(0, 1);
  for (int m = 1; m <= h; ++m) {
    set_function(2 * m - 1, (amplitudes.col(h + m) + amplitudes.col(h - m)) / std::numbers::sqrt2);
    set_function(2 * m, i * (amplitudes.col(h + m) - amplitudes.col(h - m)) / std::numbers::sqrt2);
  }
  return y;
}

LinearisedEquations PeriodicEquations::at(double psi) const {
  LinearisedEquations e = first_;
  const auto set_at = [psi](const HarmonicMatrix& A, Sparse& to) {
    to = A[0];
    for (std::size_t p = 1; p < A.size(); ++p)
      if (A[p].nonZeros() > 0) to += harmonic_function(static_cast<int>(p), psi) * A[p];
  };
  set_at(M_, e.M);
  set_at(C_, e.C);
  set_at(K_, e.K);
  set_at(B_, e.B);
  set_at(S_, e.S);
  set_at(F_, e.F);
  return e;
}

LinearisedEquations PeriodicEquations::of_harmonics(int h) const {
  const int functions = 2 * h + 1, n = first_.unknowns(), m = first_.constraints();
  const auto unknown = [&](int p, int i) { return index(p, i, h); };
  const auto row = [&](int p, int i) { return p * m + i; };
  const auto spread = [&](const HarmonicMatrix& A, const auto& to_row, const auto& to_column, int rows, int columns) {
    Entries entries;
    for (int p = 0; p < functions; ++p)
      for (int q = 0; q < functions; ++q)
        for (int r = 0; r < static_cast<int>(A.size()); ++r) {
          const Sparse& part = A[static_cast<std::size_t>(r)];
          const double factor = part.nonZeros() > 0 ? product_coefficient(p, r, q) : 0;
          if (factor == 0) continue;
          for (int j = 0; j < part.outerSize(); ++j)
            for (Sparse::InnerIterator it(part, j); it; ++it)
              entries.emplace_back(to_row(p, static_cast<int>(it.row())), to_column(q, j), factor * it.value());
        }
    Sparse whole(rows, columns);
    whole.setFromTriplets(entries.begin(), entries.end());
    return whole;
  };
  const int N = functions * n, R = functions * m;
  LinearisedEquations e;
  e.dofs = functions * first_.dofs;
  e.M = spread(M_, unknown, unknown, N, N);
  e.K = spread(K_, unknown, unknown, N, N);
  e.B = spread(B_, row, unknown, R, N);
  e.S = spread(S_, row, unknown, R, N);
  e.F = spread(F_, unknown, row, N, R);
  Entries rates, derivative;
  for (int k = 1; k <= h; ++k)
    for (int i = 0; i < n; ++i) {
      derivative.emplace_back(unknown(2 * k - 1, i), unknown(2 * k, i), k * rate_);
      derivative.emplace_back(unknown(2 * k, i), unknown(2 * k - 1, i), -k * rate_);
    }
  for (int p = 0; p < functions; ++p)
    for (int j = 0; j < n; ++j)
      for (Sparse::InnerIterator it(first_.W, j); it; ++it)
        rates.emplace_back(unknown(p, static_cast<int>(it.row())), unknown(p, j), it.value());
  Sparse D(N, N), W(N, N);
  D.setFromTriplets(derivative.begin(), derivative.end());
  W.setFromTriplets(rates.begin(), rates.end());
  e.W = W + D;
  e.C = spread(C_, unknown, unknown, N, N) + Sparse(e.M * D);
  e.group.resize(static_cast<std::size_t>(N));
  e.turns.resize(static_cast<std::size_t>(N));
  e.left_over.resize(N);
  const int groups = first_.group.empty() ? 0 : 1 + *std::max_element(first_.group.begin(), first_.group.end());
  for (int p = 0; p < functions; ++p) {
    for (int i = 0; i < n; ++i) {
      const auto at = static_cast<std::size_t>(unknown(p, i)), from = static_cast<std::size_t>(i);
      e.group[at] = first_.group.empty() ? unknown(p, i) : p * groups + first_.group[from];
      e.turns[at] = first_.turns[from];
      e.left_over[unknown(p, i)] = first_.left_over[i];
    }
    e.nonholonomic.insert(e.nonholonomic.end(), first_.nonholonomic.begin(), first_.nonholonomic.end());
    e.multiplier.insert(e.multiplier.end(), first_.multiplier.begin(), first_.multiplier.end());
  }
  return e;
}

}  // namespace bielle::mechanism

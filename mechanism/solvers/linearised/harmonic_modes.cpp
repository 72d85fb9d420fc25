#include "mechanism/solvers/linearised/harmonic_modes.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mechanism/solvers/linearised/mode_judgement.hpp"
#include "mechanism/solvers/linearised/shifted_operator.hpp"

namespace bielle::mechanism {

/// Sizes of the harmonics of both parts.
struct HarmonicSearch::Sizes {
  VectorX standing, turning;

  /// Sizes of the part that decides which exponent is the principal one.
  const VectorX& deciding() const {
    constexpr double moves = 1e-9;
    return standing.sum() > moves * turning.sum() ? standing : turning;
  }
};

namespace {

/// Returns the amplitudes with zeros for further harmonics.
Eigen::MatrixXcd widened(const Eigen::MatrixXcd& amplitudes, int h) {
  Eigen::MatrixXcd wide = Eigen::MatrixXcd::Zero(amplitudes.rows(), 2 * h + 1);
  wide.middleCols(h - amplitudes.cols() / 2, amplitudes.cols()) = amplitudes;
  return wide;
}

}  // namespace

/// Computes sums of kinetic and potential energies of single unknowns, which need no inertia.
HarmonicSearch::Sizes HarmonicSearch::sizes_of(const Eigen::MatrixXcd& u, std::complex<double> s) const {
  const LinearisedEquations& e = equations_.first();
  const VectorX weight =
      e.K.diagonal().cwiseAbs() + (std::norm(s) + std::pow(equations_.rate(), 2)) * e.M.diagonal().cwiseAbs();
  Sizes sizes{VectorX::Zero(u.cols()), VectorX::Zero(u.cols())};
  for (Eigen::Index k = 0; k < u.cols(); ++k)
    for (Eigen::Index i = 0; i < u.rows(); ++i)
      (turning_[static_cast<std::size_t>(i)] != 0 ? sizes.turning : sizes.standing)[k] +=
          weight[i] * std::norm(u(i, k));
  return sizes;
}

bool HarmonicSearch::is_principal(const Sizes& sizes) const {
  constexpr double equal = 1e-6;
  const VectorX& decides = sizes.deciding();
  const Eigen::Index middle = decides.size() / 2;
  return decides[middle] > 0 && decides[middle] >= (1 - equal) * decides.maxCoeff();
}

double HarmonicSearch::whirl_of(const Sizes& sizes) const {
  const Eigen::Index h = sizes.turning.size() / 2;
  const double whole = sizes.turning.sum();
  if (h == 0 || !(whole > 0)) return NAN;
  // A pattern that runs around forwards has a frequency less by the rate in axes that turn.
  const double less = sizes.turning[h - 1], more = sizes.turning[h + 1];
  constexpr double least = 0.1;
  if (!(less + more > least * whole)) return NAN;
  return std::copysign(1, equations_.rate()) * (less - more) / (less + more);
}

/// Takes the principal modes. @returns whether there are enough
bool HarmonicSearch::take(const Modes& found, const ModeOptions& options, HarmonicModes& result) const {
  result.found.modes.clear();
  result.u.clear();
  result.w.clear();
  result.whirl.clear();
  result.found.states = found.states / (2 * result.harmonics + 1);
  result.found.all = found.all;
  if (result.harmonics == 0) result.found.growing_besides = found.growing_besides;
  int count = 0;
  for (const Mode& mode : found.modes) {
    Eigen::MatrixXcd u = equations_.amplitudes(mode.u, result.harmonics);
    const Sizes sizes = sizes_of(u, mode.s);
    if (!is_principal(sizes)) continue;
    if (mode.kind != ModeKind::rigid && !options.below && ++count > options.count) {
      result.found.all = false;
      return true;
    }
    result.found.modes.push_back(mode);
    result.w.push_back(equations_.amplitudes(mode.w, result.harmonics));
    result.u.push_back(std::move(u));
    result.whirl.push_back(whirl_of(sizes));
  }
  return options.below || found.all || count >= options.count;
}

HarmonicModes HarmonicSearch::find_with(const ModeOptions& options, int harmonics) const {
  HarmonicModes result;
  result.harmonics = harmonics;
  result.equations = equations_.of_harmonics(harmonics);
  ModeOptions search = options;
  if (harmonics > 0) search.count = (2 * harmonics + 1) * options.count + 4;
  constexpr int tries = 4;
  for (int k = 0; k < tries; ++k) {
    if (take(find_modes(result.equations, search), options, result)) break;
    search.count *= 2;
  }
  return result;
}

/// Returns the share of the size of a mode that the harmonics beyond h have. @param u  amplitudes of more harmonics
double HarmonicSearch::share_beyond(int h, const Eigen::MatrixXcd& u, std::complex<double> s) const {
  const Sizes sizes = sizes_of(u, s);
  const VectorX all = sizes.standing + sizes.turning;
  const Eigen::Index middle = all.size() / 2;
  const double whole = all.sum();
  return whole > 0 ? 1 - all.segment(middle - h, 2 * h + 1).sum() / whole : 0;
}

/// Applies the inverted equations with one more harmonic to the modes. @returns the largest share of the result that
/// this harmonic has: zero if the harmonics are exact. One factorisation at a real shift serves all modes.
double HarmonicSearch::defect(const HarmonicModes& modes) const {
  const int h = modes.harmonics;
  const LinearisedEquations next = equations_.of_harmonics(h + 1);
  double slowest = INFINITY;
  for (const Mode& mode : modes.found.modes)
    if (mode.kind != ModeKind::rigid) slowest = std::min(slowest, std::abs(mode.s));
  if (!std::isfinite(slowest)) return 0;
  constexpr double beyond_copies = 1.37;  // a shift off the real eigenvalues of the modes and of their copies
  const ShiftedOperator T(next, beyond_copies * std::max(slowest, std::abs(equations_.rate())));
  if (!T.regular()) return INFINITY;
  const auto scale = T.scale().cast<std::complex<double>>();
  double most = 0;
  for (std::size_t k = 0; k < modes.found.modes.size(); ++k) {
    const Mode& mode = modes.found.modes[k];
    if (mode.kind == ModeKind::rigid) continue;
    Eigen::VectorXcd x(next.states());
    x << equations_.functions(widened(modes.u[k], h + 1)), equations_.functions(widened(modes.w[k], h + 1));
    const Eigen::VectorXcd y = scale.cwiseProduct(T.apply(Eigen::VectorXcd(x.cwiseQuotient(scale))));
    most = std::max(most, share_beyond(h, equations_.amplitudes(y.head(next.unknowns()), h + 1), mode.s));
  }
  return most;
}

/// Takes as the principal exponent that of the largest deciding harmonic. @returns whether it was another one
bool HarmonicSearch::recentre(Mode& mode, Eigen::MatrixXcd& u, Eigen::MatrixXcd& w) const {
  const Sizes sizes = sizes_of(u, mode.s);
  if (is_principal(sizes)) return false;
  const Eigen::Index count = u.cols(), middle = count / 2;
  Eigen::Index largest = middle;
  sizes.deciding().maxCoeff(&largest);
  const Eigen::Index step = largest - middle;
  mode.s += std::complex<double>(0, static_cast<double>(step) * equations_.rate());
  for (Eigen::MatrixXcd* each : {&u, &w}) {
    Eigen::MatrixXcd moved = Eigen::MatrixXcd::Zero(each->rows(), count);
    for (Eigen::Index k = 0; k < count; ++k)
      if (k + step >= 0 && k + step < count) moved.col(k) = each->col(k + step);
    *each = mode.s.imag() < 0 ? Eigen::MatrixXcd(moved.rowwise().reverse().conjugate()) : moved;
  }
  if (mode.s.imag() < 0) mode.s = std::conj(mode.s);
  return true;
}

/// Improves a mode of the equations by inverse iteration.
void HarmonicSearch::iterate(const LinearisedEquations& equations, Mode& mode) const {
  const double size = std::max(std::abs(mode.s), std::abs(equations_.rate()));
  const std::complex<double> off(6e-6, 8e-6);  // a shift next to the exponent, where the equations are regular
  const ShiftedOperator T(equations, mode.s + size * off);
  if (!T.regular()) return;
  const auto scale = T.scale().cast<std::complex<double>>();
  Eigen::VectorXcd x(equations.states());
  x << mode.u, mode.w;
  x = x.cwiseQuotient(scale).eval();
  const bool real = mode.s.imag() == 0;
  constexpr int most = 12;
  constexpr double exact = 1e-11;
  for (int k = 0; k < most; ++k) {
    const Eigen::VectorXcd y = T.apply(x);
    const std::complex<double> s = T.shift() + x.squaredNorm() / x.dot(y), change = s - mode.s;
    mode.residual = (y - x / (s - T.shift())).norm() * std::abs(s - T.shift()) / x.norm();
    mode.s = s;
    x = y / y.norm();
    if (k > 1 && std::abs(change) < exact * size) break;
  }
  constexpr double rounding = 1e-9;
  if (real && std::abs(mode.s.imag()) < rounding * size) mode.s = mode.s.real();
  x = x.cwiseProduct(scale).eval();
  mode.u = x.head(equations.unknowns());
  mode.w = x.tail(equations.dofs);
}

/// Continues modes with more harmonics. @returns whether all are still different ones
bool HarmonicSearch::continue_with(int harmonics, const ModeOptions& options, const HarmonicModes& from,
                                   HarmonicModes& result) const {
  result = {};
  result.harmonics = harmonics;
  result.equations = equations_.of_harmonics(harmonics);
  result.found.states = from.found.states;
  result.found.all = from.found.all;
  const EquationRounding rounding(result.equations);
  const ModeJudgement judgement(result.equations, rounding, options);
  for (std::size_t k = 0; k < from.found.modes.size(); ++k) {
    Mode mode = from.found.modes[k];
    Eigen::MatrixXcd u = widened(from.u[k], harmonics), w = widened(from.w[k], harmonics);
    mode.u = equations_.functions(u);
    mode.w = equations_.functions(w);
    if (mode.kind != ModeKind::rigid) {
      for (int twice = 0; twice < 2; ++twice) {
        iterate(result.equations, mode);
        u = equations_.amplitudes(mode.u, harmonics);
        w = equations_.amplitudes(mode.w, harmonics);
        if (!recentre(mode, u, w)) break;
        mode.u = equations_.functions(u);
        mode.w = equations_.functions(w);
      }
      judgement.judge(mode);
      if (is_known(result, mode, u)) return false;
    }
    result.found.modes.push_back(std::move(mode));
    result.whirl.push_back(whirl_of(sizes_of(u, result.found.modes.back().s)));
    result.u.push_back(std::move(u));
    result.w.push_back(std::move(w));
  }
  return true;
}

/// Whether a mode is among those that were found.
bool HarmonicSearch::is_known(const HarmonicModes& modes, const Mode& mode, const Eigen::MatrixXcd& u) const {
  constexpr double same = 1e-6, parallel = 0.99;
  for (std::size_t k = 0; k < modes.found.modes.size(); ++k) {
    if (std::abs(modes.found.modes[k].s - mode.s) > same * std::abs(mode.s)) continue;
    const double both = std::norm((modes.u[k].conjugate().cwiseProduct(u)).sum());
    if (both > parallel * modes.u[k].squaredNorm() * u.squaredNorm()) return true;
  }
  return false;
}

HarmonicModes HarmonicSearch::find(const ModeOptions& options, int least) const {
  if (equations_.constant()) return find_with(options, 0);
  constexpr int most = 64;
  constexpr double exact = 1e-7, nothing = 1e-12;
  int h = std::max(1, least);
  HarmonicModes modes = find_with(options, h);
  while (true) {
    if (h <= 2) {
      // A mode has a larger share of this harmonic if its exponent is near others: by the square of its distance from
      // the shift over that from them.
      modes.change = defect(modes);
      modes.periodicity = h == 1 ? Periodicity::multiblade : Periodicity::periodic;
      if (modes.change < nothing) return modes;
    }
    const int more = h + std::max(1, h / 2);
    HarmonicModes next;
    if (!continue_with(more, options, modes, next)) {
      modes = find_with(options, more);
      h = more;
      continue;
    }
    modes.change = 0;
    for (std::size_t k = 0; k < next.found.modes.size(); ++k)
      if (next.found.modes[k].kind != ModeKind::rigid)
        modes.change = std::max(modes.change, share_beyond(h, next.u[k], next.found.modes[k].s));
    modes.periodicity = h == 1 && modes.change < exact ? Periodicity::multiblade : Periodicity::periodic;
    if (modes.change < exact) return modes;
    if (more > most)
      throw ComputationError(fmt::format(
          "the modes of the periodic equations do not converge with {} harmonics of the rotation (further ones have "
          "{:.2g} of their energy): ask for fewer modes or for a faster rotation; harmonics are as many as the rate is "
          "contained in the change of a frequency over a turn",
          h, modes.change));
    modes = std::move(next);
    h = more;
  }
}

}  // namespace bielle::mechanism

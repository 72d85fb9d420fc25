#include "mechanism/solvers/linearised/harmonic_modes.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mechanism/solvers/linearised/shifted_operator.hpp"

namespace bielle::mechanism {

/// Sizes of the harmonics of both parts.
struct HarmonicSearch::Sizes {
  VectorX standing, turning;
};

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
  constexpr double moves = 1e-9, equal = 1e-6;
  const double standing = sizes.standing.sum(), turning = sizes.turning.sum();
  const VectorX& decides = standing > moves * turning ? sizes.standing : sizes.turning;
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

/// Computes the largest change of an exponent by one more harmonic, relative to the exponents and the rate, by inverse
/// iteration from the modes that were found.
double HarmonicSearch::change_by_next(const HarmonicModes& modes) const {
  const int h = modes.harmonics, n = equations_.first().unknowns(), dofs = equations_.first().dofs;
  const LinearisedEquations next = equations_.of_harmonics(h + 1);
  const std::complex<double> off(6e-5, 8e-5);  // a shift next to the exponent, where the equations are regular
  double most = 0;
  for (const Mode& mode : modes.found.modes) {
    if (mode.kind == ModeKind::rigid) continue;
    const double size = std::max(std::abs(mode.s), std::abs(equations_.rate()));
    const ShiftedOperator T(next, mode.s + size * off);
    if (!T.regular()) return INFINITY;
    Eigen::VectorXcd x = Eigen::VectorXcd::Zero(next.states());
    for (int p = 0; p < 2 * h + 1; ++p) {
      for (int i = 0; i < n; ++i) x[equations_.index(p, i, h + 1)] = mode.u[equations_.index(p, i, h)];
      for (int i = 0; i < dofs; ++i)
        x[next.unknowns() + equations_.index(p, i, h + 1)] = mode.w[equations_.index(p, i, h)];
    }
    x = x.cwiseQuotient(T.scale().cast<std::complex<double>>()).eval();
    std::complex<double> s = 0;
    constexpr int iterations = 3;
    for (int k = 0; k < iterations; ++k) {
      const Eigen::VectorXcd y = T.apply(x);
      s = T.shift() + x.squaredNorm() / x.dot(y);
      x = y / y.norm();
    }
    most = std::max(most, std::abs(s - mode.s) / size);
  }
  return most;
}

HarmonicModes HarmonicSearch::find(const ModeOptions& options, int least) const {
  if (equations_.constant()) return find_with(options, 0);
  constexpr int most = 8;
  constexpr double exact = 1e-7;
  for (int h = std::max(1, least);; ++h) {
    HarmonicModes modes = find_with(options, h);
    modes.change = change_by_next(modes);
    modes.periodicity = h == 1 && modes.change < exact ? Periodicity::multiblade : Periodicity::periodic;
    if (modes.change < exact) return modes;
    if (h >= most)
      throw ComputationError(fmt::format(
          "the modes of the periodic equations do not converge with {} harmonics of the rotation (one more changes "
          "them by {:.2g}): ask for fewer modes",
          h, modes.change));
  }
}

}  // namespace bielle::mechanism

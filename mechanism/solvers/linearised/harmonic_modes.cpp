#include "mechanism/solvers/linearised/harmonic_modes.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mechanism/solvers/linearised/orthonormal.hpp"
#include "mechanism/solvers/linearised/shifted_operator.hpp"

namespace bielle::mechanism {

/// Sizes of the harmonics of both parts.
struct HarmonicSearch::Sizes {
  VectorX standing, turning;
};

VectorX HarmonicSearch::weights(double rate) const {
  const LinearisedEquations& e = equations_.first();
  return e.K.diagonal().cwiseAbs() + rate * rate * e.M.diagonal().cwiseAbs();
}

/// Computes sums of kinetic and potential energies of single unknowns, which need no inertia.
HarmonicSearch::Sizes HarmonicSearch::sizes_of(const Eigen::MatrixXcd& u, std::complex<double> s) const {
  const VectorX weight = weights(std::hypot(std::abs(s), equations_.rate()));
  Sizes sizes{VectorX::Zero(u.cols()), VectorX::Zero(u.cols())};
  for (Eigen::Index k = 0; k < u.cols(); ++k)
    for (Eigen::Index i = 0; i < u.rows(); ++i)
      (turning_[static_cast<std::size_t>(i)] != 0 ? sizes.turning : sizes.standing)[k] +=
          weight[i] * std::norm(u(i, k));
  return sizes;
}

/// Whether a mode is the shift of the motion in time, or a copy of it: its exponent is a multiple of i rate, and its
/// harmonics are those of the shift. (A mode in resonance with the rotation has another shape.)
bool HarmonicSearch::is_shift(const Eigen::MatrixXcd& u, std::complex<double> s) const {
  if (shift_.size() == 0) return false;
  constexpr double zero = 1e-5, same = 0.1;  // a copy lacks harmonics that are left out
  const double rate = equations_.rate(), k = std::round(s.imag() / rate);
  if (std::abs(s - std::complex<double>(0, k * rate)) > zero * std::abs(rate)) return false;
  const VectorX weight = weights(rate);
  const auto h = static_cast<int>(u.cols() / 2);
  const Eigen::MatrixXcd shift = equations_.amplitudes(of_harmonics(shift_, h), h);
  std::complex<double> product = 0;
  double size = 0, of_shift = 0;
  for (int column = 0; column < u.cols(); ++column) {
    const int from = column + static_cast<int>(k);
    if (from < 0 || from >= u.cols()) continue;
    for (Eigen::Index i = 0; i < u.rows(); ++i) {
      product += weight[i] * std::conj(shift(i, from)) * u(i, column);
      size += weight[i] * std::norm(u(i, column));
      of_shift += weight[i] * std::norm(shift(i, from));
    }
  }
  return std::norm(product) > (1 - same) * size * of_shift;
}

/// Returns coefficients of the functions e_p in the order of the equations of h harmonics.
VectorX HarmonicSearch::of_harmonics(const MatrixX& coefficients, int h) const {
  const auto n = static_cast<int>(coefficients.rows()), functions = 2 * h + 1;
  VectorX y = VectorX::Zero(functions * n);
  for (int p = 0; p < std::min(functions, static_cast<int>(coefficients.cols())); ++p)
    for (int i = 0; i < n; ++i) y[equations_.index(p, i, h)] = coefficients(i, p);
  return y;
}

/// Inserts the shift in time among the rigid modes, unless it is a sum of those.
void HarmonicSearch::add_shift(HarmonicModes& result) const {
  const int h = result.harmonics;
  const VectorX u = of_harmonics(shift_, h);
  const VectorX scale = of_harmonics(weights(equations_.rate()).cwiseSqrt().replicate(1, 2 * h + 1), h);
  std::vector<VectorX> rigid;
  for (const Mode& mode : result.found.modes)
    if (mode.kind == ModeKind::rigid) rigid.emplace_back(scale.cwiseProduct(mode.u.real()));
  MatrixX known(u.size(), static_cast<Eigen::Index>(rigid.size()));
  for (std::size_t k = 0; k < rigid.size(); ++k) known.col(static_cast<Eigen::Index>(k)) = rigid[k];
  if (!rigid.empty()) known = orthonormal_columns(known);
  const VectorX scaled = scale.cwiseProduct(u);
  constexpr double same = 0.3;  // harmonics that are left out
  if ((scaled - known * (known.transpose() * scaled)).norm() < same * scaled.norm()) return;
  Mode mode;
  mode.s = 0;
  mode.kind = ModeKind::rigid;
  mode.u = u.cast<std::complex<double>>();
  mode.w = (result.equations.W * u).head(result.equations.dofs).cast<std::complex<double>>();
  result.u.insert(result.u.begin(), equations_.amplitudes(mode.u, h));
  result.w.insert(result.w.begin(), equations_.amplitudes(mode.w, h));
  result.whirl.insert(result.whirl.begin(), NAN);
  result.found.modes.insert(result.found.modes.begin(), std::move(mode));
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
  const bool shifts = shift_.size() > 0 && !options.near;
  const auto finish = [&](bool enough) {
    if (shifts) add_shift(result);
    return enough;
  };
  for (const Mode& mode : found.modes) {
    Eigen::MatrixXcd u = equations_.amplitudes(mode.u, result.harmonics);
    const bool rigid = mode.kind == ModeKind::rigid && shifts;
    if (!rigid && is_shift(u, mode.s)) continue;
    const Sizes sizes = sizes_of(u, mode.s);
    if (!rigid && !is_principal(sizes)) continue;
    if (mode.kind != ModeKind::rigid && !options.below && ++count > options.count) {
      result.found.all = false;
      return finish(true);
    }
    result.found.modes.push_back(mode);
    result.w.push_back(equations_.amplitudes(mode.w, result.harmonics));
    result.u.push_back(std::move(u));
    result.whirl.push_back(whirl_of(sizes));
  }
  return finish(options.below || found.all || count >= options.count);
}

HarmonicModes HarmonicSearch::find_with(const ModeOptions& options, int harmonics) const {
  HarmonicModes result;
  result.harmonics = harmonics;
  result.equations = equations_.of_harmonics(harmonics);
  ModeOptions search = options;
  if (harmonics > 0) search.count = (2 * harmonics + 1) * options.count + 4;
  constexpr int tries = 4;
  for (int k = 0; k < tries; ++k) {
    if (take(find_modes(result.equations, search), options, result)) return result;
    search.count *= 2;
  }
  if (std::none_of(result.found.modes.begin(), result.found.modes.end(),
                   [](const Mode& mode) { return mode.kind != ModeKind::rigid; }))
    throw ComputationError(
        "the modes of the periodic equations were not found: their rates differ too much (a part that turns hardly "
        "has inertia?)");
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
  const int most = shift_.size() > 0 ? 16 : 8;  // copies of a shift in time converge slowly
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

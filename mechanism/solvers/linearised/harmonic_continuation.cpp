#include "mechanism/solvers/linearised/harmonic_continuation.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "mechanism/solvers/linearised/mode_judgement.hpp"
#include "mechanism/solvers/linearised/shifted_operator.hpp"

namespace bielle::mechanism {
namespace {

using Complex = std::complex<double>;

constexpr double accurate = 1e-8;  // residual of a mode

/// Improves a mode of the equations by inverse iteration.
void iterate(const LinearisedEquations& equations, const ShiftedOperator& T, double rate, Mode& mode) {
  const double size = std::max(std::abs(mode.s), std::abs(rate));
  const auto scale = T.scale().cast<Complex>();
  Eigen::VectorXcd x(equations.states());
  x << mode.u, mode.w;
  x = x.cwiseQuotient(scale).eval();
  const bool real = mode.s.imag() == 0;
  constexpr int most = 12;
  constexpr double exact = 1e-11;
  for (int k = 0; k < most; ++k) {
    const Eigen::VectorXcd y = T.apply(x);
    const Complex mu = x.dot(y) / x.squaredNorm(), s = T.shift() + 1.0 / mu, change = s - mode.s;
    mode.residual = (y / mu - x).norm() / x.norm();
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

/// Improves a mode with a shift next to its exponent, where the equations are regular.
/// @param near  operator at another shift, whose pivots are used; replaced
void improve(const LinearisedEquations& equations, double rate, std::unique_ptr<ShiftedOperator>& near, Mode& mode) {
  const Complex shift = mode.s + std::max(std::abs(mode.s), std::abs(rate)) * Complex(6e-6, 8e-6);
  const Mode before = mode;
  const bool chosen = near == nullptr;
  near = std::make_unique<ShiftedOperator>(equations, shift, std::move(near));
  if (near->regular()) iterate(equations, *near, rate, mode);
  if (chosen || (near->regular() && mode.residual < accurate)) return;
  mode = before;
  near = std::make_unique<ShiftedOperator>(equations, shift);
  if (near->regular()) iterate(equations, *near, rate, mode);
}

/// Improves a mode repeatedly, with shifts that follow its exponent.
void improve_well(const LinearisedEquations& equations, double rate, std::unique_ptr<ShiftedOperator>& near,
                  Mode& mode) {
  constexpr int most = 4;
  constexpr double far = 1e-4;
  for (int k = 0; k < most; ++k) {
    const Complex before = mode.s;
    improve(equations, rate, near, mode);
    if (mode.residual < accurate || std::abs(mode.s - before) < far * std::max(std::abs(mode.s), std::abs(rate)))
      return;
  }
}

}  // namespace

Eigen::MatrixXcd widened(const Eigen::MatrixXcd& amplitudes, int h) {
  Eigen::MatrixXcd wide = Eigen::MatrixXcd::Zero(amplitudes.rows(), 2 * h + 1);
  wide.middleCols(h - amplitudes.cols() / 2, amplitudes.cols()) = amplitudes;
  return wide;
}

Eigen::MatrixXcd copied(const Eigen::MatrixXcd& amplitudes, int multiple) {
  const Eigen::Index count = amplitudes.cols();
  Eigen::MatrixXcd copy = Eigen::MatrixXcd::Zero(amplitudes.rows(), count);
  for (Eigen::Index k = 0; k < count; ++k)
    if (k + multiple >= 0 && k + multiple < count) copy.col(k) = amplitudes.col(k + multiple);
  return copy;
}

void take_copy(int multiple, double rate, Complex& s, Eigen::MatrixXcd& u, Eigen::MatrixXcd& w) {
  s += Complex(0, multiple * rate);
  for (Eigen::MatrixXcd* each : {&u, &w}) {
    const Eigen::MatrixXcd copy = copied(*each, multiple);
    *each = s.imag() < 0 ? Eigen::MatrixXcd(copy.rowwise().reverse().conjugate()) : copy;
  }
  if (s.imag() < 0) s = std::conj(s);
}

void sort_by_rate(std::vector<HarmonicMode>& modes) {
  std::stable_sort(modes.begin(), modes.end(), [](const HarmonicMode& a, const HarmonicMode& b) {
    return std::abs(a.mode.s) < std::abs(b.mode.s);
  });
}

Modes HarmonicModes::found() const {
  Modes result;
  for (const HarmonicMode& each : modes) result.modes.push_back(each.mode);
  result.all = all;
  result.states = states;
  result.growing_besides = growing_besides;
  return result;
}

bool is_among(const HarmonicShapes& shapes, const HarmonicModes& modes, const Eigen::MatrixXcd& u, Complex s) {
  return std::any_of(modes.modes.begin(), modes.modes.end(),
                     [&](const HarmonicMode& each) { return shapes.are_same(u, s, each.u, each.mode.s); });
}

std::optional<HarmonicModes> continue_modes(const PeriodicEquations& equations, const HarmonicShapes& shapes,
                                            const HarmonicModes& from, int harmonics, Copies copies) {
  const double rate = equations.rate();
  HarmonicModes modes;
  modes.harmonics = harmonics;
  modes.equations = equations.of_harmonics(harmonics);
  modes.states = from.states;
  modes.all = from.all;
  modes.growing_besides = from.growing_besides;
  std::unique_ptr<ShiftedOperator> near;
  for (const HarmonicMode& before : from.modes) {
    Mode mode = before.mode;
    Eigen::MatrixXcd u = widened(before.u, harmonics), w = widened(before.w, harmonics);
    const auto improve_here = [&] {
      mode.u = equations.coefficients(u);
      mode.w = equations.coefficients(w);
      if (mode.kind == ModeKind::rigid) return;
      improve_well(modes.equations, rate, near, mode);
      u = equations.amplitudes(mode.u, harmonics);
      w = equations.amplitudes(mode.w, harmonics);
    };
    improve_here();
    if (mode.kind != ModeKind::rigid) {
      const double size = std::max(std::abs(mode.s), std::abs(rate));
      modes.change = std::max(modes.change, std::abs(mode.s - before.mode.s) / size);
      if (copies == Copies::continued) {
        constexpr double same = 0.5;
        if (!(mode.s.imag() >= 0) || !(shapes.similarity(u, widened(before.u, harmonics)) > same)) return std::nullopt;
      } else if (const int multiple = shapes.sizes(u, mode.s).largest(); multiple != 0) {
        take_copy(multiple, rate, mode.s, u, w);
        improve_here();
      }
      if (shapes.is_shift(u, mode.s) || is_among(shapes, modes, u, mode.s)) return std::nullopt;
    }
    const double whirl = shapes.whirl(shapes.sizes(u, mode.s));
    modes.modes.push_back({std::move(mode), std::move(u), std::move(w), whirl});
  }
  return modes;
}

namespace {

/// Whether another exponent, or a conjugate one, differs from this one by about a multiple of i rate: even a weak
/// coupling by a further harmonic then changes both.
bool is_resonant(const HarmonicModes& modes, const Mode& mode, double rate, double near) {
  return std::any_of(modes.modes.begin(), modes.modes.end(), [&](const HarmonicMode& other) {
    for (const Complex s : {other.mode.s, std::conj(other.mode.s)}) {
      const double turns = std::round((mode.s - s).imag() / rate);
      if (turns != 0 && std::abs(mode.s - s - Complex(0, turns * rate)) < near) return true;
    }
    return false;
  });
}

}  // namespace

bool are_exact(const PeriodicEquations& equations, const HarmonicModes& modes, double exact) {
  const int more = modes.harmonics + 1;
  const LinearisedEquations next = equations.of_harmonics(more);
  double slowest = INFINITY;
  for (const auto& [mode, u, w, whirl] : modes.modes)
    if (mode.kind != ModeKind::rigid) slowest = std::min(slowest, std::abs(mode.s));
  if (!std::isfinite(slowest)) return true;
  // An exponent without a resonance changes by the product of the coupling with a further harmonic and that back.
  // Rounding of stiff beams couples them by more than the exponents may change.
  constexpr double coupled = 1e-5;
  constexpr double beyond_copies = 1.37;  // a shift off the real eigenvalues of the modes and of their copies
  const ShiftedOperator T(next, beyond_copies * std::max(slowest, std::abs(equations.rate())));
  if (!T.regular()) return false;
  const auto scale = T.scale().cast<Complex>();
  for (const auto& [mode, u, w, whirl] : modes.modes) {
    if (mode.kind == ModeKind::rigid) continue;
    Eigen::VectorXcd x(next.states());
    x << equations.coefficients(widened(u, more)), equations.coefficients(widened(w, more));
    x = x.cwiseQuotient(scale).eval();
    const Eigen::VectorXcd y = T.apply(x);
    const Complex mu = x.dot(y) / x.squaredNorm();
    const double size = std::max(std::abs(mode.s), std::abs(equations.rate()));
    const double most = is_resonant(modes, mode, equations.rate(), coupled * size) ? exact : coupled;
    if (!(std::abs(T.shift() + 1.0 / mu - mode.s) < exact * size && (y / mu - x).norm() < most * x.norm()))
      return false;
  }
  return true;
}

void judge_modes(HarmonicModes& modes, const ModeOptions& options) {
  const EquationRounding rounding(modes.equations);
  ModeOptions accuracy = options;
  accuracy.drift = std::max(options.drift, modes.change);
  const ModeJudgement judgement(modes.equations, rounding, accuracy);
  for (HarmonicMode& each : modes.modes)
    if (each.mode.kind != ModeKind::rigid) judgement.judge(each.mode);
}

}  // namespace bielle::mechanism

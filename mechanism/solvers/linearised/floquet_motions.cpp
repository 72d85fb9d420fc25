#include "mechanism/solvers/linearised/floquet_motions.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "mechanism/solvers/linearised/orthonormal.hpp"
#include "mechanism/solvers/linearised/shifted_operator.hpp"
#include "mechanism/solvers/linearised/turn_integration.hpp"
#include "reduce/common/error.hpp"
#include "reduce/spectral/operator_eigenpairs.hpp"

namespace bielle::mechanism {
namespace {

using Complex = std::complex<double>;

constexpr double least_multiplier = 1e-10;  ///< rounding leaves smaller ones no digits

double duration_of(double rate) { return 2 * std::numbers::pi / std::abs(rate); }

/// Eigenvector of the monodromy matrix.
struct Start {
  Complex s;
  Eigen::VectorXcd state;  ///< at azimuth 0
};

class MonodromySearch {
 public:
  MonodromySearch(const PeriodicEquations& equations, const HarmonicShapes& shapes, double fastest, double angle)
      : equations_(equations),
        turn_(equations, steps_of(equations, fastest, angle)),
        harmonics_(static_cast<int>(std::ceil(fastest / std::abs(equations.rate()))) + spread),
        scale_(ShiftedOperator(equations.first(), std::abs(equations.rate())).scale()),
        weights_(shapes.weights(fastest, 0)) {}

  std::vector<FloquetMotion> run() {
    const std::vector<Start> starts = eigenvectors();
    constexpr double amplitudes = 1 << 25;  // half a gigabyte
    const double of_one = static_cast<double>(scale_.size()) * (2 * harmonics_ + 1);
    const auto together = static_cast<std::size_t>(std::max(1.0, std::min(64.0, amplitudes / of_one)));
    for (std::size_t k = 0; k < starts.size(); k += together)
      take({starts.begin() + static_cast<std::ptrdiff_t>(k),
            starts.begin() + static_cast<std::ptrdiff_t>(std::min(k + together, starts.size()))});
    return std::move(found_);
  }

 private:
  static constexpr int spread = 24;  ///< further harmonics of the fastest motions

  static int steps_of(const PeriodicEquations& equations, double fastest, double angle) {
    constexpr double least = 64, most = 8000, most_work = 2e6;
    const double steps =
        std::max(least, fastest * duration_of(equations.rate()) / coarse_angle) * (coarse_angle / angle);
    if (steps > std::min(most, most_work / equations.first().states()))
      throw ComputationError("a turn has too many steps for its monodromy matrix");
    return static_cast<int>(std::ceil(steps));
  }

  /// Returns scaled states after a turn.
  MatrixX after_turn(const MatrixX& states) const {
    return scale_.cwiseInverse().asDiagonal() * turn_.after_turn(scale_.asDiagonal() * states);
  }

  /// Returns an orthonormal basis of scaled states that contains all that is left after a turn. Most motions of large
  /// equations are too fast for the steps: the turn leaves few directions of random states (N. Halko, P. G. Martinsson,
  /// J. A. Tropp, SIAM Rev. 53 (2011) 217).
  MatrixX remaining_states() const {
    const Eigen::Index states = scale_.size();
    constexpr Eigen::Index first = 160, spare = 16;
    std::mt19937 random(1);  // the results are the same in each run
    for (Eigen::Index count = first; 2 * count < states; count *= 2) {
      const MatrixX some = MatrixX::NullaryExpr(states, count, [&] { return random() / 2147483648.0 - 1; });
      MatrixX basis = orthonormal_columns(after_turn(some));
      if (basis.cols() + spare <= count) return basis;
    }
    return MatrixX::Identity(states, states);
  }

  /// Returns one eigenvector of each conjugate pair.
  std::vector<Start> eigenvectors() const {
    const MatrixX basis = remaining_states(), after = basis.transpose() * after_turn(basis);
    OperatorEigenOptions options;
    options.dense = after.cols();
    const OperatorEigenpairs pairs =
        largest_eigenpairs(LinearOperator<double>{after.cols(), [&](const VectorX& x) { return VectorX(after * x); }},
                           after.cols(), options);
    constexpr double most = 1e4;
    if (pairs.values.cwiseAbs().maxCoeff() > most)
      throw ComputationError("a motion grows so much in a turn that nothing is known of the others");
    std::vector<Start> starts;
    for (Eigen::Index k = 0; k < pairs.values.size(); ++k) {
      const Complex mu = pairs.values[k];
      if (std::abs(mu) < least_multiplier || mu.imag() < 0) continue;
      const Eigen::VectorXcd state = basis.cast<Complex>() * pairs.vectors.col(k);
      starts.push_back({std::log(mu) / turn_.duration(), scale_.cast<Complex>().cwiseProduct(state)});
    }
    return starts;
  }

  /// Computes the harmonics of some motions.
  void take(const std::vector<Start>& starts) {
    const int n = equations_.first().unknowns(), dofs = equations_.first().dofs, count = 2 * harmonics_ + 1;
    const auto number = static_cast<Eigen::Index>(starts.size());
    MatrixX states(n + dofs, 2 * number);
    for (Eigen::Index k = 0; k < number; ++k) {
      states.col(2 * k) = starts[static_cast<std::size_t>(k)].state.real();
      states.col(2 * k + 1) = starts[static_cast<std::size_t>(k)].state.imag();
    }
    std::vector<Eigen::MatrixXcd> amplitudes(starts.size(), Eigen::MatrixXcd::Zero(n + dofs, count));
    VectorX squares = VectorX::Zero(number);  // mean square of each motion, without growth and decay
    turn_.after_turn(states, [&](int step, const MatrixX& now) {
      const double turns = static_cast<double>(step) / turn_.steps();
      Eigen::RowVectorXcd functions(count);  // exp(-i k rate t)
      for (int k = -harmonics_; k <= harmonics_; ++k)
        functions[k + harmonics_] = std::polar(
            1.0 / turn_.steps(), -std::copysign(2 * std::numbers::pi, equations_.rate()) * std::fmod(k * turns, 1.0));
      for (Eigen::Index k = 0; k < number; ++k) {
        Eigen::VectorXcd x(n + dofs);
        x.real() = now.col(2 * k);
        x.imag() = now.col(2 * k + 1);
        x *= std::exp(-starts[static_cast<std::size_t>(k)].s * turns * turn_.duration());
        amplitudes[static_cast<std::size_t>(k)] += x * functions;
        squares[k] += weights_.dot(x.head(n).cwiseAbs2()) / turn_.steps();
      }
    });
    for (Eigen::Index k = 0; k < number; ++k) {
      const auto at = static_cast<std::size_t>(k);
      // A faster motion has most of its harmonics beyond these.
      constexpr double most = 0.99;
      const double contained = weights_.dot(amplitudes[at].topRows(n).cwiseAbs2().rowwise().sum());
      if (contained > most * squares[k])
        found_.push_back({starts[at].s, amplitudes[at].topRows(n), amplitudes[at].bottomRows(dofs)});
    }
  }

  const PeriodicEquations& equations_;
  TurnIntegration turn_;
  int harmonics_;
  VectorX scale_;    ///< (states)
  VectorX weights_;  ///< (unknowns)
  std::vector<FloquetMotion> found_;
};

/// Returns a rate that includes the motions that are asked for, by the mean equations.
double fastest_rate_of(const PeriodicEquations& equations, const ModeOptions& options) {
  constexpr double further = 1.3;
  constexpr int more = 4;
  ModeOptions mean = options;
  mean.count += more;
  if (mean.below) *mean.below *= further;
  double fastest = 0;
  for (const Mode& mode : find_modes(equations.of_harmonics(0), mean).modes)
    if (!vanishes_in_turn(mode.s, equations.rate())) fastest = std::max(fastest, std::abs(mode.s));
  if (mean.below) fastest = std::max(fastest, 2 * std::numbers::pi * *mean.below);
  return std::max(further * fastest, std::abs(equations.rate()));
}

PrincipalModes principal_modes(std::vector<FloquetMotion>&& motions, const HarmonicShapes& shapes, double rate,
                               double fastest) {
  PrincipalModes result;
  for (auto& [s, u, w] : motions) {
    take_copy(shapes.sizes(u, s).largest(), rate, s, u, w);
    if (std::abs(s) > fastest) continue;
    constexpr double zero = 1e-4;  // square root of rounding: rigid modes are multiple eigenvalues
    if (std::abs(s) * duration_of(rate) < zero) {
      ++result.near_zero;
      continue;
    }
    Mode mode;
    mode.s = s;
    const double whirl = shapes.whirl(shapes.sizes(u, s));
    result.modes.push_back({std::move(mode), std::move(u), std::move(w), whirl});
  }
  return result;
}

}  // namespace

std::vector<FloquetMotion> floquet_motions(const PeriodicEquations& equations, const HarmonicShapes& shapes,
                                           double fastest, double angle) {
  return MonodromySearch(equations, shapes, fastest, angle).run();
}

bool vanishes_in_turn(Complex s, double rate) { return std::exp(s.real() * duration_of(rate)) < least_multiplier; }

namespace {

/// Returns the number of harmonics within which nearly everything of a motion lies.
int harmonics_of(const HarmonicShapes& shapes, const Eigen::MatrixXcd& u, Complex s, double rate) {
  // Parts of slower motions that rounding leaves in a motion outgrow it over the turn.
  constexpr double least = 1e-5, most = 0.1, others = 1e-9;
  const double grown = others * std::exp(-s.real() * duration_of(rate)),
               rest = std::pow(std::min(std::max(least, grown), most), 2);
  const HarmonicSizes sizes = shapes.sizes(u, s);
  const VectorX both = sizes.standing + sizes.turning;
  const auto middle = static_cast<int>(both.size() / 2);
  const double all = both.sum();
  int h = 0;
  for (double contained = both[middle]; h < middle && all - contained > rest * all;
       contained += both[middle - h] + both[middle + h])
    ++h;
  return h;
}

}  // namespace

Eigen::MatrixXcd within(const Eigen::MatrixXcd& amplitudes, int h) {
  const auto middle = static_cast<int>(amplitudes.cols() / 2);
  return h > middle ? widened(amplitudes, h) : Eigen::MatrixXcd(amplitudes.middleCols(middle - h, 2 * h + 1));
}

void keep_necessary_harmonics(const HarmonicShapes& shapes, double rate, HarmonicModes& modes) {
  for (const HarmonicMode& each : modes.modes)
    if (each.mode.kind != ModeKind::rigid)
      modes.harmonics = std::max(modes.harmonics, harmonics_of(shapes, each.u, each.mode.s, rate));
  for (HarmonicMode& each : modes.modes) {
    each.u = within(each.u, modes.harmonics);
    each.w = within(each.w, modes.harmonics);
  }
}

std::optional<PrincipalModes> find_by_monodromy(const PeriodicEquations& equations, const HarmonicShapes& shapes,
                                                const ModeOptions& options) {
  if (options.near) return std::nullopt;
  try {
    const double fastest = fastest_rate_of(equations, options);
    return principal_modes(floquet_motions(equations, shapes, fastest, coarse_angle), shapes, equations.rate(),
                           fastest);
  } catch (const ComputationError&) {
    return std::nullopt;
  }
}

std::optional<HarmonicModes> slowest_modes(PrincipalModes principal, const HarmonicModes& known,
                                           const HarmonicShapes& shapes, double rate, const ModeOptions& options) {
  constexpr int most_harmonics = 42;
  for (const HarmonicMode& each : known.modes)
    if (vanishes_in_turn(each.mode.s, rate)) principal.modes.push_back(each);
  sort_by_rate(principal.modes);
  HarmonicModes result;
  result.harmonics = known.harmonics;
  result.states = known.states;
  result.growing_besides = known.growing_besides;
  for (const HarmonicMode& each : known.modes)
    if (each.mode.kind == ModeKind::rigid) result.modes.push_back(each);
  if (principal.near_zero > 2 * static_cast<int>(result.modes.size()) + 1) return std::nullopt;
  const auto slow = [&](const HarmonicMode& each) { return each.mode.frequency() <= *options.below; };
  const auto count = options.below ? std::count_if(principal.modes.begin(), principal.modes.end(), slow)
                                   : static_cast<std::ptrdiff_t>(options.count);
  const auto end = principal.modes.begin() + std::min(count, static_cast<std::ptrdiff_t>(principal.modes.size()));
  result.modes.insert(result.modes.end(), principal.modes.begin(), end);
  keep_necessary_harmonics(shapes, rate, result);
  return result.harmonics > most_harmonics ? std::nullopt : std::optional(std::move(result));
}

}  // namespace bielle::mechanism

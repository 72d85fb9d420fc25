#include "mechanism/solvers/linearised/floquet_motions.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "mechanism/solvers/linearised/shifted_operator.hpp"
#include "mechanism/solvers/linearised/turn_integration.hpp"
#include "reduce/common/error.hpp"
#include "reduce/spectral/operator_eigenpairs.hpp"

namespace bielle::mechanism {
namespace {

using Complex = std::complex<double>;

/// Motion of an eigenvalue of the monodromy matrix.
struct Motion {
  Complex s;
  Eigen::VectorXcd start;  ///< state at azimuth 0
};

class MonodromySearch {
 public:
  /// @param fastest  rate up to which motions are resolved [rad/s]
  MonodromySearch(const PeriodicEquations& equations, const HarmonicShapes& shapes, int steps, double fastest)
      : equations_(equations),
        shapes_(shapes),
        turn_(equations, steps),
        fastest_(fastest),
        harmonics_(static_cast<int>(std::ceil(fastest / std::abs(equations.rate()))) + spread) {}

  /// Finds the motions with principal exponents up to the fastest rate, the slowest first, and those near zero apart.
  void run() {
    const std::vector<Motion> motions = eigenpairs();
    constexpr std::size_t together = 64;  // bounds the memory for amplitudes
    for (std::size_t k = 0; k < motions.size(); k += together)
      take({motions.begin() + static_cast<std::ptrdiff_t>(k),
            motions.begin() + static_cast<std::ptrdiff_t>(std::min(k + together, motions.size()))});
    std::stable_sort(found.begin(), found.end(), [](const HarmonicMode& a, const HarmonicMode& b) {
      return std::abs(a.mode.s) < std::abs(b.mode.s);
    });
  }

  std::vector<HarmonicMode> found;
  int near_zero = 0;  ///< number of motions whose exponent may be zero

 private:
  static constexpr int spread = 24;  ///< further harmonics of the fastest motions

  /// Returns one motion of each conjugate pair. Those that vanish in a turn are left out.
  std::vector<Motion> eigenpairs() const {
    const VectorX scale = ShiftedOperator(equations_.first(), std::abs(equations_.rate())).scale();
    const MatrixX after = scale.cwiseInverse().asDiagonal() * turn_.after_turn(MatrixX(scale.asDiagonal()));
    OperatorEigenOptions options;
    options.dense = after.cols();
    const OperatorEigenpairs pairs =
        largest_eigenpairs(LinearOperator<double>{after.cols(), [&](const VectorX& x) { return VectorX(after * x); }},
                           after.cols(), options);
    constexpr double vanishes = 1e-6;
    std::vector<Motion> motions;
    for (Eigen::Index k = 0; k < pairs.values.size(); ++k) {
      const Complex mu = pairs.values[k];
      if (std::abs(mu) < vanishes || mu.imag() < 0) continue;
      motions.push_back({std::log(mu) / turn_.duration(), scale.cast<Complex>().cwiseProduct(pairs.vectors.col(k))});
    }
    return motions;
  }

  /// Computes the harmonics of some motions and takes those that are slow enough.
  void take(const std::vector<Motion>& motions) {
    const int n = equations_.first().unknowns(), dofs = equations_.first().dofs, count = 2 * harmonics_ + 1;
    const auto number = static_cast<Eigen::Index>(motions.size());
    MatrixX starts(n + dofs, 2 * number);
    for (Eigen::Index k = 0; k < number; ++k) {
      starts.col(2 * k) = motions[static_cast<std::size_t>(k)].start.real();
      starts.col(2 * k + 1) = motions[static_cast<std::size_t>(k)].start.imag();
    }
    std::vector<Eigen::MatrixXcd> amplitudes(motions.size(), Eigen::MatrixXcd::Zero(n + dofs, count));
    VectorX squares = VectorX::Zero(number);  // mean square of each motion, without growth and decay
    const VectorX weights = shapes_.weights(fastest_, 0);
    turn_.after_turn(starts, [&](int step, const MatrixX& states) {
      const double turns = static_cast<double>(step) / turn_.steps();
      Eigen::RowVectorXcd functions(count);  // exp(-i k rate t)
      for (int k = -harmonics_; k <= harmonics_; ++k)
        functions[k + harmonics_] = std::polar(
            1.0 / turn_.steps(), -std::copysign(2 * std::numbers::pi, equations_.rate()) * std::fmod(k * turns, 1.0));
      for (Eigen::Index k = 0; k < number; ++k) {
        Eigen::VectorXcd x(n + dofs);
        x.real() = states.col(2 * k);
        x.imag() = states.col(2 * k + 1);
        x *= std::exp(-motions[static_cast<std::size_t>(k)].s * turns * turn_.duration());
        amplitudes[static_cast<std::size_t>(k)] += x * functions;
        squares[k] += weights.dot(x.head(n).cwiseAbs2()) / turn_.steps();
      }
    });
    for (Eigen::Index k = 0; k < number; ++k) {
      const auto at = static_cast<std::size_t>(k);
      add(motions[at].s, amplitudes[at].topRows(n), amplitudes[at].bottomRows(dofs), squares[k]);
    }
  }

  void add(Complex s, Eigen::MatrixXcd u, Eigen::MatrixXcd w, double square) {
    // A faster motion has most of its harmonics beyond these.
    constexpr double most = 0.99;
    const double contained = shapes_.weights(fastest_, 0).dot(u.cwiseAbs2().rowwise().sum());
    if (!(contained > most * square)) return;
    take_copy(shapes_.sizes(u, s).largest(), equations_.rate(), s, u, w);
    if (std::abs(s) > fastest_) return;
    constexpr double zero = 1e-4;  // square root of rounding: rigid modes are multiple eigenvalues
    if (std::abs(s) * turn_.duration() < zero) {
      ++near_zero;
      return;
    }
    Mode mode;
    mode.s = s;
    const double whirl = shapes_.whirl(shapes_.sizes(u, s));
    found.push_back({std::move(mode), std::move(u), std::move(w), whirl});
  }

  const PeriodicEquations& equations_;
  const HarmonicShapes& shapes_;
  TurnIntegration turn_;
  double fastest_;
  int harmonics_;
};

/// Returns the number of harmonics within which nearly everything of a motion lies.
int harmonics_of(const HarmonicShapes& shapes, const HarmonicMode& each) {
  constexpr double rest = 1e-10;
  const HarmonicSizes sizes = shapes.sizes(each.u, each.mode.s);
  const VectorX both = sizes.standing + sizes.turning;
  const auto middle = static_cast<int>(both.size() / 2);
  const double all = both.sum();
  int h = 0;
  for (double within = both[middle]; h < middle && all - within > rest * all;
       within += both[middle - h] + both[middle + h])
    ++h;
  return h;
}

/// Returns the amplitudes of the harmonics -h .. h.
Eigen::MatrixXcd cut(const Eigen::MatrixXcd& amplitudes, int h) {
  const auto middle = static_cast<int>(amplitudes.cols() / 2);
  return h > middle ? widened(amplitudes, h) : Eigen::MatrixXcd(amplitudes.middleCols(middle - h, 2 * h + 1));
}

/// Returns a rate that includes the motions that are asked for, by the mean equations; nothing if one of them decays so
/// fast that the monodromy matrix does not show it.
std::optional<double> fastest_rate_of(const PeriodicEquations& equations, const ModeOptions& options, double duration) {
  constexpr double further = 1.3, lost = 10;
  constexpr int more = 4;
  ModeOptions mean = options;
  mean.count += more;
  if (mean.below) *mean.below *= further;
  double fastest = 0;
  for (const Mode& mode : find_modes(equations.of_harmonics(0), mean).modes) {
    if (mode.s.real() * duration < -lost) return std::nullopt;
    fastest = std::max(fastest, std::abs(mode.s));
  }
  if (mean.below) fastest = std::max(fastest, 2 * std::numbers::pi * *mean.below);
  return std::max(further * fastest, std::abs(equations.rate()));
}

}  // namespace

std::optional<HarmonicModes> find_by_monodromy(const PeriodicEquations& equations, const HarmonicShapes& shapes,
                                               const HarmonicModes& known, const ModeOptions& options) {
  if (options.near) return std::nullopt;
  const double duration = 2 * std::numbers::pi / std::abs(equations.rate());
  constexpr int least_steps = 64, most_steps = 4000, most_harmonics = 42;
  constexpr double resolved = 0.4;  // angle per step of the fastest motion: its exponent is accurate to 2e-6
  try {
    const std::optional<double> fastest = fastest_rate_of(equations, options, duration);
    if (!fastest || *fastest * duration / resolved > most_steps) return std::nullopt;
    const int steps = std::max(least_steps, static_cast<int>(std::ceil(*fastest * duration / resolved)));
    MonodromySearch search(equations, shapes, steps, *fastest);
    search.run();

    HarmonicModes result;
    result.states = known.states;
    result.growing_besides = known.growing_besides;
    for (const HarmonicMode& each : known.modes)
      if (each.mode.kind == ModeKind::rigid) result.modes.push_back(each);
    const auto rigid = static_cast<int>(result.modes.size());
    if (search.near_zero > 2 * rigid + 1) return std::nullopt;
    const auto slow = [&](const HarmonicMode& each) { return each.mode.frequency() <= *options.below; };
    const auto count = options.below ? std::count_if(search.found.begin(), search.found.end(), slow)
                                     : static_cast<std::ptrdiff_t>(options.count);
    if (static_cast<std::ptrdiff_t>(search.found.size()) < count) return std::nullopt;
    result.modes.insert(result.modes.end(), search.found.begin(), search.found.begin() + count);
    for (const HarmonicMode& each : result.modes)
      if (each.mode.kind != ModeKind::rigid) result.harmonics = std::max(result.harmonics, harmonics_of(shapes, each));
    if (result.harmonics > most_harmonics) return std::nullopt;
    result.harmonics = std::max(result.harmonics, known.harmonics);
    for (HarmonicMode& each : result.modes) {
      each.u = cut(each.u, result.harmonics);
      each.w = cut(each.w, result.harmonics);
    }
    return result;
  } catch (const ComputationError&) {
    return std::nullopt;  // a step, or the mean equations, are singular
  }
}

}  // namespace bielle::mechanism

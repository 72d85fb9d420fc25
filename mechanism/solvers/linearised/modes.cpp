#include "mechanism/solvers/linearised/modes.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "mechanism/solvers/linearised/eigenpairs_around.hpp"
#include "mechanism/solvers/linearised/finite_states.hpp"
#include "mechanism/solvers/linearised/free_shapes.hpp"
#include "mechanism/solvers/linearised/growing_motions.hpp"
#include "mechanism/solvers/linearised/indifferent_motions.hpp"
#include "mechanism/solvers/linearised/mode_judgement.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

using Complex = std::complex<double>;
using VectorXc = Eigen::VectorXcd;

class ModeSearch {
 public:
  ModeSearch(const LinearisedEquations& equations, const ModeOptions& options)
      : e_(equations),
        options_(options),
        rounding_(equations),
        around_(equations, options.dense),
        judgement_(equations, rounding_, options) {}

  Modes run() {
    Modes result;
    result.states = e_.states();
    if (e_.states() == 0) {
      result.all = true;
      return result;
    }
    if (has_own_units())
      rigid_.shapes = MatrixX(e_.unknowns(), 0);  // found together with the zeros in the search
    else
      rigid_ = find_indifferent_motions(e_, rounding_, options_.dense);
    MatrixX states(e_.states(), rigid_.shapes.cols());
    states.topRows(e_.unknowns()) = rigid_.shapes;
    states.bottomRows(e_.dofs) = (e_.W * rigid_.shapes).topRows(e_.dofs);
    around_.keep_out(states);
    return options_.near ? around_frequency(2 * std::numbers::pi * *options_.near) : slowest();
  }

 private:
  /// Returns whether there are first-order unknowns: they have their own units, for which u^T D u has no meaning.
  bool has_own_units() const { return e_.unknowns() != e_.dofs; }
  double shift() const { return std::abs(around_.T().shift()); }

  /// Tells whether a state that is not rigid has a zero eigenvalue. The remainder of a double zero is a simple one,
  /// which rounding does not split.
  bool is_zero(const Eigenpair& pair) const {
    constexpr double of_shift = 1e-8, of_units_of_their_own = 1e-4;
    if (has_own_units()) return std::abs(pair.s) <= of_units_of_their_own * shift();
    return std::abs(pair.s) <= of_shift * shift() || judgement_.is_nothing(pair.s, pair.x.head(e_.unknowns()));
  }

  /// Returns whether the eigenvalue represents its conjugate pair.
  static bool represents(Complex s) { return s.imag() >= 0; }

  void add_modes(const std::vector<Eigenpair>& pairs, const std::function<bool(Complex)>& wanted, Modes& result) const {
    for (const Eigenpair& pair : pairs) {
      if (!wanted(pair.s) || !represents(pair.s) || is_zero(pair)) continue;
      Mode mode{pair.s, ModeKind::oscillating, pair.x.head(e_.unknowns()), pair.x.tail(e_.dofs), 0, pair.residual};
      judgement_.judge(mode);
      result.modes.push_back(std::move(mode));
    }
  }

  static void sort_by_rate(std::vector<Mode>& modes) {
    std::stable_sort(modes.begin(), modes.end(),
                     [](const Mode& a, const Mode& b) { return std::abs(a.s) < std::abs(b.s); });
  }

  /// Inserts rigid modes at the beginning.
  void add_rigid_modes(Modes& result) const {
    std::vector<Mode> rigid;
    const VectorX& scale = around_.T().scale();
    for (Eigen::Index k = 0; k < rigid_.shapes.cols(); ++k) {
      const VectorX u = rigid_.shapes.col(k), w = (e_.W * u).head(e_.dofs);
      VectorX x(e_.states());
      x << u, w;
      x = x.cwiseQuotient(scale).eval();
      const double residual = (x + shift() * around_.T().apply(x)).norm() / x.norm();
      rigid.push_back({0, ModeKind::rigid, u.cast<Complex>(), w.cast<Complex>(), rigid_.resolution, residual});
    }
    result.modes.insert(result.modes.begin(), rigid.begin(), rigid.end());
  }

  /// Returns the smallest |s| that is not zero, or 0.
  double slowest_of(const std::vector<Eigenpair>& pairs) const {
    double least = INFINITY;
    for (const Eigenpair& pair : pairs)
      if (!is_zero(pair)) least = std::min(least, std::abs(pair.s));
    return std::isfinite(least) ? least : 0;
  }

  /// Chooses a shift of the size of the slowest mode that is not excluded. A shift that is too small resolves that mode
  /// well; a shift that is too large yields zero for it and for many others.
  void choose_shift(Eigen::Index count, double begin) {
    around_.set_shift(begin);
    const double first = shift();
    double highest = first;
    constexpr int most_shifts = 14;
    for (int k = 0; k < most_shifts; ++k) {
      EigenpairsNearby nearby;
      try {
        nearby = around_.look(count, EigenpairsAround::Look::roughly);
      } catch (const ComputationError&) {
        around_.set_shift(shift() / 30);  // eigenvalues appear close together, as slow ones do from a large shift
        continue;
      }
      const double slow = slowest_of(nearby.pairs);
      constexpr double far = 30;
      if (slow > 0 && (slow > far * shift() || slow < shift() / far)) {
        around_.set_shift(0.9 * slow);
      } else if (slow == 0 && std::isfinite(nearby.radius)) {
        count *= 2;
      } else if (constexpr double farthest = 1e7, step = 300;
                 slow == 0 && nearby.rejected && highest < farthest * first) {
        highest *= step;
        around_.set_shift(highest);  // the shift may be too small to resolve any nonzero rate
      } else {
        return;
      }
    }
  }

  double first_shift() const {
    constexpr double hardly_moves = 1e-2;  // [1/s], default
    if (rigid_.slowest > 0) return 0.9 * rigid_.slowest;
    return std::max({1e-3 * slowest_rate(e_), 1e-6 * fastest_rate(e_), hardly_moves});
  }

  /// Tells whether eigenvalues exist that are neither excluded nor among these. Slow modes may hide fast ones.
  bool any_missing(const std::vector<Eigenpair>& pairs) {
    constexpr int most = 2000;  // limit of states for counting
    if (e_.states() > most) return true;
    if (finite_ < 0) finite_ = count_finite_eigenvalues(e_, around_.T());
    return around_.kept_out() + static_cast<Eigen::Index>(pairs.size()) < finite_;
  }

  /// Excludes the accurately known pairs. @returns false if there are none
  bool keep_out(const std::vector<Eigenpair>& pairs, std::vector<Eigenpair>& kept) {
    constexpr double accurate = 1e-6;
    std::vector<VectorX> states;
    for (const Eigenpair& pair : pairs) {
      if (!(pair.residual <= accurate)) continue;
      kept.push_back(pair);
      if (!represents(pair.s)) continue;
      states.emplace_back(pair.z.real());
      if (pair.s.imag() > 0) states.emplace_back(pair.z.imag());
    }
    MatrixX columns(e_.states(), static_cast<Eigen::Index>(states.size()));
    for (std::size_t k = 0; k < states.size(); ++k) columns.col(static_cast<Eigen::Index>(k)) = states[k];
    around_.keep_out(columns);
    return !states.empty();
  }

  Modes slowest() {
    const bool limited = options_.below.has_value();
    const double limit = limited ? 2 * std::numbers::pi * *options_.below : INFINITY;
    const Eigen::Index begin = 2 * (limited ? 10 : options_.count) + 4 + rigid_.shapes.cols();
    Modes before;
    constexpr int most_rounds = 6;
    double from = first_shift();
    for (int round = 0;; ++round) {
      Eigen::Index count = begin;
      choose_shift(count, from);
      EigenpairsNearby nearby = around_.look(count, EigenpairsAround::Look::exactly);
      while (true) {
        // The modes nearest to the shift are not always the slowest. No mode is missing within this circle.
        const double known = nearby.radius - shift();
        const bool whole = !std::isfinite(nearby.radius);
        Modes result = before;
        add_modes(
            nearby.pairs, [&](Complex s) { return std::abs(s) <= std::min(known, limit); }, result);
        const bool enough = limited ? known >= limit : static_cast<int>(result.modes.size()) >= options_.count;
        if (!whole && !enough) {
          count += std::max<Eigen::Index>(10, count / 2);
          nearby = around_.look(count, EigenpairsAround::Look::exactly);
          continue;
        }
        const bool missing =
            whole && (limited || static_cast<int>(result.modes.size()) <= options_.count) && any_missing(nearby.pairs);
        std::vector<Eigenpair> known_well;
        if (missing && !(enough && !limited) && round < most_rounds && keep_out(nearby.pairs, known_well)) {
          add_modes(
              known_well, [&](Complex s) { return std::abs(s) <= limit; }, before);
          constexpr double beyond = 1e3;
          for (const Eigenpair& pair : known_well) from = std::max(from, beyond * std::abs(pair.s));
          break;
        }
        const bool dropped = has_own_units() && find_rigid_among(nearby.pairs) > 0;
        return finished(std::move(result), whole && !missing && !dropped && !limited);
      }
    }
  }

  /// @returns the number of zeros that do not belong to rigid motions: a double zero belongs to one rigid motion, a
  /// simple zero to a state at rest
  Eigen::Index find_rigid_among(const std::vector<Eigenpair>& pairs) {
    std::vector<Eigenpair> zeros;
    for (const Eigenpair& pair : pairs)
      if (is_zero(pair)) zeros.push_back(pair);
    rigid_.shapes = find_free_shapes(e_, around_.T(), zeros);
    return std::max<Eigen::Index>(0, static_cast<Eigen::Index>(zeros.size()) - 2 * rigid_.shapes.cols());
  }

  /// @param from  growth rate [1/s] above which motions are counted
  void note_growing_besides(double from, Modes& result) const {
    result.growing_besides = result.all ? 0 : from > 0 ? count_growing(e_, from) : std::nullopt;
    if (!result.growing_besides) return;
    for (const Mode& mode : result.modes)
      if (mode.s.imag() == 0 && mode.s.real() > from && *result.growing_besides > 0) --*result.growing_besides;
  }

  Modes finished(Modes result, bool all) const {
    const auto count = static_cast<std::size_t>(options_.count);
    result.states = e_.states();
    result.all = all && result.modes.size() <= count;
    sort_by_rate(result.modes);
    if (!options_.below && result.modes.size() > count) result.modes.resize(count);
    constexpr double next_below = 1 - 1e-6;  // other modes may have the same rate as the last one
    note_growing_besides(options_.below         ? 2 * std::numbers::pi * *options_.below
                         : result.modes.empty() ? 0
                                                : next_below * std::abs(result.modes.back().s),
                         result);
    add_rigid_modes(result);
    return result;
  }

  Modes around_frequency(double omega) {
    around_.set_shift(Complex(0, omega));
    Eigen::Index count = options_.count + 4;
    while (true) {
      const EigenpairsNearby nearby = around_.look(count, EigenpairsAround::Look::exactly);
      Modes result;
      result.states = e_.states();
      add_modes(
          nearby.pairs, [](Complex) { return true; }, result);
      const bool whole = !std::isfinite(nearby.radius);
      if (!whole && static_cast<int>(result.modes.size()) < options_.count) {
        count += std::max<Eigen::Index>(10, count / 2);
        continue;
      }
      result.all = whole && static_cast<int>(result.modes.size()) <= options_.count && rigid_.shapes.cols() == 0 &&
                   !any_missing(nearby.pairs);
      if (static_cast<int>(result.modes.size()) > options_.count) {
        const auto distance = [&](const Mode& mode) { return std::abs(mode.s - around_.T().shift()); };
        std::stable_sort(result.modes.begin(), result.modes.end(),
                         [&](const Mode& a, const Mode& b) { return distance(a) < distance(b); });
        result.modes.resize(static_cast<std::size_t>(options_.count));
      }
      sort_by_rate(result.modes);
      constexpr double slower = 0.5;
      note_growing_besides(slower * rigid_.slowest, result);
      return result;
    }
  }

  const LinearisedEquations& e_;
  const ModeOptions& options_;
  EquationRounding rounding_;
  EigenpairsAround around_;
  ModeJudgement judgement_;
  IndifferentMotions rigid_;
  Eigen::Index finite_ = -1;  ///< number of finite eigenvalues, once it is known
};

}  // namespace

const char* mode_kind_name(ModeKind kind) {
  switch (kind) {
    case ModeKind::rigid:
      return "rigid";
    case ModeKind::decaying:
      return "decaying";
    case ModeKind::growing:
      return "growing";
    default:
      return "oscillating";
  }
}

double Mode::frequency() const { return std::abs(s) / (2 * std::numbers::pi); }
double Mode::damped_frequency() const { return std::abs(s.imag()) / (2 * std::numbers::pi); }
double Mode::damping_ratio() const { return s == 0.0 ? 0 : -s.real() / std::abs(s); }

SingularEquations::SingularEquations(int at)
    : ComputationError("the linearised equations are singular at every frequency"), at_(at) {}

namespace {

/// Returns sqrt(K/M) of dofs and K/C of first-order unknowns from diagonal entries; zeros are omitted.
std::vector<double> diagonal_rates(const LinearisedEquations& e) {
  const VectorX M = e.M.diagonal(), C = e.C.diagonal(), K = e.K.diagonal();
  std::vector<double> rates;
  for (int i = 0; i < e.unknowns(); ++i) {
    double rate = 0;
    if (i < e.dofs && M[i] > 0) rate = std::sqrt(std::abs(K[i]) / M[i]);
    if (i >= e.dofs && C[i] != 0) rate = std::abs(K[i] / C[i]);
    if (rate > 0) rates.push_back(rate);
  }
  return rates;
}

}  // namespace

double fastest_rate(const LinearisedEquations& equations) {
  const std::vector<double> rates = diagonal_rates(equations);
  return rates.empty() ? 1 : *std::max_element(rates.begin(), rates.end());
}

double slowest_rate(const LinearisedEquations& equations) {
  const double most = fastest_rate(equations);
  constexpr double rounding = 1e-9;
  double least = most;
  for (const double rate : diagonal_rates(equations))
    if (rate > rounding * most) least = std::min(least, rate);
  return least;
}

Modes find_modes(const LinearisedEquations& equations, const ModeOptions& options) {
  return ModeSearch(equations, options).run();
}

}  // namespace bielle::mechanism

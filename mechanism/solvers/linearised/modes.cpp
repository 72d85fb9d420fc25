#include "mechanism/solvers/linearised/modes.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>

#include "mechanism/solvers/linearised/finite_states.hpp"
#include "mechanism/solvers/linearised/shifted_operator.hpp"
#include "reduce/common/error.hpp"
#include "reduce/common/symmetric_eigenpairs.hpp"
#include "reduce/spectral/operator_eigenpairs.hpp"

namespace bielle::mechanism {
namespace {

using Complex = std::complex<double>;
using VectorXc = Eigen::VectorXcd;
using MatrixXc = Eigen::MatrixXcd;
using Sparse = LinearisedEquations::Sparse;

/// An orthonormal basis of the same span, by Gram and Schmidt twice; what rounding makes of a repeated column is left
/// out.
MatrixX orthonormal(const MatrixX& vectors) {
  constexpr double repeated = 1e-13;
  MatrixX basis(vectors.rows(), vectors.cols());
  Eigen::Index found = 0;
  for (Eigen::Index k = 0; k < vectors.cols(); ++k) {
    VectorX x = vectors.col(k).normalized();
    for (int twice = 0; twice < 2; ++twice) {
      const VectorX parts = basis.leftCols(found).transpose() * x;
      x -= basis.leftCols(found) * parts;
    }
    if (x.norm() > repeated) basis.col(found++) = x.normalized();
  }
  return basis.leftCols(found);
}

struct Found {
  Complex s;
  VectorXc x;  ///< scaled state
  double residual;
};

/// Eigenpairs around a shift, nearest first, and how far around it all are known.
struct Around {
  std::vector<Found> pairs;
  bool rejected = false;  ///< some belonged to infinite eigenvalues, or to ones too large for the shift to show
  double radius = 0;      ///< |s - sigma|; infinite where all are there
};

class Search {
 public:
  Search(const LinearisedEquations& equations, const ModeOptions& options) : e_(equations), options_(options) {}

  Modes run() {
    Modes result;
    result.states = e_.states();
    if (e_.states() == 0) {
      result.all = true;
      return result;
    }
    return options_.near ? around_frequency(2 * std::numbers::pi * *options_.near) : slowest();
  }

 private:
  /// Makes the operator, at a shift next to this one where it is an eigenvalue.
  void set_shift(Complex shift) {
    constexpr double factors[] = {1, 1.0137, 13.7, 1370, 1.37e5};
    for (const double factor : factors) {
      if (factor > 2 && shift.real() == 0) break;  // a frequency that was asked for
      operator_ = std::make_unique<ShiftedOperator>(e_, factor * shift);
      if (operator_->regular()) return;
    }
    throw SingularEquations(operator_->singular());
  }

  bool dense() const {
    constexpr int most = 2000;  // states, for the null space of the constraints
    return e_.states() - 2 * e_.constraints() <= options_.dense && e_.states() <= most && options_.dense > 0;
  }

  enum class Look { roughly, exactly };

  Around look(Eigen::Index count, Look how = Look::exactly) const {
    const ShiftedOperator& T = *operator_;
    OperatorEigenpairs found;
    MatrixX basis;
    if (dense()) {
      basis = consistent_states(e_, T.scale());
      OperatorEigenOptions all;
      all.dense = basis.cols();
      if (T.is_real())
        found = largest_eigenpairs(LinearOperator<double>{basis.cols(),
                                                          [&](const VectorX& z) -> VectorX {
                                                            return basis.transpose() * T.apply(VectorX(basis * z));
                                                          }},
                                   count, all);
      else
        found = largest_eigenpairs(LinearOperator<Complex>{basis.cols(),
                                                           [&](const VectorXc& z) -> VectorXc {
                                                             return basis.transpose().cast<Complex>() *
                                                                    T.apply(VectorXc(basis.cast<Complex>() * z));
                                                           }},
                                   count, all);
    } else {
      OperatorEigenOptions sparse;
      sparse.dense = 0;
      if (how == Look::roughly) {
        sparse.tolerance = 1e-6;
        sparse.copies = false;
      }
      const Eigen::Index size = e_.states();
      if (T.is_real())
        found = largest_eigenpairs(LinearOperator<double>{size, [&](const VectorX& x) { return T.apply(x); }}, count,
                                   sparse);
      else
        found = largest_eigenpairs(LinearOperator<Complex>{size, [&](const VectorXc& x) { return T.apply(x); }}, count,
                                   sparse);
    }
    Around around;
    around.radius = found.all ? INFINITY : 1 / std::abs(found.values[found.values.size() - 1]);
    for (Eigen::Index k = 0; k < found.values.size(); ++k) {
      const Complex mu = found.values[k];
      if (mu == 0.0) continue;
      VectorXc x = found.vectors.col(k);
      if (dense()) x = basis.cast<Complex>() * x;
      // Nothing is left of what belongs to an infinite eigenvalue.
      const VectorXc once = T.apply(x) / mu;
      constexpr double same = 1e-2;
      if (!((T.apply(once) / mu - x).norm() < same * x.norm())) {
        around.rejected = true;
        continue;
      }
      Complex value = T.shift() + 1.0 / mu;
      // Of a complex operator real eigenvalues are real but for rounding.
      constexpr double rounding = 1e-9;
      if (!T.is_real() && std::abs(value.imag()) < rounding * std::abs(value)) value = value.real();
      around.pairs.push_back({value, once / once.norm(), (once - x).norm() / x.norm()});
    }
    return around;
  }

  /// Whether s is zero to rounding: relative to the shift (a double zero is split by the square root of
  /// rounding, a triple one by its cube root), or because what the rates add is less than rounding errors of the other
  /// terms.
  bool is_zero(const Found& pair) const {
    const int n = e_.unknowns();
    constexpr double of_shift = 1e-4, of_stiffness = 1e-14;
    if (std::abs(pair.s) <= of_shift * std::abs(operator_->shift())) return true;
    const VectorX& scale = operator_->scale();
    const VectorXc u = scale.head(n).asDiagonal() * pair.x.head(n);
    const auto size_of = [&](const auto& forces) {
      double sum = 0;
      for (int i = 0; i < n; ++i) sum += std::norm(Complex(forces[i]) * weight(i));
      return std::sqrt(sum);
    };
    const VectorXc added =
        pair.s * (e_.C.cast<Complex>() * u + e_.M.cast<Complex>() * (pair.s * u + e_.W.cast<Complex>() * u));
    const VectorX stiff = absolute_K() * u.cwiseAbs();
    return size_of(added) <= of_stiffness * size_of(stiff);
  }
  double weight(int i) const { return i < e_.dofs ? operator_->scale()[i] : 1 / operator_->scale()[i]; }
  const Sparse& absolute_K() const {
    if (K_.size() == 0) K_ = Sparse(e_.K.cwiseAbs()) + Sparse(Sparse(e_.C * e_.W).cwiseAbs());
    return K_;
  }

  Mode mode_of(const Found& pair, ModeKind kind) const {
    const int n = e_.unknowns();
    const VectorXc x = operator_->scale().asDiagonal() * pair.x;
    return {pair.s, kind, x.head(n), x.tail(e_.dofs), pair.residual};
  }

  /// Rounding splits double eigenvalues that have one shape, by far more than itself: growth is that of their mean.
  static ModeKind kind_of(Complex s, const std::vector<Found>& pairs) {
    constexpr double rounding = 1e-8, split = 1e-4;
    Complex sum = 0;
    double count = 0;
    for (const Found& pair : pairs)
      if (std::abs(pair.s - s) <= split * std::abs(s)) {
        sum += pair.s;
        ++count;
      }
    const Complex mean = count > 0 ? sum / count : s;
    if (mean.real() > rounding * std::abs(s)) return ModeKind::growing;
    return s.imag() == 0 ? ModeKind::decaying : ModeKind::oscillating;
  }

  /// Independent shapes of eigenvalues that are zero. These come in pairs of nearly the same vector, which tell their
  /// number badly. With D(s) u = 0 the equations, a shape that costs nothing is one that D(sigma)^-1 (D(sigma) - D(0))
  /// leaves as it is, and all others become shorter.
  std::vector<Mode> rigid_modes(const std::vector<Found>& zeros) const {
    std::vector<Mode> modes;
    if (zeros.empty()) return modes;
    const int n = e_.unknowns();
    const double shift = operator_->shift().real();
    const auto scale = operator_->scale().head(n);
    const auto count = std::min<Eigen::Index>(n, static_cast<Eigen::Index>(zeros.size()));
    double residual = 0;
    MatrixX shapes(n, count);
    for (Eigen::Index k = 0; k < count; ++k) {
      const Found& zero = zeros[static_cast<std::size_t>(k)];
      residual = std::max(residual, zero.residual);
      shapes.col(k) = zero.x.head(n).real().normalized();
      // Vectors that repeat each other have to be told apart.
      for (Eigen::Index i = 0; i < n; ++i)
        shapes(i, k) += 0.3 / std::sqrt(n) * std::cos(static_cast<double>((i + 1) * (2 * k + 1) % 7919));
    }
    const auto answer = [&](const VectorX& x) {
      const VectorX u = scale.cwiseProduct(x);
      VectorX right = VectorX::Zero(n + e_.constraints());
      right.head(n) = shift * (e_.C * u + e_.M * (shift * u + e_.W * u));
      const VectorX of_constraints = shift * (e_.B * u);
      for (int k = 0; k < e_.constraints(); ++k)
        if (e_.nonholonomic[static_cast<std::size_t>(k)]) right[n + k] = of_constraints[k];
      return VectorX(operator_->solve(right.cast<Complex>()).head(n).real().cwiseQuotient(scale));
    };
    constexpr int rounds = 100;
    constexpr double stays = 1e-8, settled = 1e-22, leaves = 1e-3;  // squares of changes
    SymmetricEigenpairs change;
    for (int round = 0; round < rounds; ++round) {
      shapes = orthonormal(shapes);
      MatrixX answers(n, shapes.cols());
      for (Eigen::Index k = 0; k < shapes.cols(); ++k) answers.col(k) = answer(shapes.col(k));
      const MatrixX changes = answers - shapes;
      change = symmetric_eigenpairs(MatrixX(changes.transpose() * changes));
      // Others become shorter by a half each time, as the shift is of the size of the slowest of them.
      constexpr int separated = 60;
      if (round > separated && std::all_of(change.values.begin(), change.values.end(),
                                           [](double value) { return value < settled || value > leaves; }))
        break;
      if (round + 1 < rounds) shapes = answers;
    }
    for (Eigen::Index k = 0; k < change.values.size() && change.values[k] < stays; ++k) {
      const VectorX u = scale.cwiseProduct(shapes * change.vectors.col(k));
      const VectorX w = (e_.W * u).head(e_.dofs);
      modes.push_back({0, ModeKind::rigid, u.cast<Complex>(), w.cast<Complex>(), residual});
    }
    return modes;
  }

  /// Of conjugate pairs one.
  static bool represents(Complex s) { return s.imag() >= 0; }

  Modes collect(const std::vector<Found>& pairs, const std::function<bool(Complex)>& wanted) const {
    Modes result;
    result.states = e_.states();
    std::vector<Found> zeros;
    for (const Found& pair : pairs) {
      if (is_zero(pair))
        zeros.push_back(pair);
      else if (wanted(pair.s) && represents(pair.s))
        result.modes.push_back(mode_of(pair, kind_of(pair.s, pairs)));
    }
    if (operator_->is_real() && wanted(0))
      for (Mode& mode : rigid_modes(zeros)) result.modes.push_back(std::move(mode));
    std::stable_sort(result.modes.begin(), result.modes.end(),
                     [](const Mode& a, const Mode& b) { return std::abs(a.s) < std::abs(b.s); });
    return result;
  }

  /// The smallest |s| that is not zero, or 0.
  double slowest_of(const std::vector<Found>& pairs) const {
    double least = INFINITY;
    for (const Found& pair : pairs)
      if (!is_zero(pair)) least = std::min(least, std::abs(pair.s));
    return std::isfinite(least) ? least : 0;
  }

  /// The largest |s| that counts as zero.
  double fastest_zero(const std::vector<Found>& pairs) const {
    double most = 0;
    for (const Found& pair : pairs)
      if (is_zero(pair)) most = std::max(most, std::abs(pair.s));
    return most;
  }
  /// What rounding makes of a double zero, relative to the shift.
  static constexpr double rounded_pair = 1e-7;

  /// A shift of the size of the slowest mode that is not rigid. A shift that is too small shows that mode well, one
  /// that is too large shows it as zero, like many others.
  void choose_shift(Eigen::Index count) {
    // What is slower than that shows itself in the second look.
    constexpr double hardly_moves = 1e-2;  // [1/s]
    set_shift(std::max({1e-3 * slowest_rate(e_), 1e-6 * fastest_rate(e_), hardly_moves}));
    const double first = operator_->shift().real();
    double highest = first;
    constexpr int most_shifts = 14;
    bool seen = false;
    for (int k = 0; k < most_shifts; ++k) {
      const double shift = operator_->shift().real();
      Around around;
      try {
        around = look(count, Look::roughly);
      } catch (const ComputationError&) {
        set_shift(shift / 30);  // many eigenvalues next to each other, as slow ones are to a large shift
        continue;
      }
      const double slow = slowest_of(around.pairs);
      constexpr double far = 30;
      if (const double zero = fastest_zero(around.pairs); !seen && zero > rounded_pair * shift) {
        seen = true;  // zero to a shift that is much too large, perhaps
        set_shift(100 * zero);
      } else if (slow > 0 && (slow > far * shift || slow < shift / far)) {
        set_shift(0.9 * slow);
      } else if (slow == 0 && std::isfinite(around.radius)) {
        count *= 2;
      } else if (constexpr double farthest = 1e7, step = 300;
                 slow == 0 && around.rejected && highest < farthest * first) {
        highest *= step;
        set_shift(highest);  // it may be too small to show anything that is faster than zero
      } else {
        return;
      }
    }
  }

  Modes slowest() {
    const bool limited = options_.below.has_value();
    const double limit = limited ? 2 * std::numbers::pi * *options_.below : INFINITY;
    Eigen::Index count = 2 * (limited ? 10 : options_.count) + 4;
    choose_shift(count);
    Around around = look(count);
    while (true) {
      // Nearest to the shift is not the same as slowest: within this circle none is missing.
      const double known = around.radius - std::abs(operator_->shift());
      const bool whole = !std::isfinite(around.radius);
      Modes result = collect(around.pairs, [&](Complex s) { return std::abs(s) <= std::min(known, limit); });
      const bool enough = limited ? known >= limit : static_cast<int>(result.modes.size()) >= options_.count;
      if (!whole && !enough) {
        count += std::max<Eigen::Index>(10, count / 2);
        around = look(count);
        continue;
      }
      result.all = whole && !limited && static_cast<int>(result.modes.size()) <= options_.count;
      if (!limited && static_cast<int>(result.modes.size()) > options_.count)
        result.modes.resize(static_cast<std::size_t>(options_.count));
      return result;
    }
  }

  Modes around_frequency(double omega) {
    set_shift(Complex(0, omega));
    Eigen::Index count = options_.count + 4;
    while (true) {
      const Around around = look(count);
      Modes result = collect(around.pairs, [](Complex) { return true; });
      const bool whole = !std::isfinite(around.radius);
      if (!whole && static_cast<int>(result.modes.size()) < options_.count) {
        count += std::max<Eigen::Index>(10, count / 2);
        continue;
      }
      result.all = whole && static_cast<int>(result.modes.size()) <= options_.count;
      if (static_cast<int>(result.modes.size()) > options_.count) {
        const auto distance = [&](const Mode& mode) { return std::abs(mode.s - operator_->shift()); };
        std::stable_sort(result.modes.begin(), result.modes.end(),
                         [&](const Mode& a, const Mode& b) { return distance(a) < distance(b); });
        result.modes.resize(static_cast<std::size_t>(options_.count));
        std::stable_sort(result.modes.begin(), result.modes.end(),
                         [](const Mode& a, const Mode& b) { return std::abs(a.s) < std::abs(b.s); });
      }
      return result;
    }
  }

  const LinearisedEquations& e_;
  const ModeOptions& options_;
  std::unique_ptr<ShiftedOperator> operator_;
  mutable Sparse K_;
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
    : ComputationError("the linearised equations are singular whatever the frequency"), at_(at) {}

namespace {

/// sqrt(K/M) of dofs, K/C of first-order unknowns, by diagonal entries; zeros left out.
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
  return Search(equations, options).run();
}

}  // namespace bielle::mechanism

#include "mechanism/solvers/linearised/resonant_motions.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <Eigen/Eigenvalues>

#include "mechanism/solvers/linearised/eigenpairs_around.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

using Complex = std::complex<double>;
using MatrixXc = Eigen::MatrixXcd;

constexpr double equal = 1e-6;  // difference of exponents, relative to their size

struct Shape {
  MatrixXc u, w;  ///< amplitudes at harmonics -h .. h
};

class ResonantMotions {
 public:
  ResonantMotions(const PeriodicEquations& equations, const HarmonicShapes& shapes, HarmonicModes& modes)
      : equations_(equations), shapes_(shapes), modes_(modes), around_(modes.equations, 0) {}

  bool add() {
    std::vector<double> frequencies;
    for (const HarmonicMode& each : modes_.modes)
      if (is_locked(each) && std::count(frequencies.begin(), frequencies.end(), halves(each.mode.s)) == 0)
        frequencies.push_back(halves(each.mode.s));
    for (const double turns : frequencies) add_with(turns);
    for (auto k = static_cast<std::ptrdiff_t>(modes_.modes.size()) - 1; k >= 0; --k)
      if (dependent_.count(static_cast<std::size_t>(k)) > 0) modes_.modes.erase(modes_.modes.begin() + k);
    return changed_;
  }

 private:
  double rate() const { return std::abs(equations_.rate()); }
  double halves(Complex s) const { return std::round(2 * s.imag() / rate()); }
  bool is_locked(Complex s) const {
    return s.imag() > -equal * rate() && std::abs(2 * s.imag() / rate() - halves(s)) < equal;
  }
  bool is_locked(const HarmonicMode& each) const { return each.mode.kind != ModeKind::rigid && is_locked(each.mode.s); }
  bool are_equal(Complex s, Complex other) const { return std::abs(s - other) < equal * std::max(std::abs(s), rate()); }
  bool is_copy(Complex s, Complex other) const {
    const double turns = std::round((s.imag() - other.imag()) / rate());
    return are_equal(s, other + Complex(0, turns * rate()));
  }

  /// Looks around each locked exponent of a frequency. An oscillation has two locked motions, a decay of the mean
  /// equations is one.
  void add_with(double turns) {
    exponents_.clear();
    // Copies of the azimuth and of the shift in time, and of other motions.
    constexpr Eigen::Index others = 4, many = 24;
    Eigen::Index locked = 0;
    for (const HarmonicMode& each : modes_.modes) {
      const Complex s = each.mode.s;
      if (!is_locked(each) || halves(s) != turns) continue;
      ++locked;
      look_at(s);
    }
    for (std::size_t k = 0; k < exponents_.size(); ++k) {
      const Complex s = exponents_[k];
      try {
        around_.set_shift(s + std::max(std::abs(s), rate()) * Complex(6e-6, 8e-6));
        for (const Eigen::Index count : {2 * locked + others, 2 * locked + many})
          if (take(s, around_.look(count, EigenpairsAround::Look::exactly)) >= 2 * locked || turns == 0) break;
      } catch (const ComputationError&) {
        modes_.all = false;  // motions so close together that they cannot be told apart
      }
    }
  }

  /// Notes an exponent around which motions are sought.
  void look_at(Complex s) {
    if (std::none_of(exponents_.begin(), exponents_.end(), [&](Complex known) { return are_equal(s, known); }))
      exponents_.push_back(s);
  }

  /// Takes the locked motions of the frequency of s, those of one exponent together. Some of another exponent than s
  /// may be missing. @returns their number
  Eigen::Index take(Complex s, const EigenpairsNearby& nearby) {
    std::vector<std::pair<Complex, std::vector<Shape>>> groups;
    Eigen::Index count = 0;
    for (const Eigenpair& pair : nearby.pairs) {
      if (!is_locked(pair.s) || halves(pair.s) != halves(s) || is_zero(pair.s)) continue;
      Shape shape{equations_.amplitudes(pair.x.head(modes_.equations.unknowns()), modes_.harmonics),
                  equations_.amplitudes(pair.x.tail(modes_.equations.dofs), modes_.harmonics)};
      ++count;
      const auto group =
          std::find_if(groups.begin(), groups.end(), [&](const auto& each) { return are_equal(each.first, pair.s); });
      if (group == groups.end())
        groups.push_back({pair.s, {std::move(shape)}});
      else
        group->second.push_back(std::move(shape));
    }
    std::vector<std::vector<std::size_t>> places(groups.size());
    for (std::size_t k = 0; k < modes_.modes.size(); ++k) {
      const Complex mode = modes_.modes[k].mode.s;
      if (groups.empty() || dependent_.count(k) > 0 || !is_locked(modes_.modes[k]) || halves(mode) != halves(s))
        continue;
      const auto nearest = std::min_element(groups.begin(), groups.end(), [&](const auto& a, const auto& b) {
        return std::abs(a.first - mode) < std::abs(b.first - mode);
      });
      constexpr double roughly = 1e-3;  // accuracy of continued exponents that nearly coincide
      if (std::abs(nearest->first - mode) < roughly * std::max(std::abs(mode), rate()))
        places[static_cast<std::size_t>(nearest - groups.begin())].push_back(k);
    }
    for (std::size_t k = 0; k < groups.size(); ++k)
      replace(groups[k].first, groups[k].second, places[k], are_equal(groups[k].first, s));
    return count;
  }

  /// Whether an exponent is that of a free azimuth or of the shift in time, or of a copy of these.
  bool is_zero(Complex s) const { return std::abs(s.real()) < equal * rate() && std::fmod(halves(s), 2) == 0; }

  /// Replaces the modes of one exponent by the motions that were found with it. Modes of other exponents may have been
  /// continued into this one: there are more then than independent shapes.
  /// @param places  the modes of this exponent @param complete  whether no motion is missing among those found
  void replace(Complex s, const std::vector<Shape>& found, const std::vector<std::size_t>& places, bool complete) {
    const auto found_elsewhere = [&](const HarmonicMode& each) {
      return each.mode.kind != ModeKind::rigid && std::abs(each.mode.s.imag() - s.imag()) > 0.5 * rate() &&
             is_copy(each.mode.s, s);
    };
    if (std::any_of(modes_.modes.begin(), modes_.modes.end(), found_elsewhere)) return;
    const std::vector<Shape> real = real_shapes(found, static_cast<int>(halves(s)));
    const bool single = real.size() == 1 && places.size() == 1;
    if (single || (!complete && real.size() < places.size())) return;
    if (!places.empty() && is_coincidence(real, halves(s))) return;
    changed_ = true;
    if (real.size() > places.size()) look_at(s);
    for (std::size_t k = real.size(); k < places.size(); ++k) dependent_.insert(places[k]);
    const auto kind = halves(s) == 0 ? ModeKind::decaying : ModeKind::oscillating;
    const Complex exponent = halves(s) == 0 ? s.real() : s;
    for (std::size_t k = 0; k < real.size(); ++k) {
      Mode mode{exponent, kind, equations_.coefficients(real[k].u), equations_.coefficients(real[k].w)};
      HarmonicMode motion{std::move(mode), real[k].u, real[k].w, shapes_.whirl(shapes_.sizes(real[k].u, exponent))};
      if (k < places.size())
        modes_.modes[places[k]] = std::move(motion);
      else
        modes_.modes.push_back(std::move(motion));
    }
  }

  /// Tells whether an oscillation has a multiple of half the rate as its frequency by chance: a sum of the shapes is
  /// then its copy without that of its conjugate, whose harmonics are on the other side of -m / 2. In a resonance both
  /// have the same size.
  bool is_coincidence(const std::vector<Shape>& real, double halves) const {
    if (halves == 0) return false;
    constexpr double one_sided = 0.75;
    const auto count = static_cast<Eigen::Index>(real.size());
    const Eigen::Index columns = real.front().u.cols();
    const Eigen::Index zeroth = columns / 2;
    const double middle = static_cast<double>(zeroth) - 0.5 * std::copysign(halves, equations_.rate());
    const auto products = [&](bool one_side) {
      MatrixXc vectors(modes_.equations.unknowns(), count);
      for (Eigen::Index j = 0; j < count; ++j) {
        MatrixXc u = real[static_cast<std::size_t>(j)].u;
        for (Eigen::Index k = 0; k < columns; ++k)
          if (one_side && static_cast<double>(k) <= middle) u.col(k).setZero();
        vectors.col(j) = weighted(u);
      }
      return MatrixXc(vectors.adjoint() * vectors);
    };
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXc> shares(products(true), products(false),
                                                                    Eigen::EigenvaluesOnly);
    return shares.eigenvalues()[count - 1] > one_sided;
  }

  /// Returns the coefficients of a shape, as one column of weighted entries.
  Eigen::VectorXcd weighted(const MatrixXc& u) const {
    return shapes_.weights(equations_.rate(), modes_.harmonics).cwiseSqrt().cwiseProduct(equations_.coefficients(u));
  }

  /// Returns the copy of the conjugate shape that has the same exponent, whose frequency is m rate / 2.
  MatrixXc conjugate(const MatrixXc& shape, int m) const {
    return copied(shape.rowwise().reverse().conjugate(), equations_.rate() > 0 ? m : -m);
  }

  /// Returns orthogonal shapes of the same span that are equal to their conjugate copies. Harmonics that are left out
  /// make copies differ.
  std::vector<Shape> real_shapes(const std::vector<Shape>& shapes, int m) const {
    std::vector<Shape> parts;
    for (const Shape& shape : shapes) {
      const MatrixXc u = conjugate(shape.u, m), w = conjugate(shape.w, m);
      parts.push_back({shape.u + u, shape.w + w});
      parts.push_back({Complex(0, 1) * (shape.u - u), Complex(0, 1) * (shape.w - w)});
    }
    const auto count = static_cast<Eigen::Index>(parts.size());
    MatrixXc vectors(modes_.equations.unknowns(), count);
    for (Eigen::Index k = 0; k < count; ++k) vectors.col(k) = weighted(parts[static_cast<std::size_t>(k)].u);
    const Eigen::SelfAdjointEigenSolver<MatrixX> lengths((vectors.adjoint() * vectors).real());
    std::vector<Shape> real;
    constexpr double dependent = 1e-4;
    for (Eigen::Index k = count - 1; k >= 0 && real.size() < shapes.size(); --k) {
      if (!(lengths.eigenvalues()[k] > dependent * lengths.eigenvalues()[count - 1])) break;
      Shape sum{MatrixXc::Zero(parts[0].u.rows(), parts[0].u.cols()),
                MatrixXc::Zero(parts[0].w.rows(), parts[0].w.cols())};
      for (Eigen::Index j = 0; j < count; ++j) {
        sum.u += lengths.eigenvectors()(j, k) * parts[static_cast<std::size_t>(j)].u;
        sum.w += lengths.eigenvectors()(j, k) * parts[static_cast<std::size_t>(j)].w;
      }
      real.push_back(std::move(sum));
    }
    return real;
  }

  const PeriodicEquations& equations_;
  const HarmonicShapes& shapes_;
  HarmonicModes& modes_;
  EigenpairsAround around_;
  bool changed_ = false;
  std::vector<Complex> exponents_;   ///< around which motions of one frequency are sought
  std::set<std::size_t> dependent_;  ///< modes that are sums of others
};

}  // namespace

bool add_resonant_motions(const PeriodicEquations& equations, const HarmonicShapes& shapes, HarmonicModes& modes) {
  return ResonantMotions(equations, shapes, modes).add();
}

}  // namespace bielle::mechanism

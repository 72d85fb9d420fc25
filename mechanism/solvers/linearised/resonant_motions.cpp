#include "mechanism/solvers/linearised/resonant_motions.hpp"

#include <algorithm>
#include <cmath>
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
    for (const HarmonicMode& each : modes_.modes) {
      const double turns = halves(each.mode.s);
      if (is_locked(each.mode.s) && std::count(frequencies.begin(), frequencies.end(), turns) == 0)
        frequencies.push_back(turns);
    }
    for (const double turns : frequencies) add_with(turns);
    return changed_;
  }

 private:
  double rate() const { return std::abs(equations_.rate()); }
  double halves(Complex s) const { return std::round(2 * s.imag() / rate()); }
  bool is_locked(Complex s) const {
    return s.imag() > equal * rate() && std::abs(2 * s.imag() / rate() - halves(s)) < equal;
  }
  bool is_copy(Complex s, Complex other) const {
    const double turns = std::round((s.imag() - other.imag()) / rate());
    return are_equal(s, other + Complex(0, turns * rate()));
  }
  bool are_equal(Complex s, Complex other) const { return std::abs(s - other) < equal * std::max(std::abs(s), rate()); }

  /// Looks around each locked exponent of a frequency: each of its motions has a partner.
  void add_with(double turns) {
    std::vector<Complex> exponents;
    constexpr Eigen::Index others = 4;  // copies of the azimuth and of the shift in time
    Eigen::Index locked = 0;
    for (const HarmonicMode& each : modes_.modes) {
      const Complex s = each.mode.s;
      if (!is_locked(s) || halves(s) != turns) continue;
      ++locked;
      if (exponents.empty() || !are_equal(s, exponents.back())) exponents.push_back(s);
    }
    for (const Complex s : exponents) {
      try {
        around_.set_shift(s + std::max(std::abs(s), rate()) * Complex(6e-6, 8e-6));
        take(s, around_.look(2 * locked + others, EigenpairsAround::Look::exactly));
      } catch (const ComputationError&) {
        // The modes are then not complete, which the count of states shows.
      }
    }
  }

  /// Takes the locked motions of the frequency of s, those of one exponent together.
  void take(Complex s, const EigenpairsNearby& nearby) {
    std::vector<std::pair<Complex, std::vector<Shape>>> groups;
    for (const Eigenpair& pair : nearby.pairs) {
      if (!is_locked(pair.s) || halves(pair.s) != halves(s)) continue;
      Shape shape{equations_.amplitudes(pair.x.head(modes_.equations.unknowns()), modes_.harmonics),
                  equations_.amplitudes(pair.x.tail(modes_.equations.dofs), modes_.harmonics)};
      if (std::abs(pair.s.real()) < equal * rate() &&
          (halves(s) == 2 * std::round(halves(s) / 2) || shapes_.is_shift(shape.u, pair.s)))
        continue;
      const auto group =
          std::find_if(groups.begin(), groups.end(), [&](const auto& each) { return are_equal(each.first, pair.s); });
      if (group == groups.end())
        groups.push_back({pair.s, {std::move(shape)}});
      else
        group->second.push_back(std::move(shape));
    }
    for (const auto& [exponent, found] : groups) replace(exponent, found);
  }

  /// Replaces the modes of one exponent by the motions that were found with it, unless these are fewer.
  void replace(Complex s, const std::vector<Shape>& found) {
    std::vector<std::size_t> places;
    for (std::size_t k = 0; k < modes_.modes.size(); ++k) {
      const Mode& mode = modes_.modes[k].mode;
      if (mode.kind == ModeKind::rigid) continue;
      if (are_equal(mode.s, s))
        places.push_back(k);
      else if (is_copy(mode.s, s))
        return;  // the motion has been found with another frequency
    }
    const bool single = found.size() == 1 && places.size() == 1;
    if (single || found.size() < places.size()) return;
    const std::vector<Shape> real = real_shapes(found, static_cast<int>(halves(s)));
    if (real.size() < found.size()) return;
    changed_ = true;
    for (std::size_t k = 0; k < real.size(); ++k) {
      Mode mode{s, ModeKind::oscillating, equations_.coefficients(real[k].u), equations_.coefficients(real[k].w)};
      HarmonicMode motion{std::move(mode), real[k].u, real[k].w, shapes_.whirl(shapes_.sizes(real[k].u, s))};
      if (k < places.size())
        modes_.modes[places[k]] = std::move(motion);
      else
        modes_.modes.push_back(std::move(motion));
    }
  }

  /// Returns the copy of the conjugate shape that has the same exponent, whose frequency is m rate / 2.
  MatrixXc conjugate(const MatrixXc& shape, int m) const {
    const int turns = equations_.rate() > 0 ? m : -m;
    const Eigen::Index count = shape.cols(), h = count / 2;
    MatrixXc result = MatrixXc::Zero(shape.rows(), count);
    for (Eigen::Index k = -h; k <= h; ++k)
      if (const Eigen::Index from = -turns - k; std::abs(from) <= h)
        result.col(h + k) = shape.col(h + from).conjugate();
    return result;
  }

  /// Returns orthogonal shapes of the same span that are equal to their conjugate copies.
  std::vector<Shape> real_shapes(const std::vector<Shape>& shapes, int m) const {
    std::vector<Shape> parts;
    for (const Shape& shape : shapes) {
      const MatrixXc u = conjugate(shape.u, m), w = conjugate(shape.w, m);
      parts.push_back({shape.u + u, shape.w + w});
      parts.push_back({Complex(0, 1) * (shape.u - u), Complex(0, 1) * (shape.w - w)});
    }
    const auto count = static_cast<Eigen::Index>(parts.size());
    const VectorX weights = shapes_.weights(equations_.rate(), modes_.harmonics);
    MatrixXc vectors(weights.size(), count);
    for (Eigen::Index k = 0; k < count; ++k)
      vectors.col(k) = weights.cwiseSqrt().cwiseProduct(equations_.coefficients(parts[static_cast<std::size_t>(k)].u));
    const Eigen::SelfAdjointEigenSolver<MatrixX> lengths((vectors.adjoint() * vectors).real());
    std::vector<Shape> real;
    constexpr double dependent = 1e-8;
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
};

}  // namespace

bool add_resonant_motions(const PeriodicEquations& equations, const HarmonicShapes& shapes, HarmonicModes& modes) {
  return ResonantMotions(equations, shapes, modes).add();
}

}  // namespace bielle::mechanism

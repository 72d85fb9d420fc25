#include "mechanism/solvers/linearised/modes_around_mean.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mechanism/solvers/linearised/eigenpairs_around.hpp"
#include "mechanism/solvers/linearised/floquet_motions.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

using Complex = std::complex<double>;

class SearchAround {
 public:
  SearchAround(const PeriodicEquations& equations, const HarmonicShapes& shapes, const HarmonicModes& mean,
               int harmonics)
      : periodic_(equations), shapes_(shapes), mean_(mean), of_mean_(mean.modes.size(), -1) {
    found_.harmonics = harmonics;
    found_.states = mean.states;
    found_.all = mean.all;
    for (const HarmonicMode& each : mean.modes) mean_shapes_.push_back(within(each.u, harmonics));
  }

  std::optional<HarmonicModes> by_harmonics() {
    found_.equations = periodic_.of_harmonics(found_.harmonics);
    EigenpairsAround around(found_.equations, 0);
    for (std::size_t k = 0; k < mean_.modes.size(); ++k)
      if (of_mean_[k] < 0 && !look_around(k, around)) return std::nullopt;
    return sorted();
  }

  /// @param motions  all, with as many harmonics as the search
  std::optional<HarmonicModes> among(const std::vector<FloquetMotion>& motions) {
    std::vector<HarmonicMode> copies;
    for (const FloquetMotion& each : motions) {
      add_copies(each, copies);
      if (each.s.imag() != 0)
        add_copies({std::conj(each.s), each.u.rowwise().reverse().conjugate(), each.w.rowwise().reverse().conjugate()},
                   copies);
    }
    for (std::size_t k = 0; k < mean_.modes.size(); ++k)
      if (vanishes_in_turn(mean_.modes[k].mode.s, periodic_.rate())) take_from_mean(k);
    take(copies, [](std::size_t) { return least; });
    if (std::any_of(of_mean_.begin(), of_mean_.end(), [](int at) { return at < 0; })) return std::nullopt;
    return sorted();
  }

 private:
  /// A motion that may represent a mode of the mean.
  struct Candidate {
    std::size_t mean, motion;
    double share;
  };

  static constexpr double most = 0.5;   ///< a motion with a larger share of a shape is the only one
  static constexpr double least = 0.1;  ///< share of a shape that a motion needs to represent it

  void take_from_mean(std::size_t k) {
    of_mean_[k] = static_cast<int>(found_.modes.size());
    found_.modes.push_back(mean_.modes[k]);
    found_.modes.back().u = within(mean_.modes[k].u, found_.harmonics);
    found_.modes.back().w = within(mean_.modes[k].w, found_.harmonics);
  }

  HarmonicModes sorted() {
    std::vector<HarmonicMode> modes;
    for (const int at : of_mean_) modes.push_back(std::move(found_.modes[static_cast<std::size_t>(at)]));
    found_.modes = std::move(modes);
    return std::move(found_);
  }

  /// Adds the copies of a motion that may represent modes of the mean.
  void add_copies(const FloquetMotion& motion, std::vector<HarmonicMode>& copies) const {
    std::vector<int> multiples;
    for (const Eigen::MatrixXcd& of_mean : mean_shapes_) {
      const VectorX parts = shapes_.similarities(motion.u, of_mean);
      if (!(parts.sum() > least)) continue;
      const Eigen::Index h = parts.size() / 2;
      const auto multiple = static_cast<int>(std::lround(moment(parts) / parts.sum()));
      const Complex s = motion.s + Complex(0, multiple * periodic_.rate());
      if (std::abs(multiple) > h || s.imag() < 0 || std::count(multiples.begin(), multiples.end(), multiple) > 0)
        continue;
      multiples.push_back(multiple);
      Mode mode;
      mode.s = s;
      Eigen::MatrixXcd u = copied(motion.u, multiple), w = copied(motion.w, multiple);
      const double whirl = shapes_.whirl(shapes_.sizes(u, s));
      copies.push_back({std::move(mode), std::move(u), std::move(w), whirl});
    }
  }

  bool look_around(std::size_t k, EigenpairsAround& around) {
    const Complex s = mean_.modes[k].mode.s;
    constexpr Eigen::Index few = 24, several = 48;
    try {
      around.set_shift(s + std::max(std::abs(s), std::abs(periodic_.rate())) * Complex(6e-6, 8e-6));
      for (const Eigen::Index count : {few, several}) {
        const EigenpairsNearby nearby = around.look(count, EigenpairsAround::Look::without_copies);
        take(motions_of(nearby), [k](std::size_t j) { return j == k ? least : most; });
        if (of_mean_[k] >= 0) return true;
      }
    } catch (const ComputationError&) {
      return false;  // motions are so close together that they cannot be distinguished
    }
    return false;
  }

  std::vector<HarmonicMode> motions_of(const EigenpairsNearby& nearby) const {
    std::vector<HarmonicMode> motions;
    for (const Eigenpair& pair : nearby.pairs) {
      if (pair.s.imag() < 0) continue;
      const int n = found_.equations.unknowns(), dofs = found_.equations.dofs;
      Mode mode{pair.s, ModeKind::oscillating, pair.x.head(n), pair.x.tail(dofs), 0, pair.residual};
      Eigen::MatrixXcd u = periodic_.amplitudes(mode.u, found_.harmonics),
                       w = periodic_.amplitudes(mode.w, found_.harmonics);
      const double whirl = shapes_.whirl(shapes_.sizes(u, mode.s));
      motions.push_back({std::move(mode), std::move(u), std::move(w), whirl});
    }
    return motions;
  }

  /// Takes the motions that represent modes of the mean, those with the largest shares first.
  /// @param necessary  share of a motion that may represent the mode j of the mean
  template <class Necessary>
  void take(const std::vector<HarmonicMode>& motions, const Necessary& necessary) {
    std::vector<Candidate> candidates;
    for (std::size_t at = 0; at < motions.size(); ++at)
      for (std::size_t j = 0; j < mean_.modes.size(); ++j) {
        if (of_mean_[j] >= 0 || !may_be(motions[at].mode.s, mean_.modes[j].mode.s)) continue;
        const double share = share_of(motions[at].u, mean_shapes_[j]);
        if (share > necessary(j)) candidates.push_back({j, at, share});
      }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.share > b.share; });
    for (const Candidate& each : candidates) {
      const HarmonicMode& motion = motions[each.motion];
      if (of_mean_[each.mean] >= 0 || shapes_.is_shift(motion.u, motion.mode.s) ||
          is_among(shapes_, found_, motion.u, motion.mode.s))
        continue;
      of_mean_[each.mean] = static_cast<int>(found_.modes.size());
      found_.modes.push_back(motion);
    }
  }

  /// Returns whether a motion decays at about the rate of a mode of the mean. A slow and a fast decay may have the same
  /// shape, whereas copies differ only in their frequency.
  bool may_be(Complex s, Complex of_mean) const {
    return std::abs(s.real() - of_mean.real()) <= 0.5 * std::abs(of_mean) + std::abs(periodic_.rate());
  }

  /// Returns the share of a motion that copies of a mode of the mean make up. The result is zero if a copy of the
  /// motion has the mean of these harmonics nearer to zero.
  double share_of(const Eigen::MatrixXcd& u, const Eigen::MatrixXcd& of_mean) const {
    const VectorX parts = shapes_.similarities(u, of_mean);
    return std::abs(moment(parts)) <= 0.5 * parts.sum() ? parts.sum() : 0;
  }

  /// Returns the sum of k times the part of harmonic k.
  static double moment(const VectorX& parts) {
    const Eigen::Index h = parts.size() / 2;
    return VectorX::LinSpaced(parts.size(), -static_cast<double>(h), static_cast<double>(h)).dot(parts);
  }

  const PeriodicEquations& periodic_;
  const HarmonicShapes& shapes_;
  const HarmonicModes& mean_;
  std::vector<Eigen::MatrixXcd> mean_shapes_;
  std::vector<int> of_mean_;  ///< for each mode of the mean the mode that was found; -1: none yet
  HarmonicModes found_;
};

}  // namespace

std::optional<HarmonicModes> find_modes_around(const PeriodicEquations& equations, const HarmonicShapes& shapes,
                                               const HarmonicModes& mean, int harmonics) {
  return SearchAround(equations, shapes, mean, harmonics).by_harmonics();
}

std::optional<HarmonicModes> find_modes_over_turn(const PeriodicEquations& equations, const HarmonicShapes& shapes,
                                                  const HarmonicModes& mean, double angle) {
  constexpr double further = 1.1;
  double fastest = std::abs(equations.rate());
  for (const HarmonicMode& each : mean.modes)
    if (!vanishes_in_turn(each.mode.s, equations.rate())) fastest = std::max(fastest, further * std::abs(each.mode.s));
  try {
    const std::vector<FloquetMotion> motions = floquet_motions(equations, shapes, fastest, angle);
    if (motions.empty()) return std::nullopt;
    const auto all = static_cast<int>(motions.front().u.cols() / 2);
    std::optional<HarmonicModes> found = SearchAround(equations, shapes, mean, all).among(motions);
    if (!found) return std::nullopt;
    found->harmonics = 1;
    keep_necessary_harmonics(shapes, equations.rate(), *found);
    return found;
  } catch (const ComputationError&) {
    return std::nullopt;
  }
}

}  // namespace bielle::mechanism

#include "mechanism/solvers/linearised/modes_around_mean.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mechanism/solvers/linearised/eigenpairs_around.hpp"
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
    found_.equations = equations.of_harmonics(harmonics);
    found_.states = mean.states;
    found_.all = mean.all;
    for (const HarmonicMode& each : mean.modes) mean_shapes_.push_back(widened(each.u, harmonics));
  }

  std::optional<HarmonicModes> run() {
    EigenpairsAround around(found_.equations, 0);
    for (std::size_t k = 0; k < mean_.modes.size(); ++k)
      if (of_mean_[k] < 0 && !look_around(k, around)) return std::nullopt;
    std::vector<HarmonicMode> sorted;
    for (const int at : of_mean_) sorted.push_back(std::move(found_.modes[static_cast<std::size_t>(at)]));
    found_.modes = std::move(sorted);
    return std::move(found_);
  }

 private:
  /// A motion that may represent a mode of the mean.
  struct Candidate {
    std::size_t mean, motion;
    double share;
  };

  static constexpr double most = 0.5;  ///< a motion with a larger share of a shape is the only one

  bool look_around(std::size_t k, EigenpairsAround& around) {
    const Complex s = mean_.modes[k].mode.s;
    constexpr Eigen::Index few = 24, several = 48;
    try {
      around.set_shift(s + std::max(std::abs(s), std::abs(periodic_.rate())) * Complex(6e-6, 8e-6));
      for (const Eigen::Index count : {few, several}) {
        take(k, around.look(count, EigenpairsAround::Look::without_copies));
        if (of_mean_[k] >= 0) return true;
      }
    } catch (const ComputationError&) {
      return false;  // motions are so close together that they cannot be distinguished
    }
    return false;
  }

  /// Takes the motion that represents the mode k of the mean, and the motions that certainly represent other modes.
  void take(std::size_t k, const EigenpairsNearby& nearby) {
    std::vector<HarmonicMode> motions;
    std::vector<Candidate> candidates;
    for (const Eigenpair& pair : nearby.pairs) {
      if (pair.s.imag() < 0) continue;
      const int n = found_.equations.unknowns(), dofs = found_.equations.dofs;
      Mode mode{pair.s, ModeKind::oscillating, pair.x.head(n), pair.x.tail(dofs), 0, pair.residual};
      Eigen::MatrixXcd u = periodic_.amplitudes(mode.u, found_.harmonics),
                       w = periodic_.amplitudes(mode.w, found_.harmonics);
      for (std::size_t j = 0; j < mean_.modes.size(); ++j) {
        constexpr double least = 0.1;
        if (of_mean_[j] >= 0 || !may_be(pair.s, mean_.modes[j].mode.s)) continue;
        const double share = share_of(u, mean_shapes_[j]);
        if (share > (j == k ? least : most)) candidates.push_back({j, motions.size(), share});
      }
      const double whirl = shapes_.whirl(shapes_.sizes(u, mode.s));
      motions.push_back({std::move(mode), std::move(u), std::move(w), whirl});
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
    const Eigen::Index h = parts.size() / 2;
    double moment = 0;
    for (Eigen::Index k = -h; k <= h; ++k) moment += static_cast<double>(k) * parts[h + k];
    return std::abs(moment) <= 0.5 * parts.sum() ? parts.sum() : 0;
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
  return SearchAround(equations, shapes, mean, harmonics).run();
}

}  // namespace bielle::mechanism

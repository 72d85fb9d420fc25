#include "mechanism/solvers/linearised/mode_tracking.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace bielle::mechanism {
namespace {

using Complex = std::complex<double>;
using Shape = Eigen::VectorXcd;
using Sparse = LinearisedEquations::Sparse;

Complex inner(const Sparse& M, const Shape& u, const Shape& v) { return u.dot(M.cast<Complex>() * v); }

double square(const Sparse& M, const Shape& u) { return std::max(0.0, inner(M, u, u).real()); }

/// Space of shapes, with a basis that is orthonormal with respect to M.
class ShapeSpace {
 public:
  explicit ShapeSpace(const Sparse& M) : M_(M) {}

  void add(const Shape& shape) {
    Shape rest = shape;
    for (int twice = 0; twice < 2; ++twice) rest -= projected(rest);
    constexpr double repeated = 1e-12;
    const double left = square(M_, rest);
    if (left > repeated * square(M_, shape)) basis_.push_back(rest / std::sqrt(left));
  }
  Shape projected(const Shape& shape) const {
    Shape part = Shape::Zero(shape.size());
    for (const Shape& each : basis_) part += each * inner(M_, each, shape);
    return part;
  }
  /// Returns the fraction of a shape that is in the space, 0..1.
  double share(const Shape& shape) const {
    const double whole = square(M_, shape);
    if (whole == 0) return 0;
    double sum = 0;
    for (const Shape& each : basis_) sum += std::norm(inner(M_, each, shape));
    return std::min(1.0, sum / whole);
  }

 private:
  const Sparse& M_;
  std::vector<Shape> basis_;
};

/// Returns the number of the group of each mode; modes with equal frequencies are a group. Rounding rotates shapes by
/// its own size divided by the distance of their frequencies.
std::vector<int> groups_of(const std::vector<Mode>& modes) {
  constexpr double same = 1e-6;
  std::vector<int> group(modes.size(), -1);
  int count = 0;
  for (std::size_t k = 0; k < modes.size(); ++k) {
    for (std::size_t before = 0; before < k && group[k] < 0; ++before)
      if (std::abs(modes[k].s - modes[before].s) <= same * std::abs(modes[k].s)) group[k] = group[before];
    if (group[k] < 0) group[k] = count++;
  }
  return group;
}

/// Sets of modes at rest, or next to it, that mix among themselves. A set has as many modes after as before, and those
/// after are nearly in the space of those before.
class MixedSets {
 public:
  MixedSets(const ModeSample& before, const ModeSample& after)
      : M_(after.M), before_(before.modes.size()), set_(before_ + after.modes.size()), share_(after.modes.size(), 0) {
    std::iota(set_.begin(), set_.end(), std::size_t{0});
    for (std::size_t i = 0; i < before_; ++i)
      for (std::size_t k = 0; k < after.modes.size(); ++k) {
        constexpr double related = 0.05;
        if (shape_correlation(M_, before.modes[i].u, after.modes[k].u) >= related) unite(i, before_ + k);
      }
    for (std::size_t i = 0; i < before_; ++i)
      if (first_of(set_[i]) == i) add(before, after, set_[i]);
  }

  /// Returns the fraction of the shape of mode `k` that is in the space that the set had before, if the shape `u` is in
  /// this space as well; otherwise zero.
  double share(const Shape& u, std::size_t k) const {
    const auto space = spaces_.find(set_[before_ + k]);
    return space != spaces_.end() && space->second.share(u) >= same_space ? share_[k] : 0;
  }

 private:
  static constexpr double same_space = 0.9;

  void unite(std::size_t a, std::size_t b) {
    const std::size_t kept = set_[a], dropped = set_[b];
    for (std::size_t& each : set_)
      if (each == dropped) each = kept;
  }
  std::size_t first_of(std::size_t set) const {
    return static_cast<std::size_t>(std::find(set_.begin(), set_.end(), set) - set_.begin());
  }
  void add(const ModeSample& before, const ModeSample& after, std::size_t set) {
    ShapeSpace space(M_);
    std::vector<double> share(share_.size(), 0);
    std::ptrdiff_t excess = 0;
    for (std::size_t i = 0; i < before_; ++i) {
      if (set_[i] != set) continue;
      space.add(before.modes[i].u);
      ++excess;
    }
    for (std::size_t k = 0; k < share.size(); ++k) {
      if (set_[before_ + k] != set) continue;
      share[k] = space.share(after.modes[k].u);
      if (share[k] < same_space) return;
      --excess;
    }
    if (excess != 0) return;
    for (std::size_t k = 0; k < share.size(); ++k) share_[k] = std::max(share_[k], share[k]);
    spaces_.emplace(set, std::move(space));
  }

  const Sparse& M_;
  std::size_t before_;
  std::vector<std::size_t> set_;  ///< for each mode before, then for each mode after
  std::vector<double> share_;
  std::map<std::size_t, ShapeSpace> spaces_;
};

struct Pairing {
  std::size_t track, mode;
  bool conjugate;
  double score, correlation;
};

class Following {
 public:
  /// @param mixed  sets of modes that mix; null if there are none
  Following(const std::vector<TrackedMode>& before, const ModeSample& sample, const MixedSets* mixed)
      : before_(before), sample_(sample), mixed_(mixed), group_(groups_of(sample.modes)) {
    for (const int group : group_) groups_ = std::max(groups_, group + 1);
    for (int group = 0; group < groups_; ++group) {
      spaces_.emplace_back(sample.M);
      mirrored_.emplace_back(sample.M);
      members_.push_back(0);
      for (std::size_t k = 0; k < sample.modes.size(); ++k) {
        if (group_[k] != group) continue;
        spaces_.back().add(sample.modes[k].u);
        mirrored_.back().add(sample.modes[k].u.conjugate());
        ++members_.back();
      }
    }
  }

  std::vector<TrackedMode> run() {
    std::vector<Pairing> pairings;
    for (std::size_t i = 0; i < before_.size(); ++i) add_pairings(i, pairings);
    std::stable_sort(pairings.begin(), pairings.end(),
                     [](const Pairing& a, const Pairing& b) { return a.score > b.score; });
    std::vector<TrackedMode> after = before_;
    for (TrackedMode& track : after) {
      track.found = false;
      track.correlation = 0;
    }
    std::vector<bool> taken(sample_.modes.size(), false);
    for (const Pairing& pairing : pairings) {
      if (after[pairing.track].found || taken[pairing.mode]) continue;
      taken[pairing.mode] = true;
      after[pairing.track] = continued(pairing);
    }
    return after;
  }

 private:
  static Shape shape_of(const Mode& mode, bool conjugate) { return conjugate ? Shape(mode.u.conjugate()) : mode.u; }

  void add_pairings(std::size_t i, std::vector<Pairing>& pairings) const {
    const TrackedMode& track = before_[i];
    // Preference of a mode over its conjugate (a passage through zero), which has the same shape if it is real.
    constexpr double rather_not = 0.99;
    ShapeSpace open(sample_.M);
    if (track.open >= 0)
      for (const TrackedMode& other : before_)
        if (other.open == track.open) open.add(other.u);
    for (std::size_t k = 0; k < sample_.modes.size(); ++k)
      for (const bool conjugate : {false, true}) {
        const auto group = static_cast<std::size_t>(group_[k]);
        const bool alone = members_[group] == 1;
        const double correlation = track.open >= 0 && alone ? open.share(shape_of(sample_.modes[k], conjugate))
                                                            : (conjugate ? mirrored_ : spaces_)[group].share(track.u);
        constexpr double least = 1e-3;
        // If modes are indistinguishable, the one with the nearest frequency is chosen.
        const double near = std::abs(std::abs(sample_.modes[k].s) - std::abs(track.s)) / (std::abs(track.s) + 1e-300);
        constexpr double hardly = 1e-4;
        const double score = correlation * (conjugate ? rather_not : 1.0) - hardly * std::min(near, 1.0);
        const double mixed = mixed_ && !conjugate ? mixed_->share(track.u, k) : 0;
        if (std::max(correlation, mixed) > least)
          pairings.push_back({i, k, conjugate, score, std::max(correlation, mixed)});
      }
  }

  TrackedMode continued(const Pairing& pairing) const {
    const TrackedMode& track = before_[pairing.track];
    const Mode& mode = sample_.modes[pairing.mode];
    const auto group = static_cast<std::size_t>(group_[pairing.mode]);
    const bool alone = members_[group] == 1;
    TrackedMode after;
    after.found = true;
    after.correlation = pairing.correlation;
    after.s = pairing.conjugate ? std::conj(mode.s) : mode.s;
    after.uncertainty = mode.uncertainty;
    after.grows = mode.kind == ModeKind::growing;
    after.whirl = alone ? sample_.whirl[pairing.mode] : NAN;
    after.u = shape_of(mode, pairing.conjugate);
    if (alone) return after;
    if (track.open >= 0)
      after.open = track.open;
    else
      after.u = (pairing.conjugate ? mirrored_ : spaces_)[group].projected(track.u);
    return after;
  }

  const std::vector<TrackedMode>& before_;
  const ModeSample& sample_;
  const MixedSets* mixed_;
  std::vector<int> group_;
  int groups_ = 0;
  std::vector<ShapeSpace> spaces_, mirrored_;  ///< for each group, and for the conjugate shapes
  std::vector<int> members_;
};

}  // namespace

double shape_correlation(const Sparse& M, const Shape& u, const Shape& v) {
  const double sizes = square(M, u) * square(M, v);
  return sizes > 0 ? std::norm(inner(M, u, v)) / sizes : 0;
}

std::vector<TrackedMode> begin_tracks(const ModeSample& sample, int count) {
  const std::vector<int> group = groups_of(sample.modes);
  std::vector<TrackedMode> tracks;
  for (std::size_t k = 0; k < std::min(sample.modes.size(), static_cast<std::size_t>(count)); ++k) {
    const bool alone = std::count(group.begin(), group.end(), group[k]) == 1;
    TrackedMode& track = tracks.emplace_back();
    track.found = true;
    track.s = sample.modes[k].s;
    track.uncertainty = sample.modes[k].uncertainty;
    track.grows = sample.modes[k].kind == ModeKind::growing;
    track.u = sample.modes[k].u;
    track.correlation = 1;
    track.whirl = alone ? sample.whirl[k] : NAN;
    track.open = alone ? -1 : group[k];
  }
  return tracks;
}

std::vector<TrackedMode> follow_tracks(const std::vector<TrackedMode>& before, const ModeSample& sample) {
  return Following(before, sample, nullptr).run();
}

std::vector<TrackedMode> follow_mixed_tracks(const std::vector<TrackedMode>& before, const ModeSample& from,
                                             const ModeSample& sample) {
  const MixedSets mixed(from, sample);
  return Following(before, sample, &mixed).run();
}

}  // namespace bielle::mechanism

#include "mechanism/solvers/linearised/harmonic_modes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "mechanism/solvers/linearised/finite_states.hpp"
#include "mechanism/solvers/linearised/orthonormal.hpp"

namespace bielle::mechanism {

/// Inserts the shift in time among the rigid modes, unless it is a sum of those.
void HarmonicSearch::add_shift(HarmonicModes& result) const {
  const int h = result.harmonics;
  const VectorX u = shapes_.shift(h), scale = shapes_.weights(equations_.rate(), h).cwiseSqrt();
  std::vector<VectorX> rigid;
  for (const Mode& mode : result.found.modes)
    if (mode.kind == ModeKind::rigid) rigid.emplace_back(scale.cwiseProduct(mode.u.real()));
  MatrixX known(u.size(), static_cast<Eigen::Index>(rigid.size()));
  for (std::size_t k = 0; k < rigid.size(); ++k) known.col(static_cast<Eigen::Index>(k)) = rigid[k];
  if (!rigid.empty()) known = orthonormal_columns(known);
  const VectorX scaled = scale.cwiseProduct(u);
  constexpr double same = 0.3;  // harmonics that are left out
  if ((scaled - known * (known.transpose() * scaled)).norm() < same * scaled.norm()) return;
  Mode mode;
  mode.s = 0;
  mode.kind = ModeKind::rigid;
  mode.u = u.cast<std::complex<double>>();
  mode.w = (result.equations.W * u).head(result.equations.dofs).cast<std::complex<double>>();
  result.u.insert(result.u.begin(), equations_.amplitudes(mode.u, h));
  result.w.insert(result.w.begin(), equations_.amplitudes(mode.w, h));
  result.whirl.insert(result.whirl.begin(), NAN);
  result.found.modes.insert(result.found.modes.begin(), std::move(mode));
}

namespace {

void sort_by_distance(double frequency, std::vector<Mode>& modes) {
  const std::complex<double> near(0, 2 * std::numbers::pi * frequency);
  std::stable_sort(modes.begin(), modes.end(),
                   [&](const Mode& a, const Mode& b) { return std::abs(a.s - near) < std::abs(b.s - near); });
}

/// Sorts what was found by rates.
void sort_by_rate(HarmonicModes& modes) {
  std::vector<std::size_t> order(modes.found.modes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::abs(modes.found.modes[a].s) < std::abs(modes.found.modes[b].s);
  });
  HarmonicModes sorted;
  for (const std::size_t k : order) {
    sorted.found.modes.push_back(std::move(modes.found.modes[k]));
    sorted.u.push_back(std::move(modes.u[k]));
    sorted.w.push_back(std::move(modes.w[k]));
    sorted.whirl.push_back(modes.whirl[k]);
  }
  modes.found.modes = std::move(sorted.found.modes);
  modes.u = std::move(sorted.u);
  modes.w = std::move(sorted.w);
  modes.whirl = std::move(sorted.whirl);
}

}  // namespace

/// Takes the principal modes. @returns whether there are enough
bool HarmonicSearch::take(Modes found, const ModeOptions& options, HarmonicModes& result) const {
  result.found.modes.clear();
  result.u.clear();
  result.w.clear();
  result.whirl.clear();
  result.found.states = found.states / (2 * result.harmonics + 1);
  result.found.all = found.all;
  if (result.harmonics == 0) result.found.growing_besides = found.growing_besides;
  int count = 0;
  const bool shifts = shapes_.any_shift() && !options.near;
  const auto finish = [&](bool enough) {
    if (options.near) sort_by_rate(result);
    if (shifts) add_shift(result);
    result.found.all = result.found.all && (result.harmonics == 0 || is_complete(result));
    return enough;
  };
  if (options.near) sort_by_distance(*options.near, found.modes);
  for (Mode& mode : found.modes) {
    Eigen::MatrixXcd u = equations_.amplitudes(mode.u, result.harmonics);
    const bool rigid = mode.kind == ModeKind::rigid && shifts;
    const HarmonicSizes sizes = shapes_.sizes(u, mode.s);
    if (!rigid && (shapes_.is_shift(u, mode.s) || is_phase(mode.s, sizes))) continue;
    if (!rigid && sizes.largest() != 0) continue;
    if (mode.kind != ModeKind::rigid && result.harmonics > 0 && is_among(shapes_, result, u, mode.s)) continue;
    if (mode.kind != ModeKind::rigid && !options.below && ++count > options.count) {
      result.found.all = false;
      return finish(true);
    }
    result.w.push_back(equations_.amplitudes(mode.w, result.harmonics));
    result.u.push_back(std::move(u));
    result.found.modes.push_back(std::move(mode));
    result.whirl.push_back(shapes_.whirl(sizes));
  }
  return finish(options.below || found.all || count >= options.count);
}

/// Whether a mode is a copy of a free azimuth: a drive of the rate leaves it one exponent of zero, which is a state.
/// Most of its motion stands still then, which distinguishes it from a resonance with the rotation.
bool HarmonicSearch::is_phase(std::complex<double> s, const HarmonicSizes& sizes) const {
  constexpr double zero = 1e-7, most = 0.5;
  const double rate = equations_.rate(), k = std::round(s.imag() / rate);
  const VectorX all = sizes.standing + sizes.turning;
  const double h = static_cast<double>(all.size() / 2);
  return k != 0 && std::abs(k) <= h && std::abs(s - std::complex<double>(0, k * rate)) < zero * std::abs(rate) &&
         all[static_cast<Eigen::Index>(h - k)] > most * all.sum();
}

/// Whether the modes are as many as the finite eigenvalues of the equations at one azimuth.
bool HarmonicSearch::is_complete(const HarmonicModes& modes) const {
  const LinearisedEquations& first = equations_.first();
  constexpr int most = 2000;  // limit of states for counting
  if (first.states() > most) return false;
  const ShiftedOperator T(first, equations_.rate());
  if (!T.regular()) return false;
  Eigen::Index least = 0, greatest = 0;
  for (const Mode& mode : modes.found.modes) {
    // A motion that is locked to the rotation is its own conjugate.
    const double turns = 2 * mode.s.imag() / equations_.rate();
    constexpr double rounding = 1e-6;
    const bool single = mode.kind == ModeKind::rigid || std::abs(turns - std::round(turns)) < rounding;
    least += single ? 1 : 2;
    greatest += single && mode.kind != ModeKind::rigid ? 1 : 2;
  }
  const Eigen::Index all = count_finite_eigenvalues(first, T);
  return least <= all && all <= greatest;
}

HarmonicModes HarmonicSearch::find_with(const ModeOptions& options, int harmonics) const {
  HarmonicModes result;
  result.harmonics = harmonics;
  result.equations = equations_.of_harmonics(harmonics);
  ModeOptions search = options;
  if (harmonics > 0) search.count = (2 * harmonics + 1) * options.count + 4;
  constexpr int tries = 4;
  for (int k = 0; k < tries; ++k) {
    if (take(find_modes(result.equations, search), options, result)) return result;
    search.count *= 2;
  }
  if (std::none_of(result.found.modes.begin(), result.found.modes.end(),
                   [](const Mode& mode) { return mode.kind != ModeKind::rigid; }))
    throw ComputationError(
        "the modes of the periodic equations were not found: their rates differ too much (a part that turns hardly "
        "has inertia?)");
  return result;
}

/// Whether a rigid mode may be the shift in time, which it resembles with more harmonics only: those of rigid modes are
/// not continued.
bool HarmonicSearch::counts_shift_twice(const HarmonicModes& modes) const {
  const auto is_rigid = [](const Mode& mode) { return mode.kind == ModeKind::rigid; };
  return shapes_.any_shift() && std::count_if(modes.found.modes.begin(), modes.found.modes.end(), is_rigid) > 1;
}

/// Returns the oscillations and decays about the mean state, some more than asked for; nothing if they have harmonics
/// of their own, or if there are more rigid modes than the shift in time.
std::optional<HarmonicModes> HarmonicSearch::modes_of_mean(const ModeOptions& options) const {
  if (!mean_ || options.near) return std::nullopt;
  constexpr int more = 4;  // the order of exponents may change
  constexpr double higher = 1.05;
  ModeOptions wider = options;
  wider.count += more;
  if (wider.below) *wider.below *= higher;
  HarmonicModes mean = mean_->find(wider);
  if (mean.periodicity == Periodicity::periodic) return std::nullopt;
  int rigid = 0;
  for (std::size_t k = mean.found.modes.size(); k-- > 0;) {
    if (mean.found.modes[k].kind != ModeKind::rigid) continue;
    const auto at = static_cast<std::ptrdiff_t>(k);
    mean.found.modes.erase(mean.found.modes.begin() + at);
    mean.u.erase(mean.u.begin() + at);
    mean.w.erase(mean.w.begin() + at);
    mean.whirl.erase(mean.whirl.begin() + at);
    ++rigid;
  }
  if (rigid != (shapes_.any_shift() ? 1 : 0)) return std::nullopt;
  return mean;
}

/// Continues modes from the mean equations to these, in steps if necessary.
std::optional<HarmonicModes> HarmonicSearch::continue_mean(const HarmonicModes& mean, int harmonics) const {
  constexpr double least = 1.0 / 32;
  constexpr int modulated = 8;
  // One step with few harmonics suffices unless frequencies are modulated by more than the rate.
  if (auto modes = continue_modes(equations_, shapes_, mean, harmonics, Copies::continued)) return modes;
  HarmonicModes modes = mean;
  double made = 0, step = 0.5;
  while (made < 1) {
    const double end = std::min(1.0, made + step);
    const PeriodicEquations here = mean_equations_->towards(equations_, end);
    auto next = continue_modes(here, shapes_, modes, std::max(harmonics, modulated), Copies::continued);
    if (next) {
      modes = *std::move(next);
      made = end;
      continue;
    }
    step /= 2;
    if (step < least) return std::nullopt;
  }
  return modes;
}

/// Completes modes that were continued from those of the mean.
void HarmonicSearch::finish_continued(const ModeOptions& options, HarmonicModes& modes) const {
  judge_modes(modes, options);
  sort_by_rate(modes);
  const std::vector<Mode>& all = modes.found.modes;
  const auto slow = [&](const Mode& mode) { return mode.frequency() <= *options.below; };
  const auto count = options.below ? static_cast<std::size_t>(std::count_if(all.begin(), all.end(), slow))
                                   : static_cast<std::size_t>(options.count);
  if (all.size() > count) {
    modes.found.all = false;
    modes.found.modes.resize(count);
    modes.u.resize(count);
    modes.w.resize(count);
    modes.whirl.resize(count);
  }
  if (shapes_.any_shift()) add_shift(modes);
  modes.found.all = modes.found.all && is_complete(modes);
}

HarmonicModes HarmonicSearch::find(const ModeOptions& options, int least) const {
  if (equations_.constant()) return find_with(options, 0);
  constexpr int most = 64, most_searched = 16;
  constexpr double exact = 1e-7;
  const std::optional<HarmonicModes> mean = modes_of_mean(options);
  std::optional<HarmonicModes> of_mean = mean ? continue_mean(*mean, std::max(1, least)) : std::nullopt;
  Copies copies = of_mean ? Copies::continued : Copies::largest;
  const auto finish = [&](HarmonicModes& modes) {
    if (copies == Copies::continued) {
      finish_continued(options, modes);
    } else if (mean) {
      take_copies_of(*mean, equations_, shapes_, modes);
      sort_by_rate(modes);
    }
  };
  HarmonicModes modes = of_mean ? *std::move(of_mean) : find_with(options, std::max(1, least));
  for (bool continued = false;;) {
    const int h = modes.harmonics, more = h + std::max(1, h / 2);
    if (h == 1 && are_exact(equations_, modes, exact)) {
      modes.periodicity = Periodicity::multiblade;
      finish(modes);
      return modes;
    }
    std::optional<HarmonicModes> next = continue_modes(equations_, shapes_, modes, more, copies);
    if (next && next->change < exact) {
      if (copies == Copies::largest && continued && h <= most_searched && counts_shift_twice(modes))
        modes = find_with(options, h);
      modes.change = next->change;
      modes.periodicity = h == 1 ? Periodicity::multiblade : Periodicity::periodic;
      if (copies == Copies::largest && continued) judge_modes(modes, options);
      finish(modes);
      return modes;
    }
    if (more > (next ? most : most_searched))
      throw ComputationError(fmt::format(
          "the modes of the periodic equations do not converge with {} harmonics of the rotation{}: ask for fewer "
          "modes or for a faster rotation; about as many harmonics are necessary as the rate is contained in the "
          "change of a frequency over a turn",
          h, next ? fmt::format(" (further ones change them by {:.2g})", next->change) : ""));
    continued = next.has_value();
    if (!next) copies = Copies::largest;
    modes = next ? *std::move(next) : find_with(options, more);
  }
}

}  // namespace bielle::mechanism

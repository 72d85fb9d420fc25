#include "mechanism/solvers/linearised/harmonic_modes.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "mechanism/solvers/linearised/finite_states.hpp"
#include "mechanism/solvers/linearised/floquet_motions.hpp"
#include "mechanism/solvers/linearised/modes_around_mean.hpp"
#include "mechanism/solvers/linearised/orthonormal.hpp"
#include "mechanism/solvers/linearised/resonant_motions.hpp"

namespace bielle::mechanism {
namespace {

constexpr double exact = 1e-7;  // relative change of an exponent by further harmonics

/// Number of harmonics after these that shows whether they suffice.
int next_harmonics(int h) { return h + std::max(1, h / 2); }

bool is_rigid(const HarmonicMode& each) { return each.mode.kind == ModeKind::rigid; }

/// @param change  relative change of an exponent by further harmonics; 0: not known
[[noreturn]] void throw_unresolved(int harmonics, double change) {
  throw ComputationError(fmt::format(
      "the modes of the periodic equations do not converge with {} harmonics of the rotation{}: ask for fewer "
      "modes or for a faster rotation; about as many harmonics are necessary as the rate is contained in the "
      "change of a frequency over a turn",
      harmonics, change > 0 ? fmt::format(" (further ones change them by {:.2g})", change) : ""));
}

}  // namespace

HarmonicModes HarmonicSearch::find_resolved(const ModeOptions& options) const {
  HarmonicModes modes = find(options);
  if (modes.unresolved > 0) throw_unresolved(modes.unresolved, 0);
  return modes;
}

/// Inserts the shift in time among the rigid modes, unless it is a sum of those.
void HarmonicSearch::add_shift(HarmonicModes& result) const {
  const int h = result.harmonics;
  const VectorX u = shapes_.shift(h), scale = shapes_.weights(equations_.rate(), h).cwiseSqrt();
  std::vector<VectorX> rigid;
  for (const HarmonicMode& each : result.modes)
    if (is_rigid(each)) rigid.emplace_back(scale.cwiseProduct(each.mode.u.real()));
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
  Eigen::MatrixXcd of_u = equations_.amplitudes(mode.u, h), of_w = equations_.amplitudes(mode.w, h);
  result.modes.insert(result.modes.begin(), {std::move(mode), std::move(of_u), std::move(of_w), NAN});
}

namespace {

void sort_by_distance(double frequency, std::vector<Mode>& modes) {
  const std::complex<double> near(0, 2 * std::numbers::pi * frequency);
  std::stable_sort(modes.begin(), modes.end(),
                   [&](const Mode& a, const Mode& b) { return std::abs(a.s - near) < std::abs(b.s - near); });
}

}  // namespace

/// Takes the principal modes. @returns whether there are enough
bool HarmonicSearch::take(Modes found, const ModeOptions& options, HarmonicModes& result) const {
  result.modes.clear();
  result.states = found.states / (2 * result.harmonics + 1);
  result.all = found.all;
  if (result.harmonics == 0) result.growing_besides = found.growing_besides;
  int count = 0;
  const bool shifts = shapes_.any_shift() && !options.near;
  const auto finish = [&](bool enough) {
    if (options.near) sort_by_rate(result.modes);
    if (shifts) add_shift(result);
    result.all = result.all && (result.harmonics == 0 || is_complete(result));
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
      result.all = false;
      return finish(true);
    }
    Eigen::MatrixXcd w = equations_.amplitudes(mode.w, result.harmonics);
    result.modes.push_back({std::move(mode), std::move(u), std::move(w), shapes_.whirl(sizes)});
  }
  return finish(options.below || found.all || count >= options.count);
}

/// Whether a mode is a copy of a free azimuth: a drive of the rate leaves it one exponent of zero, which is a state.
/// Most of its motion stands still then, which distinguishes it from a resonance with the rotation.
bool HarmonicSearch::is_phase(std::complex<double> s, const HarmonicSizes& sizes) const {
  constexpr double zero = 1e-7, most = 0.5;
  const double rate = equations_.rate(), k = std::round(s.imag() / rate);
  const VectorX all = sizes.standing + sizes.turning;
  const Eigen::Index h = all.size() / 2;
  return k != 0 && std::abs(k) <= static_cast<double>(h) &&
         std::abs(s - std::complex<double>(0, k * rate)) < zero * std::abs(rate) &&
         all[h - static_cast<Eigen::Index>(k)] > most * all.sum();
}

/// Whether the modes are as many as the finite eigenvalues of the equations at one azimuth.
bool HarmonicSearch::is_complete(const HarmonicModes& modes) const {
  const LinearisedEquations& first = equations_.first();
  constexpr int most = 2000;  // limit of states for counting
  if (first.states() > most) return false;
  const ShiftedOperator T(first, equations_.rate());
  if (!T.regular()) return false;
  Eigen::Index least = 0, greatest = 0;
  for (const HarmonicMode& each : modes.modes) {
    // A motion that is locked to the rotation is its own conjugate.
    const double turns = 2 * each.mode.s.imag() / equations_.rate();
    constexpr double rounding = 1e-6;
    const bool single = is_rigid(each) || std::abs(turns - std::round(turns)) < rounding;
    least += single ? 1 : 2;
    greatest += single && !is_rigid(each) ? 1 : 2;
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
  if (std::all_of(result.modes.begin(), result.modes.end(), is_rigid))
    throw ComputationError(
        "the modes of the periodic equations were not found: their rates differ too much (a part that turns hardly "
        "has inertia?)");
  return result;
}

/// Returns the oscillations and decays about the mean state; nothing if some of these may be missing, or if there are
/// more rigid modes than the shift in time. Some more than asked for are returned, as their order may change, unless
/// the mean equations are periodic as well: a fast mode with many copies would take most of the time.
std::optional<HarmonicModes> HarmonicSearch::modes_of_mean(const ModeOptions& options) const {
  if (!mean_ || options.near) return std::nullopt;
  constexpr int more = 4;
  constexpr double higher = 1.05;
  HarmonicModes mean = mean_->find(options);
  const bool periodic = mean.periodicity == Periodicity::periodic;
  if (!periodic && !mean.all) {
    ModeOptions wider = options;
    wider.count += more;
    if (wider.below) *wider.below *= higher;
    mean = mean_->find(wider);
  }
  const auto others = std::stable_partition(mean.modes.begin(), mean.modes.end(), is_rigid);
  if (others - mean.modes.begin() != (shapes_.any_shift() ? 1 : 0)) return std::nullopt;
  mean.modes.erase(mean.modes.begin(), others);
  // Copies may hide modes of mean equations that are periodic as well.
  const bool enough = !options.below && static_cast<int>(mean.modes.size()) >= options.count;
  if (periodic && !mean.all && !enough) return std::nullopt;
  return mean;
}

namespace {

/// Makes the shapes of modes with one exponent orthogonal: iterations that begin at different shapes may end at nearly
/// parallel ones of the space that belongs to it.
/// @param weights  weight of each coefficient of u
void separate_equal(const VectorX& weights, double rate, std::vector<HarmonicMode>& modes) {
  constexpr double equal = 1e-9;  // relative difference of exponents
  for (std::size_t k = 1; k < modes.size(); ++k)
    for (int pass = 0; pass < 2; ++pass)  // the second one removes what rounding leaves of nearly parallel shapes
      for (std::size_t j = 0; j < k; ++j) {
        HarmonicMode& mode = modes[k];
        const HarmonicMode& other = modes[j];
        if (is_rigid(mode) || is_rigid(other)) continue;
        const double size = std::max(std::abs(mode.mode.s), std::abs(rate));
        if (std::abs(mode.mode.s - other.mode.s) > equal * size) continue;
        const Eigen::VectorXcd weighted = weights.cwiseProduct(other.mode.u);
        const std::complex<double> c = weighted.dot(mode.mode.u) / weighted.dot(other.mode.u).real();
        mode.mode.u -= c * other.mode.u;
        mode.mode.w -= c * other.mode.w;
        mode.u -= c * other.u;
        mode.w -= c * other.w;
      }
}

}  // namespace

/// Adds the shift in time to modes that were continued, and keeps as many of the slowest ones as were asked for.
void HarmonicSearch::complete(const ModeOptions& options, HarmonicModes& modes) const {
  separate_equal(shapes_.weights(equations_.rate(), modes.harmonics), equations_.rate(), modes.modes);
  judge_modes(modes, options);
  sort_by_rate(modes.modes);
  const auto others = std::stable_partition(modes.modes.begin(), modes.modes.end(), is_rigid);
  const auto slow = [&](const HarmonicMode& each) { return each.mode.frequency() <= *options.below; };
  const auto count = options.below ? std::count_if(others, modes.modes.end(), slow) : options.count;
  if (modes.modes.end() - others > count) {
    modes.all = false;
    modes.modes.erase(others + count, modes.modes.end());
  }
  if (shapes_.any_shift()) add_shift(modes);
  modes.all = modes.all && is_complete(modes);
}

/// Continues modes with more harmonics until these change no exponent. @returns nothing if `most` do not suffice
std::optional<HarmonicModes> HarmonicSearch::converged(HarmonicModes modes, int most) const {
  while (true) {
    const int h = modes.harmonics, more = next_harmonics(h);
    modes.periodicity = h == 1 ? Periodicity::multiblade : Periodicity::periodic;
    if (h == 1 && are_exact(equations_, modes, exact)) {
      modes.change = 0;
      return modes;
    }
    if (more > most) return std::nullopt;
    std::optional<HarmonicModes> next = continue_modes(equations_, shapes_, modes, more, Copies::continued);
    if (!next) return std::nullopt;
    if (next->change < exact) {
      modes.change = next->change;
      return modes;
    }
    modes = *std::move(next);
  }
}

/// Returns the largest number of harmonics about a periodic motion. Each mode needs factors of the equations of the
/// harmonics, whose cost grows with about the cube of their number: half a minute for 12 modes and 110 unknowns.
int HarmonicSearch::most_affordable() const {
  constexpr int least = 9, most = 64, unknowns = 3000;
  return std::clamp((unknowns / equations_.first().unknowns() - 1) / 2, least, most);
}

/// Finds the motions about the periodic motion among those that the monodromy matrix shows. If the equations of the
/// harmonics are too large, exponents are those of the time integration with smaller steps.
std::optional<HarmonicModes> HarmonicSearch::motions_over_turn_from(const HarmonicModes& mean, int most) const {
  std::optional<HarmonicModes> found = find_modes_over_turn(equations_, shapes_, mean, coarse_angle);
  if (!found) return std::nullopt;
  if (next_harmonics(found->harmonics) <= most)
    if (auto next = continue_modes(equations_, shapes_, *found, found->harmonics, Copies::continued))
      if (auto modes = converged(*std::move(next), most)) return modes;
  if (std::any_of(mean.modes.begin(), mean.modes.end(),
                  [&](const HarmonicMode& each) { return vanishes_in_turn(each.mode.s, equations_.rate()); }))
    return std::nullopt;
  constexpr int most_harmonics = 64;
  constexpr double finer = 3, gain = 243;  // the order is five
  std::optional<HarmonicModes> fine = find_modes_over_turn(equations_, shapes_, mean, coarse_angle / finer);
  if (!fine || fine->harmonics > most_harmonics) return std::nullopt;
  fine->equations = equations_.of_harmonics(fine->harmonics);
  fine->periodicity = Periodicity::periodic;
  for (std::size_t k = 0; k < fine->modes.size(); ++k) {
    auto& [mode, u, w, whirl] = fine->modes[k];
    mode.u = equations_.coefficients(u);
    mode.w = equations_.coefficients(w);
    const double size = std::max(std::abs(mode.s), std::abs(equations_.rate()));
    fine->change = std::max(fine->change, std::abs(mode.s - found->modes[k].mode.s) / size / (gain - 1));
  }
  if (!(fine->change < exact)) return std::nullopt;
  return fine;
}

HarmonicModes HarmonicSearch::find_from(const HarmonicModes& mean, const ModeOptions& options, int least) const {
  const int most = most_affordable(), most_searched = 2 * most / 3;
  std::optional<HarmonicModes> modes;
  if (mean.harmonics < most / 2)
    modes = continue_modes(equations_, shapes_, mean, std::max({1, least, mean.harmonics}), Copies::continued);
  if (modes) modes = converged(*std::move(modes), most);
  if (!modes) modes = motions_over_turn_from(mean, most);
  constexpr int few = 6;
  const int first = std::max(few, mean.harmonics);
  for (int h = first, before = 0; !modes && h > before; before = h, h = std::min(2 * h, most_searched)) {
    modes = find_modes_around(equations_, shapes_, mean, h);
    if (modes) modes = converged(*std::move(modes), most);
  }
  if (modes) {
    HarmonicModes more = *modes;
    if (add_resonant_motions(equations_, shapes_, more)) {
      modes = converged(more, most);
      if (!modes) modes = std::move(more);
    }
    complete(options, *modes);
    return *std::move(modes);
  }
  HarmonicModes in_place = mean_->find(options);
  in_place.unresolved = most;
  in_place.all = false;
  return in_place;
}

/// @param known  modes with few harmonics @returns the motions that the monodromy matrix shows, with their harmonics
std::optional<HarmonicModes> HarmonicSearch::motions_over_turn(const ModeOptions& options, HarmonicModes known) const {
  const auto moving = [](const HarmonicModes& modes) {
    return std::count_if(modes.modes.begin(), modes.modes.end(), std::not_fn(is_rigid));
  };
  const std::optional<PrincipalModes> shown = find_by_monodromy(equations_, shapes_, options);
  if (!shown) return std::nullopt;
  // Motions that vanish in a turn are among the known ones: these must be so many that all are there.
  constexpr int tries = 3;
  ModeOptions wider = options;
  for (int k = 0; k < tries; ++k) {
    std::optional<HarmonicModes> modes = slowest_modes(*shown, known, shapes_, equations_.rate(), options);
    if (modes) modes = continue_modes(equations_, shapes_, *modes, modes->harmonics, Copies::largest);
    if (!modes) return std::nullopt;
    modes->all = is_complete(*modes);
    if (options.below || moving(*modes) >= options.count || modes->all) {
      judge_modes(*modes, options);
      return modes;
    }
    wider.count *= 2;
    known = find_with(wider, known.harmonics);
  }
  return std::nullopt;
}

/// The search with a number of harmonics finds all copies, and misses motions with more harmonics: it serves rotors for
/// which one harmonic is exact, and those whose motions the monodromy matrix does not show.
HarmonicModes HarmonicSearch::find_freely(const ModeOptions& options, int least) const {
  constexpr int most = 64, most_searched = 16;
  const auto counts_shift_twice = [&](const HarmonicModes& modes) {
    return shapes_.any_shift() && std::count_if(modes.modes.begin(), modes.modes.end(), is_rigid) > 1;
  };
  constexpr int small = 1000;  // unknowns of the harmonics
  const bool at_once = (2 * least + 1) * equations_.first().unknowns() <= small;
  HarmonicModes modes = find_with(options, at_once ? std::max(1, least) : 1);
  modes.periodicity = Periodicity::multiblade;
  if (modes.harmonics == 1 && are_exact(equations_, modes, exact)) return modes;
  std::optional<HarmonicModes> over_turn = motions_over_turn(options, modes);
  bool continued = over_turn.has_value();
  if (over_turn) modes = *std::move(over_turn);
  while (true) {
    const int h = modes.harmonics, more = std::max(least, next_harmonics(h));
    modes.periodicity = Periodicity::periodic;
    std::optional<HarmonicModes> next = continue_modes(equations_, shapes_, modes, more, Copies::largest);
    if (next && next->change < exact) {
      // A rigid mode may be the shift in time, which it resembles with more harmonics only: rigid modes are not
      // continued.
      if (continued && h <= most_searched && counts_shift_twice(modes)) {
        modes = find_with(options, h);
        modes.periodicity = Periodicity::periodic;
      }
      modes.change = next->change;
      if (continued) judge_modes(modes, options);
      return modes;
    }
    if (next_harmonics(h) > (next ? most : most_searched)) throw_unresolved(h, next ? next->change : 0);
    continued = next.has_value();
    modes = next ? *std::move(next) : find_with(options, next_harmonics(h));
  }
}

HarmonicModes HarmonicSearch::find(const ModeOptions& options, int least) const {
  if (equations_.constant()) return find_with(options, 0);
  if (const std::optional<HarmonicModes> mean = modes_of_mean(options)) {
    HarmonicModes modes = find_from(*mean, options, least);
    // Two decays about the mean state may be one oscillation about the periodic motion.
    const auto decays = [](const HarmonicMode& each) { return each.mode.s.imag() == 0; };
    if (modes.unresolved == 0 || std::none_of(mean->modes.begin(), mean->modes.end(), decays)) return modes;
    try {
      return find_resonant(options, least);
    } catch (const ComputationError&) {
      return modes;  // those about the mean state, which the summary says
    }
  }
  return find_resonant(options, least);
}

HarmonicModes HarmonicSearch::find_resonant(const ModeOptions& options, int least) const {
  HarmonicModes modes = find_freely(options, least);
  if (!options.near && add_resonant_motions(equations_, shapes_, modes)) complete(options, modes);
  sort_by_rate(modes.modes);  // further harmonics change the order
  return modes;
}

}  // namespace bielle::mechanism

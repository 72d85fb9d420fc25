#include "mechanism/solvers/linearised/speed_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bielle::mechanism {
namespace {

constexpr double certain = 0.9;  // correlation of neighbouring shapes that requires no further value
constexpr double lost_below = 0.5;
constexpr int deepest = 6;  // largest number of halvings of a distance between values

double rate_of(const TrackedMode& track) { return std::abs(track.s.imag()); }

bool kept(const TrackedMode& track) { return track.found && track.correlation >= lost_below; }

/// Returns the difference between the rate of a mode and a multiple of the speed, or zero if they are equal up to
/// rounding: a rigid motion in rotating axes has the speed as its frequency.
double excess_of(const SweepPoint& point, std::size_t mode, double order) {
  constexpr double rounding = 1e-12;
  const TrackedMode& track = point.tracks[mode];
  const double excess = rate_of(track) - order * std::abs(point.speed);
  return std::abs(excess) <= track.uncertainty + rounding * rate_of(track) ? 0 : excess;
}

/// Tells whether the frequencies are equal up to rounding.
bool together(double a, double b) {
  constexpr double same = 1e-6;
  return std::abs(a - b) <= same * std::max(std::abs(a), std::abs(b));
}

/// Tells whether two modes change their order between two points.
bool order_changed(const SweepPoint& a, const SweepPoint& b, std::size_t i, std::size_t j) {
  if (!kept(b.tracks[i]) || !kept(b.tracks[j])) return false;
  const double ai = rate_of(a.tracks[i]), aj = rate_of(a.tracks[j]), bi = rate_of(b.tracks[i]),
               bj = rate_of(b.tracks[j]);
  return !together(ai, aj) && !together(bi, bj) && (ai > aj) != (bi > bj);
}

bool order_changed(const SweepPoint& a, const SweepPoint& b) {
  for (std::size_t i = 0; i < a.tracks.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (order_changed(a, b, i, j)) return true;
  return false;
}

/// Tells whether modes that do not mix among themselves change their order. @param a  at rest @param b  in motion, or
/// reversed
bool order_changed_beyond_mixing(const SweepPoint& a, const SweepPoint& b, const LinearisedEquations::Sparse& M) {
  constexpr double related = 0.05;  // correlation above which one of two shapes has a part of the other
  for (std::size_t i = 0; i < a.tracks.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (order_changed(a, b, i, j) && shape_correlation(M, a.tracks[i].u, b.tracks[j].u) < related &&
          shape_correlation(M, a.tracks[j].u, b.tracks[i].u) < related)
        return true;
  return false;
}

/// Modes that were already lost are not considered.
bool all_certain(const SweepPoint& from, const SweepPoint& to) {
  for (std::size_t i = 0; i < to.tracks.size(); ++i)
    if (from.tracks[i].found && !(to.tracks[i].found && to.tracks[i].correlation >= certain)) return false;
  return true;
}

bool any_lost(const SweepPoint& from, const SweepPoint& to) {
  for (std::size_t i = 0; i < to.tracks.size(); ++i)
    if (from.tracks[i].found && !kept(to.tracks[i])) return true;
  return false;
}

/// Tells whether one of two states is at rest and the other one is not.
bool begins_or_ends_at_rest(const SweepPoint& from, const SweepPoint& to) {
  constexpr double rounding = 1e-12;
  const double slow = std::min(std::abs(from.speed), std::abs(to.speed)),
               fast = std::max(std::abs(from.speed), std::abs(to.speed));
  return fast > 0 && slow <= rounding * fast;
}

/// Tells whether a mode that was lost may be faster than all modes of the sample. Otherwise it has changed its shape.
bool may_be_faster(const SweepPoint& from, const SweepPoint& to, const ModeSample& sample) {
  constexpr double most_change = 2;  // further values between find a frequency that changes by a larger factor
  double fastest = 0;
  for (const Mode& mode : sample.modes) fastest = std::max(fastest, std::abs(mode.s));
  for (std::size_t i = 0; i < to.tracks.size(); ++i)
    if (from.tracks[i].found && !kept(to.tracks[i]) && most_change * std::abs(from.tracks[i].s) > fastest) return true;
  return false;
}

}  // namespace

SweepSample SpeedSweep::sample_at(double value) {
  ++result_.solved;
  SweepSample sample = solve_(value, count_);
  M_ = sample.modes.M;
  return sample;
}

SweepPoint SpeedSweep::begin() {
  count_ = modes_ + beyond;
  SweepSample sample = sample_at(values_.front());
  const auto exhausted = [&] { return sample.modes.all || count_ > 2 * M_.rows(); };
  while (!exhausted() && static_cast<int>(sample.modes.modes.size()) < modes_ + 2) {
    count_ *= 2;
    sample = sample_at(values_.front());
  }
  return {values_.front(), sample.speed, true, begin_tracks(sample.modes, modes_)};
}

SweepPoint SpeedSweep::followed(const SweepPoint& from, double value) {
  constexpr int most_doublings = 3;
  const int before = count_;
  SweepPoint point;
  for (int k = 0;; ++k) {
    const SweepSample sample = sample_at(value);
    point = {value, sample.speed, true, follow_tracks(from.tracks, sample.modes)};
    if (k == most_doublings || sample.modes.all || !may_be_faster(from, point, sample.modes)) break;
    count_ *= 2;
  }
  if (any_lost(from, point)) count_ = before;
  return point;
}

/// Follows tracks from rest, or to it, by sets of modes that mix.
SweepPoint SpeedSweep::followed_from_rest(const SweepPoint& from, const SweepPoint& to) {
  const SweepSample before = sample_at(from.value), after = sample_at(to.value);
  SweepPoint point = to;
  point.tracks = follow_mixed_tracks(from.tracks, before.modes, after.modes);
  return point;
}

/// Follows tracks from rest, or to it. Shapes change abruptly there, however near the other value is; values between
/// would show nothing else. @returns whether all modes were followed
bool SpeedSweep::follow_at_once(const SweepPoint& from, const SweepPoint& to) {
  if (!begins_or_ends_at_rest(from, to)) return false;
  SweepPoint point = followed_from_rest(from, to);
  if (!all_certain(from, point) || order_changed_beyond_mixing(from, point, M_)) return false;
  accept(from, std::move(point));
  return true;
}

void SpeedSweep::advance(const SweepPoint& from, SweepPoint to, int depth) {
  const bool certain_to = all_certain(from, to);
  if (depth < deepest && !certain_to && follow_at_once(from, to)) return;
  if (depth >= deepest || (certain_to && !order_changed(from, to))) {
    accept(from, !certain_to && begins_or_ends_at_rest(from, to) ? followed_from_rest(from, to) : std::move(to));
    return;
  }
  const double middle = 0.5 * (from.value + to.value);
  SweepPoint between = followed(from, middle);
  between.given = false;
  advance(from, std::move(between), depth + 1);
  const SweepPoint reached = result_.points.back();
  const bool given = to.given;
  SweepPoint end = followed(reached, to.value);
  end.given = given;
  advance(reached, std::move(end), depth + 1);
}

void SpeedSweep::accept(const SweepPoint& from, SweepPoint to) {
  for (std::size_t i = 0; i < to.tracks.size(); ++i) {
    const TrackedMode& track = to.tracks[i];
    if (track.correlation < certain && from.tracks[i].found)
      result_.uncertain.push_back({static_cast<int>(i), !kept(track), from.value, to.value, track.correlation});
  }
  for (TrackedMode& track : to.tracks)
    if (!kept(track)) track.found = false;
  find_critical(from, to);
  result_.points.push_back(std::move(to));
}

void SpeedSweep::find_critical(const SweepPoint& a, const SweepPoint& b) {
  for (std::size_t i = 0; i < b.tracks.size(); ++i) {
    if (!a.tracks[i].found || !b.tracks[i].found) continue;
    for (const double order : orders_) {
      const double at_a = excess_of(a, i, order), at_b = excess_of(b, i, order);
      if ((at_a > 0) != (at_b > 0)) locate(a, b, i, order);
    }
  }
}

namespace {

/// Returns the point at which a quantity that has these values at two points is zero, if it and the mode change
/// linearly between them.
SweepPoint between(const SweepPoint& a, double at_a, const SweepPoint& b, double at_b, std::size_t mode) {
  const double share = at_a / (at_a - at_b);
  SweepPoint found = share < 0.5 ? a : b;
  found.value = a.value + share * (b.value - a.value);
  found.speed = a.speed + share * (b.speed - a.speed);
  found.tracks[mode].s = a.tracks[mode].s + share * (b.tracks[mode].s - a.tracks[mode].s);
  return found;
}

}  // namespace

/// Locates the critical speed by false position, with a halved weight for a retained end (Illinois). At a critical
/// speed itself the shape of a mode may not be unique (a mode of a rotor on supports that differ coincides there with
/// the copy of its conjugate): if the mode cannot be followed to a value, the interval shrinks around it.
void SpeedSweep::locate(SweepPoint a, SweepPoint b, std::size_t mode, double order) {
  const auto excess = [&](const SweepPoint& point) {
    return rate_of(point.tracks[mode]) - order * std::abs(point.speed);
  };
  double at_a = excess(a), at_b = excess(b);
  SweepPoint found = std::abs(at_a) < std::abs(at_b) ? a : b;
  int side = 0;
  constexpr int most = 40;
  constexpr double exact = 1e-10;
  for (int k = 0; k < most && std::abs(excess(found)) > exact * rate_of(found.tracks[mode]); ++k) {
    const double value = (a.value * at_b - b.value * at_a) / (at_b - at_a);
    if (!(value > a.value && value < b.value)) break;
    const bool nearer_a = value - a.value < b.value - value;
    SweepPoint next = followed(nearer_a ? a : b, value);
    if (!kept(next.tracks[mode])) {
      constexpr double shrunk = 1.0 / 16, narrow = 1e-6;
      if (b.value - a.value < narrow * std::abs(value)) break;
      SweepPoint before = followed(a, value - shrunk * (value - a.value));
      SweepPoint behind = followed(b, value + shrunk * (b.value - value));
      if (!kept(before.tracks[mode]) || !kept(behind.tracks[mode]) || (excess(before) > 0) == (excess(behind) > 0))
        break;
      a = std::move(before);
      b = std::move(behind);
      at_a = excess(a);
      at_b = excess(b);
      side = 0;
      found = between(a, at_a, b, at_b, mode);
      continue;
    }
    const double at_next = excess(next);
    found = next;
    if ((at_next > 0) == (at_a > 0)) {
      a = std::move(next);
      at_a = at_next;
      if (side == 1) at_b /= 2;
      side = 1;
    } else {
      b = std::move(next);
      at_b = at_next;
      if (side == 2) at_a /= 2;
      side = 2;
    }
  }
  if (std::abs(excess(found)) > exact * rate_of(found.tracks[mode])) found = between(a, excess(a), b, excess(b), mode);
  const TrackedMode& track = found.tracks[mode];
  const double size = std::abs(track.s);
  result_.critical.push_back({static_cast<int>(mode), order, found.value, found.speed,
                              rate_of(track) / (2 * std::numbers::pi), size > 0 ? -track.s.real() / size : 0,
                              track.whirl});
}

void SpeedSweep::find_crossings(std::size_t i, std::size_t j) {
  const SweepPoint *last = nullptr, *coinciding = nullptr;
  for (const SweepPoint& point : result_.points) {
    if (!point.tracks[i].found || !point.tracks[j].found) {
      last = coinciding = nullptr;
      continue;
    }
    const double ri = rate_of(point.tracks[i]), rj = rate_of(point.tracks[j]);
    if (together(ri, rj)) {
      coinciding = &point;
      continue;
    }
    const double before = last ? rate_of(last->tracks[i]) - rate_of(last->tracks[j]) : 0, now = ri - rj;
    if (last && (before > 0) != (now > 0)) {
      const double part = before / (before - now);
      const auto between = [&](double a, double b) { return a + part * (b - a); };
      ModeMeeting meeting{static_cast<int>(i),
                          static_cast<int>(j),
                          false,
                          between(last->value, point.value),
                          between(last->speed, point.speed),
                          between(rate_of(last->tracks[i]), ri),
                          0};
      if (coinciding) {
        meeting.value = coinciding->value;
        meeting.speed = coinciding->speed;
        meeting.frequency = rate_of(coinciding->tracks[i]);
      }
      meeting.frequency /= 2 * std::numbers::pi;
      result_.meetings.push_back(meeting);
    }
    last = &point;
    coinciding = nullptr;
  }
}

/// Finds minima of the distance between two frequencies. The distance must triple on both sides, and the shapes must be
/// exchanged between these sides.
void SpeedSweep::find_veerings(std::size_t i, std::size_t j) {
  const std::vector<SweepPoint>& points = result_.points;
  const auto gap = [&](std::size_t k) { return rate_of(points[k].tracks[i]) - rate_of(points[k].tracks[j]); };
  const auto there = [&](std::size_t k) { return points[k].tracks[i].found && points[k].tracks[j].found; };
  constexpr double apart = 3;
  for (std::size_t k = 1; k + 1 < points.size(); ++k) {
    if (!there(k - 1) || !there(k) || !there(k + 1)) continue;
    const double least = std::abs(gap(k));
    if (together(rate_of(points[k].tracks[i]), rate_of(points[k].tracks[j])) || std::abs(gap(k - 1)) <= least ||
        std::abs(gap(k + 1)) < least)
      continue;
    const auto same_side = [&](std::size_t at) { return there(at) && (gap(at) > 0) == (gap(k) > 0); };
    std::size_t a = k, b = k;
    while (a > 0 && same_side(a - 1) && std::abs(gap(a)) < apart * least) --a;
    while (b + 1 < points.size() && same_side(b + 1) && std::abs(gap(b)) < apart * least) ++b;
    constexpr double turned_away = 1.5;  // least factor, for a minimum near an end of the sweep
    if (std::abs(gap(a)) < turned_away * least || std::abs(gap(b)) < turned_away * least) continue;
    const auto correlation = [&](std::size_t from, std::size_t to) {
      return shape_correlation(M_, points[a].tracks[from].u, points[b].tracks[to].u);
    };
    if (correlation(i, j) < correlation(i, i) || correlation(j, i) < correlation(j, j)) continue;
    // The square of the gap is a parabola near the minimum.
    const double x0 = points[k - 1].value - points[k].value, x1 = points[k + 1].value - points[k].value;
    const double y0 = std::pow(gap(k - 1), 2) - least * least, y1 = std::pow(gap(k + 1), 2) - least * least;
    const double curvature = (y0 / x0 - y1 / x1) / (x0 - x1), slope = y0 / x0 - curvature * x0;
    const double shift = curvature > 0 ? std::clamp(-slope / (2 * curvature), x0, x1) : 0;
    const double square = least * least + slope * shift + curvature * shift * shift;
    const double speed = shift < 0 ? points[k].speed + shift / x0 * (points[k - 1].speed - points[k].speed)
                                   : points[k].speed + shift / x1 * (points[k + 1].speed - points[k].speed);
    const double mean = 0.5 * (rate_of(points[k].tracks[i]) + rate_of(points[k].tracks[j]));
    result_.meetings.push_back({static_cast<int>(i), static_cast<int>(j), true, points[k].value + shift, speed,
                                mean / (2 * std::numbers::pi),
                                std::sqrt(std::max(square, 0.0)) / (2 * std::numbers::pi)});
  }
}

void SpeedSweep::find_meetings() {
  const std::size_t count = result_.points.front().tracks.size();
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j) {
      find_crossings(i, j);
      find_veerings(i, j);
    }
  std::stable_sort(result_.meetings.begin(), result_.meetings.end(),
                   [](const ModeMeeting& a, const ModeMeeting& b) { return a.value < b.value; });
}

/// Follows the modes to another value. If the speed changes its sign, a point at rest is added: the absolute value of
/// the speed has a kink there, and lines may meet on both sides.
void SpeedSweep::go_to(double value) {
  const SweepPoint from = result_.points.back();
  SweepPoint to = followed(from, value);
  if (from.speed * to.speed < 0) {
    const double still = from.value - from.speed * (to.value - from.value) / (to.speed - from.speed);
    SweepPoint rest = followed(from, still);
    rest.given = false;
    advance(from, std::move(rest), 0);
    to = followed(result_.points.back(), value);
  }
  const SweepPoint last = result_.points.back();
  advance(last, std::move(to), 0);
}

SweptModes SpeedSweep::run(const std::function<bool()>& stops) {
  result_ = {};
  try {
    result_.points.push_back(begin());
    for (std::size_t k = 1; k < values_.size() && !(stops && stops()); ++k) go_to(values_[k]);
  } catch (const SweepEnded&) {
    if (result_.points.empty()) return std::move(result_);
  }
  find_meetings();
  std::stable_sort(result_.critical.begin(), result_.critical.end(),
                   [](const CriticalSpeed& a, const CriticalSpeed& b) { return a.value < b.value; });
  return std::move(result_);
}

}  // namespace bielle::mechanism

#include "mechanism/joints/cables/rope_course.hpp"

#include <algorithm>
#include <cmath>

#include "mechanism/measures/turns.hpp"

namespace bielle::mechanism {
namespace {

/// Returns the angle of the straight rope between two pulleys, about the third axis of `axes`.
double direction_of_span(const Matrix3& axes, const Frame& from, double from_radius, const Frame& to,
                         double to_radius) {
  const Vector3 d = axes.transpose() * (to.x - from.x);
  const double difference = from_radius - to_radius;
  return std::atan2(d.y(), d.x()) + std::atan2(difference, std::sqrt(d.squaredNorm() - difference * difference));
}

}  // namespace

double RopeCourses::radius(std::span<const RopePlace> places, int place) const {
  const auto k = static_cast<std::size_t>(place);
  return may_leave(place) ? places[k].sense * std::abs(pulleys_[k].radius) : pulleys_[k].radius;
}

int RopeCourses::neighbour(std::span<const RopePlace> places, int place, int step) const {
  int k = place + step;
  while (may_leave(k) && !touches(places[static_cast<std::size_t>(k)])) k += step;
  return k;
}

void RopeCourses::get_course(std::span<const RopePlace> places, RopeCourse& course) const {
  course.places.clear();
  course.pulleys.clear();
  for (int k = 0; k <= last(); ++k) {
    if (may_leave(k) && !touches(places[static_cast<std::size_t>(k)])) continue;
    course.places.push_back(k);
    course.pulleys.push_back(pulleys_[static_cast<std::size_t>(k)]);
    course.pulleys.back().radius = radius(places, k);
  }
}

double RopeCourses::wrap(std::span<const Frame> at, std::span<const RopePlace> places, int place,
                         double expected) const {
  const int p = neighbour(places, place, -1), q = neighbour(places, place, 1);
  const Frame &here = at[static_cast<std::size_t>(place)], &from = at[static_cast<std::size_t>(p)],
              &to = at[static_cast<std::size_t>(q)];
  const double r = radius(places, place);
  const double turn = direction_of_span(here.R, here, r, to, radius(places, q)) -
                      direction_of_span(here.R, from, radius(places, p), here, r);
  return unwrap_angle(r > 0 ? turn : -turn, expected);
}

bool RopeCourses::overlap(std::span<const Frame> at, std::span<const RopePlace> places, int place, double sense,
                          int other) const {
  const auto k = static_cast<std::size_t>(place);
  const double difference = sense * std::abs(pulleys_[k].radius) - radius(places, other);
  return (at[k].x - at[static_cast<std::size_t>(other)].x).squaredNorm() <= difference * difference;
}

RopeCourses::Offset RopeCourses::offset(std::span<const Frame> at, std::span<const RopePlace> places, int place) const {
  const int p = neighbour(places, place, -1), q = neighbour(places, place, 1);
  const Frame& first = at[static_cast<std::size_t>(p)];
  const auto seen = [&](int k) -> Eigen::Vector2d {
    return (first.R.transpose() * (at[static_cast<std::size_t>(k)].x - first.x)).head<2>();
  };
  const Eigen::Vector2d d = seen(q), c = seen(place);
  const double r = radius(places, p), difference = r - radius(places, q);
  Offset offset;
  const double squared = d.squaredNorm() - difference * difference;
  if (!(squared > 0)) return offset;
  offset.exists = true;
  offset.length = std::sqrt(squared);
  const double angle = std::atan2(d.y(), d.x()) + std::atan2(difference, offset.length);
  const Eigen::Vector2d u(std::cos(angle), std::sin(angle)), n(u.y(), -u.x());
  offset.s = r - n.dot(c);
  offset.along = u.dot(c);
  offset.to_end = std::min((c - r * n).norm(), (c - r * n - offset.length * u).norm());
  return offset;
}

double RopeCourses::clearance(std::span<const Frame> at, std::span<const RopePlace> places, int place) const {
  const auto k = static_cast<std::size_t>(place);
  const double rho = std::abs(pulleys_[k].radius), sense = places[k].wrap, least = 1e-3 * rho;
  const Offset found = offset(at, places, place);
  if (!found.exists) return rho;
  if (!found.within()) return std::max(found.to_end - rho, least);
  const double clear = sense * found.s - rho;
  // A pulley that overlaps an end of the rope counts as not touched.
  const bool turns = !overlap(at, places, place, sense, neighbour(places, place, -1)) &&
                     !overlap(at, places, place, sense, neighbour(places, place, 1));
  return turns ? clear : std::max(clear, least);
}

double RopeCourses::side(std::span<const Frame> at, std::span<const RopePlace> places, int place) const {
  const Offset found = offset(at, places, place);
  if (!found.exists || found.within()) return places[static_cast<std::size_t>(place)].wrap;
  return found.s < 0 ? -1 : 1;
}

void RopeCourses::settle(std::span<const Frame> at, std::span<RopePlace> places) const {
  const int most = 4 * last() + 4;  // each place leaves and returns at most once; further changes are rounding
  for (int k = 0; k < most; ++k) {
    int changed = -1;
    double worst = -just_touching;
    for (int i = 1; i < last(); ++i) {
      RopePlace& place = places[static_cast<std::size_t>(i)];
      if (!may_leave(i) || !touches(place)) continue;
      place.wrap = wrap(at, places, i, place.wrap);
      if (place.wrap >= worst) continue;
      worst = place.wrap;
      changed = i;
    }
    if (changed >= 0) {
      RopePlace& place = places[static_cast<std::size_t>(changed)];
      place = {0, place.sense};
      continue;
    }
    for (int i = 1; i < last(); ++i) {
      if (!may_leave(i) || touches(places[static_cast<std::size_t>(i)])) continue;
      const double clear = clearance(at, places, i) / std::abs(pulleys_[static_cast<std::size_t>(i)].radius);
      if (clear >= worst) continue;
      worst = clear;
      changed = i;
    }
    if (changed < 0) return;
    RopePlace& place = places[static_cast<std::size_t>(changed)];
    place = {place.wrap, 0};
  }
}

std::vector<RopePlace> RopeCourses::as_drawn(std::span<const Frame> at, const std::vector<int>& turns) const {
  std::vector<RopePlace> places(pulleys_.size());
  for (std::size_t k = 0; k < places.size(); ++k) places[k].sense = pulleys_[k].radius < 0 ? -1 : 1;
  for (int left = last(); left > 0; --left) {
    int clear = -1;
    double largest = M_PI;
    for (int k = 1; k < last(); ++k) {
      RopePlace& place = places[static_cast<std::size_t>(k)];
      if (!may_leave(k) || !touches(place)) continue;
      place.wrap = wrap(at, places, k, M_PI);                     // this wrap is less than a turn
      if (place.wrap > 2 * M_PI - just_touching) place.wrap = 0;  // the rope just touches
      if (place.wrap <= largest) continue;
      const RopePlace touched = place;
      place = {0, touched.sense};
      const bool passes = offset(at, places, k).within() && clearance(at, places, k) > 0;
      place = touched;
      if (!passes) continue;
      largest = place.wrap;
      clear = k;
    }
    if (clear < 0) break;
    RopePlace& place = places[static_cast<std::size_t>(clear)];
    place = {0, place.sense};
  }
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (turns[k] == 0) continue;
    RopePlace& place = places[k];
    if (!touches(place)) {
      place = {place.wrap, 0};
      place.wrap = wrap(at, places, static_cast<int>(k), 0);  // the wrap at the present clearance
    }
    place.wrap += 2 * M_PI * turns[k];
  }
  settle(at, places);
  return places;
}

}  // namespace bielle::mechanism

#include "mechanism/hydraulics/actuators/stroke_watch.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace bielle::mechanism {

void StrokeWatch::add(const LocalState& state) {
  const double l = cylinder_.length(state).value;
  const Cylinder::Geometry& stroke = cylinder_.geometry();
  const double way = std::max(l - stroke.longest, stroke.shortest - l);
  if (way > most_.way) most_ = {way, l, state.time()};
}

void StrokeWatch::exchange(Archive& archive) {
  for (double* number : {&most_.way, &most_.length, &most_.time}) archive(*number);
}

std::string StrokeWatch::summary() {
  constexpr double rounding = 1e-6;  // relative to the stroke
  const Cylinder::Geometry& stroke = cylinder_.geometry();
  if (most_.way <= rounding * (stroke.longest - stroke.shortest)) return {};
  return fmt::format(
      "hydraulic_actuator '{}' left its stroke of {:.6g} to {:.6g} m: it was {:.6g} m long at t = {:.6g} s. Nothing "
      "stops it there: give it `end_stops`\n",
      cylinder_.name(), stroke.shortest, stroke.longest, most_.length, most_.time);
}

std::string StrokeWatch::what() const { return fmt::format("stroke of '{}'", cylinder_.name()); }

}  // namespace bielle::mechanism

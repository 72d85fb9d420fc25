#include "mechanism/laws/stop_law.hpp"

#include <algorithm>
#include <cmath>

namespace bielle::mechanism {

StopLaw::Contact StopLaw::contact(double side, double q, double v) const {
  Contact contact;
  contact.side = side;
  if (side == 0) return contact;
  contact.penetration = side > 0 ? q - upper : lower - q;
  const double push = stiffness * contact.penetration + damping * side * v;
  contact.pushes = push > 0;
  contact.N = side * std::max(0.0, push);
  return contact;
}

double StopLaw::side_after(double q, double v) const {
  // After an event the coordinate is slightly beyond the stop, or before it. Exactly at the stop its rate decides; a
  // part at rest there is in contact, and leaves the branch if it is not pressed against the stop.
  const auto beyond = [](double p, double rate) { return p > 0 || (p == 0 && rate >= 0); };
  return beyond(q - upper, v) ? 1 : beyond(lower - q, -v) ? -1 : 0;
}

void StopLaw::add_energy(const Contact& contact, double v, Energy& energy) const {
  if (contact.side == 0) return;
  // The damper dissipates the energy of a spring that it prevents from pushing.
  energy.elastic += 0.5 * stiffness * contact.penetration * contact.penetration;
  energy.dissipation += (contact.N - contact.side * stiffness * contact.penetration) * v;
}

void StopLaw::declare_events(const std::string& upper_name, const std::string& lower_name,
                             Declaration& declaration) const {
  if (std::isfinite(upper)) declaration.event_functions.push_back({upper_name});
  if (std::isfinite(lower)) declaration.event_functions.push_back({lower_name});
}

void StopLaw::calc_event_functions(double q, Eigen::Ref<VectorX> values) const {
  Eigen::Index k = 0;
  if (std::isfinite(upper)) values[k++] = q - upper;
  if (std::isfinite(lower)) values[k] = lower - q;
}

}  // namespace bielle::mechanism

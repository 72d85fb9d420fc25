#include "mechanism/solvers/start/start_conditions.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mechanism/model/carried_start.hpp"
#include "mechanism/model/measure.hpp"
#include "mechanism/model/start_coordinates.hpp"
#include "mechanism/system/node_relation.hpp"

namespace bielle::mechanism {
namespace {

/// Transforms a gradient over a local layout to the dofs. @param first  local row at which the layout begins
void add_dof_entries(const System& system, const State& state, const Slots& slots,
                     const Eigen::Ref<const VectorX>& gradient, int first, CoordinateRow::Entries& entries) {
  const NodeKinematics& kinematics = system.kinematics();
  for (std::size_t k = 0; k < slots.nodes.size(); ++k) {
    const int node = slots.nodes[k];
    const Carry* carry = kinematics.carry(node);
    const NodeFreedom& freedom = kinematics.freedom(carry ? carry->carrier : node);
    if (freedom.count == 0) continue;
    const NodeRelation relation = relate(kinematics, node, state, nullptr);
    const Vector6 own = gradient.segment<6>(first + 6 * static_cast<Eigen::Index>(k));
    for (int c = 0; c < freedom.count; ++c)
      entries.emplace_back(freedom.begin + c, relation.displacement.col(c).dot(own));
  }
  const auto first_amplitude = system.dofs() - static_cast<int>(state.amplitude.size());
  for (int k = 0; k < slots.amplitudes; ++k)
    entries.emplace_back(first_amplitude + slots.amplitude_begin + k, gradient[first + slots.amplitude_row() + k]);
  for (std::size_t k = 0; k < slots.references.size(); ++k)
    add_dof_entries(system, state, *slots.references[k], gradient, first + slots.reference_rows[k], entries);
}

}  // namespace

StartConditions conditions_of_file(const System& system) {
  StartConditions conditions;
  for (const StartCondition& each : system.model().start_conditions())
    conditions.coordinates.push_back(
        {system.member_of(*each.component), each.coordinate, each.value, each.rate, false});
  for (const Member& member : system.model().members())
    if (const auto* carried = dynamic_cast<const CarriedStart*>(member.component.get()))
      conditions.carrying.push_back(system.member_of(carried->joint()));
  return conditions;
}

void keep_coordinate(const System& system, const Environment& environment, const State& state,
                     const Component& component, std::size_t coordinate, StartConditions& conditions) {
  const std::size_t member = system.member_of(component);
  const double value = coordinate_row(system, environment, state, member, coordinate).value;
  for (CoordinateCondition& each : conditions.coordinates)
    if (each.member == member && each.coordinate == coordinate) {
      if (each.value) return;
      each.value = value;
      each.kept = true;
      return;
    }
  conditions.coordinates.push_back({member, coordinate, value, {}, true});
}

CoordinateRow coordinate_row(const System& system, const Environment& environment, const State& state,
                             std::size_t member, std::size_t coordinate) {
  const Slots& slots = system.slots()[member];
  thread_local MeasureGradient gradient;
  const auto& coordinates = dynamic_cast<const StartCoordinates&>(*system.model().members()[member].component);
  const StartCoordinateValue at =
      coordinates.calc_start_coordinate(coordinate, LocalState(state, slots, environment), gradient);
  CoordinateRow row{at.value, at.rate, {}, {}};
  add_dof_entries(system, state, slots, gradient.position(), 0, row.by_position);
  add_dof_entries(system, state, slots, gradient.rate(), 0, row.by_rate);
  return row;
}

double coordinate_distance(const StartCoordinate& coordinate, double value, double from) {
  return coordinate.turns ? std::remainder(value - std::remainder(from, 2 * M_PI), 2 * M_PI) : value - from;
}

StartCoordinate start_coordinate(const System& system, const CoordinateCondition& condition) {
  return start_coordinates_of(*system.model().members()[condition.member].component)[condition.coordinate];
}

std::string coordinate_name(const System& system, std::size_t member, const StartCoordinate& coordinate) {
  return fmt::format("{} of {}", coordinate.name, describe(system.model().members()[member]));
}

}  // namespace bielle::mechanism

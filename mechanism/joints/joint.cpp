#include "mechanism/joints/joint.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "mechanism/drawing/drawing.hpp"
#include "mechanism/measures/pair_rotation.hpp"
#include "mechanism/measures/turns.hpp"
#include "mechanism/model/description.hpp"

namespace bielle::mechanism {

Joint::Joint(std::string type, std::string name, JointFrames frames, std::vector<JointCoordinate> coordinates,
             const Model& model)
    : Component(std::move(type), std::move(name)),
      frames_(std::move(frames)),
      coordinates_(std::move(coordinates)),
      start_(coordinates_.size()),
      uses_(coordinates_.size()),
      first_name_(model.node(frames_.first).name),
      second_name_(model.node(frames_.second).name) {}

std::size_t Joint::coordinate_index(const std::string& name) const {
  std::size_t index = 0;
  while (coordinates_.at(index).name != name) ++index;
  return index;
}

CoordinateRate Joint::principal_coordinate(std::size_t index, const LocalState& state) const {
  const NodeState &first = state.node(0), &second = state.node(1);
  const Frame &A = frames_.on_first, &B = frames_.on_second;
  const JointCoordinate& coordinate = coordinates_[index];
  if (is_rotation(index)) {
    const PairRotation rotation(first, second, A.R, B.R);
    return {rotation.psi()[coordinate.axis], rotation.omega(first, second)[coordinate.axis]};
  }
  if (coordinate.axis == JointCoordinate::by_type) {
    const PairSlope m = calc_own_slope(index, state);
    return {m.value, m.rate(pair_rate(first, second))};
  }
  const auto [value, rate] = coordinate.kind == JointCoordinate::Kind::displacement
                                 ? measure_position_rate(first, second, A.R.col(coordinate.axis), A.x, B.x)
                                 : measure_angle_rate(first, second, A.R, B.R);
  return {value, rate};
}

bool Joint::is_rotation(std::size_t index) const {
  const JointCoordinate& coordinate = coordinates_[index];
  return coordinate.kind == JointCoordinate::Kind::rotation && coordinate.axis != JointCoordinate::by_type;
}

PairMeasure Joint::calc_own_coordinate(std::size_t index, const LocalState& /*state*/) const {
  throw std::logic_error(fmt::format("a {} does not define its coordinate '{}'", type(), coordinates_[index].name));
}

PairSlope Joint::calc_own_slope(std::size_t index, const LocalState& state) const {
  const PairMeasure m = calc_own_coordinate(index, state);
  return {m.value, m.gradient};
}

double Joint::counted(std::size_t index, const LocalState& state, const CoordinateRate& principal) const {
  if (coordinates_[index].kind != JointCoordinate::Kind::angle) return principal.value;
  const auto memory = state.memory();
  const auto at = 2 * static_cast<Eigen::Index>(index);
  const double time_before = memory[memory.size() - 1];
  // A start value that is not due to a motion holds for any fraction of the motions in statics.
  if (std::isnan(time_before) && !start_[index].by_motion) return unwrap_angle(principal.value, memory[at]);
  return counted_angle(principal, {memory[at], memory[at + 1]}, time_before, state);
}

CoordinateRate Joint::coordinate(std::size_t index, const LocalState& state) const {
  const CoordinateRate principal = principal_coordinate(index, state);
  return {counted(index, state, principal), principal.rate};
}

template <int order>
PairMeasureOf<order> Joint::measure(std::size_t index, const LocalState& state) const {
  const JointCoordinate& coordinate = coordinates_[index];
  if (coordinate.axis != JointCoordinate::by_type) {
    if (coordinate.kind != JointCoordinate::Kind::angle) return position<order>(coordinate.axis, state);
    return measure_angle<order>(state.node(0), state.node(1), frames_.on_first.R, frames_.on_second.R);
  }
  if constexpr (order == 1)
    return calc_own_slope(index, state);
  else
    return calc_own_coordinate(index, state);
}

template <class Measure>
void Joint::set_slopes(std::size_t index, const LocalState& state, const Measure& m, CoordinateSlopes& slopes) const {
  slopes.g().head<12>() = slopes.w().head<12>() = m.gradient;
  slopes.principal = m.value;
  slopes.rate = m.rate(pair_rate(state.node(0), state.node(1)));
  slopes.value = counted(index, state, {slopes.principal, slopes.rate});
}

void Joint::calc_slopes(std::size_t index, const LocalState& state, CoordinateSlopes& slopes) const {
  const NodeState &first = state.node(0), &second = state.node(1);
  slopes.prepare(state.slots().size());
  if (!is_rotation(index)) return set_slopes(index, state, measure<1>(index, state), slopes);
  PairRotation(first, second, frames_.on_first.R, frames_.on_second.R)
      .calc_slopes(coordinates_[index].axis, first, second, slopes);
}

void Joint::calc_coordinate(std::size_t index, const LocalState& state, CoordinateDerivatives& jet) const {
  const NodeState &first = state.node(0), &second = state.node(1);
  jet.prepare(state.slots().size());
  if (is_rotation(index)) {
    PairRotation(first, second, frames_.on_first.R, frames_.on_second.R)
        .calc(coordinates_[index].axis, first, second, jet);
    return;
  }
  const PairMeasure m = measure<2>(index, state);
  set_slopes(index, state, m, jet);
  jet.S().topLeftCorner<12, 12>() = jet.W().topLeftCorner<12, 12>() = m.second;
}

std::pair<double, double> Joint::calc_coordinate_rates(const LocalState& state, CoordinateDerivatives& jet) {
  thread_local VectorX v, a;
  v.resize(jet.g().size());
  a.resize(jet.g().size());
  get_local_velocities(state, v);
  get_local_accelerations(state, a);
  return {jet.g().dot(v), jet.g().dot(a) + v.dot(jet.S() * v)};
}

void Joint::declare(Declaration& declaration) const {
  declaration.nodes = {frames_.first, frames_.second};
  for (const Start& start : start_) declaration.memory.insert(declaration.memory.end(), {start.value, 0.0});
  declaration.memory.push_back(std::numeric_limits<double>::quiet_NaN());  // no step has been accepted yet
}

void Joint::accept(const LocalState& state, Eigen::Ref<VectorX> memory) const {
  for (std::size_t k = 0; k < coordinates_.size(); ++k) {
    if (coordinates_[k].kind != JointCoordinate::Kind::angle) continue;  // only angles have turns
    const auto [value, rate] = coordinate(k, state);
    memory.segment<2>(2 * static_cast<Eigen::Index>(k)) << value, rate;
  }
  memory[memory.size() - 1] = state.time();
}

std::vector<OutputField> Joint::output_fields() const {
  std::vector<OutputField> fields;
  if (!coordinates_.empty()) {
    std::string names, units, rate_units;
    for (const JointCoordinate& each : coordinates_) {
      const std::string separator = names.empty() ? "" : ", ";
      names += separator + each.name;
      units += separator + each.units();
      rate_units += separator + each.rate_units();
    }
    fields.push_back({"coordinate", {coordinates_.size()}, units, names});
    fields.push_back({"rate", {coordinates_.size()}, rate_units, names});
  }
  fields.push_back(
      {"reaction",
       {6},
       "N, N m",
       "force and moment that the joint exerts on its second node, about the attachment point there, in the "
       "joint's frame (which rides on the first node)"});
  fields.push_back({"reaction_inertial", {6}, "N, N m", "the same in inertial components"});
  return fields;
}

void Joint::write_output(const LocalState& state, double* values) const {
  const std::size_t count = coordinates_.size();
  for (std::size_t k = 0; k < count; ++k) {
    const auto [value, rate] = coordinate(k, state);
    values[k] = value;
    values[count + k] = rate;
  }
  const Vector6 in_axes = calc_reaction(state);
  const Matrix3 axes = state.node(0).R * frames_.on_first.R;
  Eigen::Map<Eigen::Matrix<double, 12, 1>> reaction(values + 2 * count);
  reaction << in_axes, axes * in_axes.head<3>(), axes * in_axes.tail<3>();
}

std::vector<SlidingSurface> Joint::sliding_surfaces() const {
  // A joint that is elastic in all directions, or whose reaction depends on rates, has no sliding surfaces.
  if (coordinates_.empty() || coordinates_.size() > 3 || reaction_has_rates()) return {};
  SlidingSurface all;
  for (std::size_t k = 0; k < coordinates_.size(); ++k) all.coordinates.push_back(k);
  return {all};
}

OutputField Joint::force_field(const std::string& name, const std::string& description) const {
  std::string units;
  for (const JointCoordinate& each : coordinates_)
    units += (units.empty() ? "" : ", ") + std::string(each.force_units());
  return {name, {coordinates_.size()}, units, description, true};
}

std::vector<std::pair<std::string, std::string>> Joint::attributes() const {
  return {{"first_node", first_name_}, {"second_node", second_name_}};
}

void Joint::describe(const LocalState& state, Description& description) const {
  const NodeState& first = state.node(0);
  const Matrix3 axes = first.R * frames_.on_first.R;
  description.add(fmt::format("nodes '{}' and '{}'", first_name_, second_name_));
  description.add(fmt::format("at {} m", format_vector(first.x + first.R * frames_.on_first.x)));
  description.add(fmt::format("x {}, z {}", format_vector(axes.col(0)), format_vector(axes.col(2))));
}

void Joint::draw(Drawing& drawing) const {
  drawing.add({.shape = "joint", .places = {{frames_.first, frames_.on_first}, {frames_.second, frames_.on_second}}});
}

}  // namespace bielle::mechanism

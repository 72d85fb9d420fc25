#include "mechanism/joints/drive.hpp"

#include <cmath>

#include <fmt/format.h>

namespace bielle::mechanism {
// -- what all drives are

Drive::Drive(std::string name, const Joint& joint, std::size_t coordinate, Expression f)
    : Component("drive", std::move(name)), joint_(joint), coordinate_(coordinate), f_(std::move(f)) {}

PairMeasure Drive::measure(const LocalState& state) const {
  return joint_.calc_coordinate(coordinate_, state.node(0), state.node(1));
}

void Drive::declare_nodes(Declaration& declaration) const {
  declaration.nodes = {joint_.frames().first, joint_.frames().second};
  declaration.stiffness = true;
}

namespace {
std::string force_units_along(const JointCoordinate& coordinate) {
  return coordinate.kind == JointCoordinate::Kind::displacement ? "N" : "N m";
}
}  // namespace

std::string Drive::force_units() const { return force_units_along(coordinate()); }

std::vector<OutputField> Drive::output_fields() const {
  std::string units;
  for (const JointCoordinate& each : joint_.coordinates())
    units += (units.empty() ? "" : ", ") + force_units_along(each);
  return {{"drive_force",
           {joint_.coordinates().size()},
           units,
           "force or torque of the drives along the joint's coordinates; zero where none acts",
           true}};
}

void Drive::write_output(const LocalState& state, double* values) const {
  for (std::size_t k = 0; k < joint_.coordinates().size(); ++k) values[k] = k == coordinate_ ? force(state) : 0.0;
}

void Drive::add_break_points(std::vector<double>& times) const {
  const std::vector<double> points = f_.break_points();
  times.insert(times.end(), points.begin(), points.end());
}

// -- position

PairMeasure PositionDrive::distance(const LocalState& state) const {
  PairMeasure m = measure(state);
  const double target = state.motion_factor() * law()(state.time());
  // An angle is wanted modulo turns: the drive counts them by time, not by memory, so that steps of any size and
  // restarts find the same. Whole turns are taken off the target by itself: rounding of large angles would otherwise
  // keep Newton's method from its tolerance.
  if (coordinate().kind == JointCoordinate::Kind::angle)
    m.value = std::remainder(m.value - std::remainder(target, 2 * M_PI), 2 * M_PI);
  else
    m.value -= target;
  return m;
}

double PositionDrive::force(const LocalState& state) const { return -state.multiplier()[0]; }

void PositionDrive::declare(Declaration& declaration) const {
  declare_nodes(declaration);
  declaration.multipliers.push_back({coordinate().name, force_units()});
}

void PositionDrive::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  const PairMeasure m = distance(state);
  r.head<12>() += state.multiplier()[0] * m.gradient;
  r[12] += m.value;
}

void PositionDrive::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (!tangent.wants_K) return;
  const PairMeasure m = distance(state);
  tangent.K.topLeftCorner<12, 12>() += state.multiplier()[0] * m.second;
  tangent.K.block<12, 1>(0, 12) += m.gradient;
  tangent.K.block<1, 12>(12, 0) += m.gradient.transpose();
}

void PositionDrive::add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                                         Eigen::Ref<VectorX> acceleration) const {
  const PairMeasure m = measure(state);
  const Vector12 v = pair_rate(state.node(0), state.node(1)), a = pair_acceleration(state.node(0), state.node(1));
  velocity[0] += m.rate(v) - law().derivative(state.time(), 1);
  acceleration[0] += m.acceleration(v, a) - law().derivative(state.time(), 2);
}

void PositionDrive::add_energy(const LocalState& state, Energy& energy) const {
  energy.input += force(state) * law().derivative(state.time(), 1);
}

// -- rate

double RateDrive::force(const LocalState& state) const { return -state.multiplier()[0]; }

void RateDrive::declare(Declaration& declaration) const {
  declare_nodes(declaration);
  declaration.damping = true;
  declaration.multipliers.push_back({coordinate().name + " rate", force_units(), 0, ConstraintKind::nonholonomic});
}

void RateDrive::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  const PairMeasure m = measure(state);
  r.head<12>() += state.multiplier()[0] * m.gradient;
  r[12] += m.rate(pair_rate(state.node(0), state.node(1))) - law()(state.time());
}

void RateDrive::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  const PairMeasure m = measure(state);
  if (tangent.wants_K) {
    tangent.K.topLeftCorner<12, 12>() += state.multiplier()[0] * m.second;
    tangent.K.block<12, 1>(0, 12) += m.gradient;
    // d(g . v) = v . S dz at fixed v
    tangent.K.block<1, 12>(12, 0) += pair_rate(state.node(0), state.node(1)).transpose() * m.second;
  }
  if (tangent.wants_C) tangent.C.block<1, 12>(12, 0) += m.gradient.transpose();
}

void RateDrive::add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                                     Eigen::Ref<VectorX> acceleration) const {
  const PairMeasure m = measure(state);
  const Vector12 v = pair_rate(state.node(0), state.node(1)), a = pair_acceleration(state.node(0), state.node(1));
  velocity[0] += m.rate(v) - law()(state.time());
  acceleration[0] += m.acceleration(v, a) - law().derivative(state.time(), 1);
}

void RateDrive::add_energy(const LocalState& state, Energy& energy) const {
  energy.input += force(state) * law()(state.time());
}

// -- force

double ForceDrive::force(const LocalState& state) const {
  return state.environment().load_factor * law()(state.time());
}

void ForceDrive::declare(Declaration& declaration) const { declare_nodes(declaration); }

void ForceDrive::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  r.head<12>() -= force(state) * measure(state).gradient;
}

void ForceDrive::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (tangent.wants_K) tangent.K.topLeftCorner<12, 12>() -= force(state) * measure(state).second;
}

void ForceDrive::add_energy(const LocalState& state, Energy& energy) const {
  energy.input += force(state) * measure(state).rate(pair_rate(state.node(0), state.node(1)));
}

// -- reader

void read_drive(const std::string& name, const YamlValue& entry, Model& model) {
  const std::vector<std::string> laws = {"angle", "rate", "torque", "displacement", "speed", "force"};
  std::vector<std::string> keys = {"joint", "coordinate"};
  keys.insert(keys.end(), laws.begin(), laws.end());
  entry.check_keys(keys, "a drive");
  auto* joint = dynamic_cast<Joint*>(&model.component_named_by(entry.at("joint"), "joints"));
  if (!joint) entry.at("joint").fail("is no joint with coordinates that can be driven");

  std::string law;
  for (const std::string& key : laws) {
    if (!entry.has(key)) continue;
    if (!law.empty()) entry.fail(fmt::format("a drive has one law, this one has both '{}' and '{}'", law, key));
    law = key;
  }
  if (law.empty())
    entry.fail(
        "a drive needs one of angle, rate, torque (turning joints) or displacement, speed, force (sliding joints)");

  const bool turning = law == "angle" || law == "rate" || law == "torque";
  const auto wanted = turning ? JointCoordinate::Kind::angle : JointCoordinate::Kind::displacement;
  std::vector<std::string> names;
  for (const JointCoordinate& coordinate : joint->coordinates())
    if (coordinate.kind == wanted) names.push_back(coordinate.name);
  if (names.empty())
    entry.at(law).fail(fmt::format("a {} joint has no {} to drive", joint->type(), turning ? "angle" : "displacement"));
  if (names.size() > 1 && !entry.has("coordinate"))
    entry.fail(
        fmt::format("joint '{}' has several coordinates: give `coordinate`{}", joint->name(), did_you_mean("", names)));
  const std::string chosen = entry.has("coordinate")
                                 ? entry.at("coordinate").word(names, fmt::format("a coordinate for '{}'", law))
                                 : names.front();
  std::size_t index = 0;
  while (joint->coordinates()[index].name != chosen) ++index;

  const std::string group = "joints/" + joint->name();
  for (const Component* other : model.components_in(group))
    if (const auto* driver = dynamic_cast<const Drive*>(other); driver && driver->coordinate().name == chosen)
      entry.fail(fmt::format("the {} of joint '{}' is driven by '{}' already", chosen, joint->name(), driver->name()));

  Expression f = entry.at(law).expression({"t"});
  if (law == "angle") joint->start_at(index, f(0));
  std::unique_ptr<Component> drive;
  if (law == "angle" || law == "displacement")
    drive = std::make_unique<PositionDrive>(name, *joint, index, std::move(f));
  else if (law == "rate" || law == "speed")
    drive = std::make_unique<RateDrive>(name, *joint, index, std::move(f));
  else
    drive = std::make_unique<ForceDrive>(name, *joint, index, std::move(f));
  model.add(std::move(drive), group);
}

}  // namespace bielle::mechanism

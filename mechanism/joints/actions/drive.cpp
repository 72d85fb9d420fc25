#include "mechanism/joints/actions/drive.hpp"

#include <cmath>

#include <fmt/format.h>

#include "mechanism/measures/read_measure.hpp"
#include "mechanism/model/description.hpp"
#include "mechanism/reading/names.hpp"
#include "reduce/common/plausible.hpp"

namespace bielle::mechanism {
std::vector<OutputField> Drive::output_fields() const {
  return {
      force_field("drive_force", "force or torque of the drives along the joint's coordinates; zero where none acts")};
}

void Drive::describe(const LocalState& /*state*/, Description& description) const {
  const LawText text = law_text();
  description.add(fmt::format("{} of joint '{}' is {} [{}]", text.driven, joint().name(), text.law, text.units));
}

void MotionDrive::add_break_points(std::vector<double>& times) const {
  const std::vector<double> points = f_.break_points();
  times.insert(times.end(), points.begin(), points.end());
}

// -- position

double PositionDrive::distance(const LocalState& state, double principal) const {
  const double target = state.motion_factor() * law()(state.time());
  // An angle is prescribed modulo turns: the drive counts them by time, not by memory, so that the result does not
  // depend on step sizes or restarts. Whole turns are taken off the target by itself: rounding of large angles would
  // otherwise keep Newton's method from its tolerance.
  if (coordinate().kind == JointCoordinate::Kind::angle)
    return std::remainder(principal - std::remainder(target, 2 * M_PI), 2 * M_PI);
  return principal - target;
}

void PositionDrive::declare(Declaration& declaration) const {
  declare_references(declaration);
  declaration.multipliers.push_back({coordinate().name, coordinate().force_units()});
}

void PositionDrive::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  CoordinateJet& jet = calc(state);
  add_kept(state, jet, distance(state, jet.principal), r);
}

void PositionDrive::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (tangent.wants_K) add_kept_tangent(state, calc(state), tangent);
}

void PositionDrive::add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                                         Eigen::Ref<VectorX> acceleration) const {
  const auto [first, second] = calc_kept_rates(state);
  velocity[0] += first - law().derivative(state.time(), 1);
  acceleration[0] += second - law().derivative(state.time(), 2);
}

void PositionDrive::add_energy(const LocalState& state, Energy& energy) const {
  energy.input += force(state) * law().derivative(state.time(), 1);
}

// -- rate

void RateDrive::declare(Declaration& declaration) const {
  declare_references(declaration);
  declaration.damping = true;
  declaration.multipliers.push_back(
      {coordinate().name + " rate", coordinate().force_units(), 0, ConstraintKind::nonholonomic});
}

void RateDrive::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  CoordinateJet& jet = calc(state);
  r.segment(row(state), jet.w().size()) += state.multiplier()[0] * jet.w();
  r[0] += jet.rate - law()(state.time());
}

void RateDrive::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  CoordinateJet& jet = calc(state);
  const int at = row(state);
  const auto n = jet.w().size();
  if (tangent.wants_K) {
    auto K = tangent.K.dense();
    K.block(at, at, n, n) += state.multiplier()[0] * jet.W();
    K.block(at, 0, n, 1) += jet.w();
    K.block(0, at, 1, n) += rate_slope(state, jet).transpose();
  }
  if (tangent.wants_C) tangent.C.dense().block(0, at, 1, n) += jet.w().transpose();
}

void RateDrive::add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                                     Eigen::Ref<VectorX> acceleration) const {
  CoordinateJet& jet = calc(state);
  const LocalState of_joint = state.of(0);
  VectorX v(of_joint.slots().size()), a(v.size());
  get_local_velocities(of_joint, v);
  get_local_accelerations(of_joint, a);
  velocity[0] += jet.rate - law()(state.time());
  acceleration[0] += jet.w().dot(a) + v.dot(jet.W() * v) - law().derivative(state.time(), 1);
}

void RateDrive::add_energy(const LocalState& state, Energy& energy) const {
  energy.input += force(state) * law()(state.time());
}

// -- force

void ForceDrive::read(const YamlValue& law, Model& model) {
  law_ = read_state_formula(law, {"t"}, model, references());
  if (law_.is_constant()) doubt_outside(law, law.number(), plausible_load);
}

double ForceDrive::force(const LocalState& state) const {
  const double t = state.time();
  return state.environment().load_factor * law_.value(state, {&t, 1});
}

Drive::LawText ForceDrive::law_text() const {
  const bool turning = coordinate().kind != JointCoordinate::Kind::displacement;
  return {fmt::format("{} on {}", turning ? "torque" : "force", coordinate().name), law_.text(),
          coordinate().force_units()};
}

void ForceDrive::declare(Declaration& declaration) const {
  declare_references(declaration);
  declaration.damping = law_.reads_state();
  declaration.reads_reactions = law_.reads_reactions();
}

void ForceDrive::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  CoordinateJet& jet = calc(state);
  r.segment(row(state), jet.w().size()) -= force(state) * jet.w();
}

void ForceDrive::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (!tangent.wants_K && !(tangent.wants_C && law_.reads_state())) return;
  const double t = state.time(), factor = state.environment().load_factor;
  thread_local FormulaGradient gradient;
  law_.calc(state, {&t, 1}, gradient);
  CoordinateJet& jet = calc(state);
  const int at = row(state);
  const auto n = jet.w().size();
  if (tangent.wants_K) tangent.K.dense().block(at, at, n, n) -= factor * gradient.value * jet.W();
  if (!law_.reads_state()) return;
  if (tangent.wants_K)
    tangent.K.dense().middleRows(at, n) -= factor * jet.w() * gradient.by_state.position().transpose();
  if (tangent.wants_C) tangent.C.dense().middleRows(at, n) -= factor * jet.w() * gradient.by_state.rate().transpose();
}

void ForceDrive::add_energy(const LocalState& state, Energy& energy) const {
  energy.input += force(state) * value(state).rate;
}

// -- reader

void read_drive(const std::string& name, const YamlValue& entry, Model& model) {
  const std::vector<std::string> laws = {"angle", "rate", "torque", "displacement", "speed", "force"};
  std::vector<std::string> keys = {"joint", "coordinate"};
  keys.insert(keys.end(), laws.begin(), laws.end());
  entry.check_keys(keys, "a drive");
  auto* joint = dynamic_cast<Joint*>(&component_named_by(Section::joints, entry.at("joint"), model));
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
  std::vector<std::string> names;
  for (const JointCoordinate& coordinate : joint->coordinates())
    if ((coordinate.kind != JointCoordinate::Kind::displacement) == turning) names.push_back(coordinate.name);
  if (names.empty())
    entry.at(law).fail(fmt::format("a {} joint has no {} to drive", joint->type(), turning ? "angle" : "displacement"));
  if (names.size() > 1 && !entry.has("coordinate"))
    entry.fail(
        fmt::format("joint '{}' has several coordinates: give `coordinate`{}", joint->name(), did_you_mean("", names)));
  const std::string chosen = entry.has("coordinate")
                                 ? entry.at("coordinate").word(names, fmt::format("a coordinate for '{}'", law))
                                 : names.front();
  const std::size_t index = joint->coordinate_index(chosen);

  Joint::CoordinateUse& use = joint->use(index);
  if (!use.driver.empty())
    entry.fail(fmt::format("the {} of joint '{}' is driven by '{}' already", chosen, joint->name(), use.driver));
  use.driver = name;
  const bool by_motion = law != "torque" && law != "force";
  if (by_motion && use.locked)
    entry.fail(fmt::format("the {} of joint '{}' is `locked` for a time, which a drive by motion contradicts", chosen,
                           joint->name()));

  const Entry driven{Section::joints, joint->name()}, own{Section::drives, name};
  const YamlValue value = entry.at(law);
  if (!by_motion) {
    auto drive = std::make_unique<ForceDrive>(name, *joint, index);
    model.when_read(Model::Stage::formulas, [drive = drive.get(), value, &model] { drive->read(value, model); });
    model.add_within(std::move(drive), own, driven);
    return;
  }
  Expression f = value.expression({"t"});
  if (law == "angle" || law == "displacement")
    doubt_jumps(value, f, law == "angle" ? "the angle" : "the displacement");
  if (law == "angle") joint->start_at(index, f(0));
  std::unique_ptr<Component> drive;
  if (law == "angle" || law == "displacement")
    drive = std::make_unique<PositionDrive>(name, *joint, index, std::move(f));
  else
    drive = std::make_unique<RateDrive>(name, *joint, index, std::move(f));
  model.add_within(std::move(drive), own, driven);
}

}  // namespace bielle::mechanism

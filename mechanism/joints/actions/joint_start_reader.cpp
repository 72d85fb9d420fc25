#include "mechanism/joints/actions/joint_start_reader.hpp"

#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "mechanism/joints/actions/motion_drive.hpp"
#include "mechanism/model/carried_start.hpp"

namespace bielle::mechanism {
namespace {

/// Returns the drive of a kind on a coordinate, or nullptr.
template <class Kind>
const Kind* drive_of(const Joint& joint, std::size_t coordinate, const Model& model) {
  for (const Component* component : model.components_of({Section::joints, joint.name()}))
    if (const auto* drive = dynamic_cast<const Kind*>(component);
        drive != nullptr && &drive->coordinate() == &joint.coordinates()[coordinate])
      return drive;
  return nullptr;
}

/// Refuses a start value or rate that a drive by motion determines already.
void check_drives(const std::optional<YamlValue>& value, const std::optional<YamlValue>& rate, const Joint& joint,
                  std::size_t coordinate, const Model& model) {
  const std::string& name = joint.coordinates()[coordinate].name;
  if (const auto* drive = drive_of<PositionDrive>(joint, coordinate, model)) {
    const auto& given = value ? value : rate;
    given->fail(
        fmt::format("drive '{}' prescribes the {} as a function of time, at the start as well: leave this out, or "
                    "change the drive",
                    drive->name(), name));
  }
  if (const auto* drive = drive_of<RateDrive>(joint, coordinate, model); drive != nullptr && rate)
    rate->fail(
        fmt::format("drive '{}' prescribes the rate of the {}, at the start as well: leave this out, or change the "
                    "drive",
                    drive->name(), name));
}

/// Warns of a whole number of radians beyond a turn, which is probably meant in degrees.
void warn_of_degrees(const YamlValue& value, double angle) {
  if (std::abs(angle) <= 2 * M_PI || angle != std::round(angle)) return;
  value.warn(fmt::format("is {:g} rad meant, {:.3g} turns? An angle in degrees is written `{:g} deg`", angle,
                         angle / (2 * M_PI), angle));
}

}  // namespace

void read_joint_start(const std::optional<YamlValue>& value, const std::optional<YamlValue>& rate, Joint& joint,
                      std::size_t coordinate, Model& model) {
  if (!value && !rate) return;
  StartCondition condition{&joint, coordinate, {}, {}};
  const JointCoordinate::Kind kind = joint.coordinates()[coordinate].kind;
  if (value) {
    condition.value = value->number();
    if (kind == JointCoordinate::Kind::rotation && std::abs(*condition.value) >= M_PI)
      value->fail("a component of a rotation vector is less than half a turn, pi");
    if (kind == JointCoordinate::Kind::angle) warn_of_degrees(*value, *condition.value);
    joint.start_at(coordinate, *condition.value, false);
  }
  if (rate) condition.rate = rate->number();
  model.add_start_condition(condition);
  model.when_read(Model::Stage::connections,
                  [value, rate, &joint, coordinate, &model] { check_drives(value, rate, joint, coordinate, model); });
}

void read_carried_start(const YamlValue& carries, const Joint& joint, Model& model) {
  carries.word();
  Declaration declaration;
  joint.declare(declaration);
  if (declaration.nodes.size() != 2)
    carries.fail(
        fmt::format("a {} joint stands between more than two nodes: it does not say what is behind it", joint.type()));
  model.add(std::make_unique<CarriedStart>(joint), Entry{Section::joints, joint.name()}, Recorded::no);
}

}  // namespace bielle::mechanism

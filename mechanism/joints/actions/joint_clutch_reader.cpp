#include "mechanism/joints/actions/joint_clutch_reader.hpp"

#include <memory>

#include <fmt/format.h>

#include "mechanism/joints/actions/one_way.hpp"
#include "mechanism/joints/friction/clutch.hpp"

namespace bielle::mechanism {
namespace {

template <Moves moves>
const KeyTable& keys_of_clutch() {
  using namespace keys;
  static const KeyTable table{
      "`clutch`",
      "A friction clutch, brake or torque limiter, which holds a coordinate up to a force or torque and slips beyond "
      "it.",
      {{"capacity", state_formula(units_of(moves).force, {"t"}), optional,
        "Force or torque with which it slips, not negative: a formula of the time t and measures."},
       {"normal_force", state_formula("N", {"t"}), optional,
        "Force that presses the plates together, in place of `capacity`: a formula of the time t and measures."},
       {"coefficient", number().non_negative(), optional, "Coefficient of sliding friction of the plates."},
       {"radius", number("m").positive(), optional, "Mean radius of the plates of a turning coordinate."},
       {"surfaces", integer().at_least(1), otherwise("1"), "Number of friction surfaces of the plates."},
       {"static_ratio", number().at_least(1), otherwise("1"),
        "Force or torque at which it begins to slip, over that with which it slips."}}};
  return table;
}

template <Moves moves>
const KeyTable& keys_of_one_way() {
  using namespace keys;
  const CoordinateUnits& units = units_of(moves);
  static const KeyTable table{
      "`one_way`",
      "A one-way clutch or ratchet, which lets a coordinate move one way.",
      {{"direction", word({"forwards", "backwards"}, "a direction"), otherwise("forwards"),
        "Direction in which the coordinate moves freely."},
       {"pitch", number(units.value).positive(), optional,
        "Pitch of a ratchet, which holds at multiples of it alone; without it the clutch holds anywhere."},
       {"stiffness", number(units.stiffness).positive(), optional,
        "Stiffness with which it holds; without it, it is rigid."},
       {"damping", number(units.damping).non_negative(), otherwise("0"), "Damping with which it holds."}}};
  return table;
}

const KeyTable& clutch_keys(Moves moves) { return clutch_form(moves).table(); }
const KeyTable& one_way_keys(Moves moves) { return one_way_form(moves).table(); }

void refuse_rotation(const YamlValue& given, const Joint& joint, std::size_t coordinate, const char* what) {
  if (joint.coordinates()[coordinate].kind == JointCoordinate::Kind::rotation)
    given.fail(fmt::format("a component of a rotation vector has no {}; take a joint with angles", what));
}

}  // namespace

KeyForm clutch_form(Moves moves) {
  return keys::nested(moves == Moves::slides  ? keys_of_clutch<Moves::slides>
                      : moves == Moves::turns ? keys_of_clutch<Moves::turns>
                                              : keys_of_clutch<Moves::both>);
}

KeyForm one_way_form(Moves moves) {
  return keys::nested(moves == Moves::slides  ? keys_of_one_way<Moves::slides>
                      : moves == Moves::turns ? keys_of_one_way<Moves::turns>
                                              : keys_of_one_way<Moves::both>);
}

void read_clutch(const YamlValue& given, const Joint& joint, std::size_t coordinate, Model& model) {
  refuse_rotation(given, joint, coordinate, "clutch");
  const Moves moves = moves_of(joint.coordinates()[coordinate]);
  const YamlValue entry = given.keyed(clutch_keys(moves));
  if (entry.has("capacity") == entry.has("normal_force"))
    entry.fail("a clutch takes either its `capacity` or the `normal_force` of its plates");
  const bool plates = entry.has("normal_force"), turns = moves == Moves::turns;
  double factor = 1;
  if (plates) {
    if (!entry.has("coefficient")) entry.fail("give the `coefficient` of friction of the plates");
    if (turns && !entry.has("radius")) entry.fail("a coordinate that turns needs the mean `radius` of the plates [m]");
    factor = entry.at("coefficient").number() * entry.at("surfaces").integer();
  }
  for (const char* key : {"coefficient", "radius", "surfaces"})
    if (const auto value = entry.find(key); value && !plates) value->fail("belongs to the `normal_force` of plates");
  if (const auto radius = entry.find("radius")) {
    if (!turns) radius->fail("belongs to a coordinate that turns");
    factor *= radius->number();
  }
  auto clutch = std::make_unique<Clutch>(joint, coordinate, entry.at("static_ratio").number());
  const YamlValue formula = entry.at(plates ? "normal_force" : "capacity");
  model.when_read(Model::Stage::formulas,
                  [clutch = clutch.get(), formula, factor, &model] { clutch->read(formula, factor, model); });
  model.add(std::move(clutch), Entry{Section::joints, joint.name()});
}

void read_one_way(const YamlValue& given, const Joint& joint, std::size_t coordinate, Model& model) {
  refuse_rotation(given, joint, coordinate, "one-way clutch");
  const YamlValue entry = given.keyed(one_way_keys(moves_of(joint.coordinates()[coordinate])));
  OneWayRule rule;
  if (entry.at("direction").word() == "backwards") rule.sense = -1;
  if (const auto pitch = entry.find("pitch")) rule.pitch = pitch->number();
  const Entry own{Section::joints, joint.name()};
  if (const auto stiffness = entry.find("stiffness")) {
    model.add(std::make_unique<ElasticOneWay>(joint.name(), joint, coordinate, rule, stiffness->number(),
                                              entry.at("damping").number()),
              own);
    return;
  }
  if (const auto damping = entry.find("damping")) damping->fail("needs the `stiffness` of the one-way clutch");
  model.add(std::make_unique<RigidOneWay>(joint.name(), joint, coordinate, rule), own);
}

}  // namespace bielle::mechanism

#include "mechanism/joints/actions/drive_keys.hpp"

#include "mechanism/joints/actions/drive.hpp"
#include "mechanism/reading/pid_gains.hpp"
#include "mechanism/reading/read_activity.hpp"

namespace bielle::mechanism {
namespace {

Key limit_key(Moves moves) {
  using namespace keys;
  const char* unit = units_of(moves).force;
  const KeyForms end = {number(unit), null()};
  return {"limit",
          {number(unit).positive(), tuple({end, end})},
          optional,
          "Largest amount of the torque or force, or its lower and upper limit, one of which may be open (`~`)."};
}

template <Moves moves>
const KeyTable& keys_of_pid() {
  using namespace keys;
  static const KeyTable table{
      "`pid`", "A controller, whose torque or force moves a coordinate or a measure to a target.",
      joined({{{"coordinate", text(), computed("the only one of the joint"), "Coordinate on which the drive acts."},
               {"measure",
                {name_of("measure"), state_formula("any", {"t"})},
                computed("the coordinate itself"),
                "Quantity that is controlled."},
               {"target", state_formula("any", {"t"}), required, "Target as a formula of t and measures."}},
              pid_gain_keys("torque or force", "error"),
              {limit_key(moves),
               {"tracking_time", number("s").positive(), computed("kp/ki"),
                "Time in which the integral leaves a limit after the error has changed its sign."}}})};
  return table;
}

template <Moves moves>
const KeyTable& keys_of_drive() {
  using namespace keys;
  const KeyForm sought = word({"sought"}, "a torque or force that inverse dynamics finds");
  static const KeyTable table{
      "a drive",
      "A motor on a coordinate of a joint, by one of the laws angle, rate, torque, displacement, speed, force, pid, "
      "motor.",
      {{"joint", name_of("joint"), required, "Joint that is driven."},
       {"coordinate", text(), computed("the only one of the law's kind"), "Coordinate that is driven."},
       {"angle", formula("rad", {"t"}), optional, "Angle as a formula of t, kept by a constraint."},
       {"rate", formula("rad/s", {"t"}), optional, "Rate of the angle as a formula of t, kept by a constraint."},
       {"torque",
        {state_formula("N m", {"t"}), sought},
        optional,
        "Torque as a formula of t and measures; or `sought`: inverse dynamics finds it."},
       {"displacement", formula("m", {"t"}), optional, "Displacement as a formula of t, kept by a constraint."},
       {"speed", formula("m/s", {"t"}), optional, "Rate of the displacement as a formula of t, kept by a constraint."},
       {"force",
        {state_formula("N", {"t"}), sought},
        optional,
        "Force as a formula of t and measures; or `sought`: inverse dynamics finds it."},
       {"pid",
        nested(moves == Moves::slides  ? keys_of_pid<Moves::slides>
               : moves == Moves::turns ? keys_of_pid<Moves::turns>
                                       : keys_of_pid<Moves::both>),
        optional, "Torque or force of a controller."},
       {"motor", nested(motor_keys), optional, "Torque or force of a direct-current motor at a voltage."},
       limit_key(moves),
       {"release",
        {number("s").positive(), nested(release_keys)},
        optional,
        "Time or event at which the drive releases its joint permanently. Steps end there; the joint moves freely "
        "afterwards, with its present velocities."},
       {"moves",
        {name_of("node"), list_of(name_of("node"))},
        computed("all nodes that have a motion"),
        "Nodes whose prescribed motion a sought torque or force causes."},
       activity_key()}};
  return table;
}

}  // namespace

const KeyTable& motor_keys() {
  using namespace keys;
  static const KeyTable table{
      "`motor`",
      "A direct-current motor, whose current follows from a voltage and from the motion.",
      {{"coordinate", text(), computed("the only one of the joint"), "Coordinate on which the motor acts."},
       {"voltage", state_formula("V", {"t"}), required, "Voltage as a formula of t and measures."},
       {"resistance", number("ohm").positive(), required, "Resistance of the winding."},
       {"inductance", number("H").non_negative(), otherwise("0"), "Inductance of the winding."},
       {"torque_constant", number("N m/A or N/A"), required, "Torque or force of the motor per current."},
       {"back_emf", number("V s/rad or V s/m"), computed("the torque constant"),
        "Voltage that the motion induces, per rate of the motor."},
       {"gear_ratio", number(), otherwise("1"), "Rate of the motor per rate of the coordinate."},
       {"friction", number("N m s/rad or N s/m").non_negative(), otherwise("0"),
        "Viscous friction of the motor, per rate of the motor."}}};
  return table;
}

const KeyTable& release_keys() {
  using namespace keys;
  static const KeyTable table{
      "`release`",
      "Event at which a drive releases its joint: a named one, or when a formula crosses a value.",
      {{"event", name_of("event"), optional, "Event at which the drive lets go."},
       {"when",
        {name_of("measure"), state_formula("any", {"t"})},
        optional,
        "Measure or formula that crosses a value, in place of `event`."},
       {"crosses", number("any"), otherwise("0"), "Value that is crossed."},
       {"direction", word({"rising", "falling", "both"}, "a direction of crossing"), otherwise("both"),
        "Direction of crossing."}}};
  return table;
}

const KeyTable& drive_keys(Moves moves) {
  return moves == Moves::slides  ? keys_of_drive<Moves::slides>()
         : moves == Moves::turns ? keys_of_drive<Moves::turns>()
                                 : keys_of_drive<Moves::both>();
}

const KeyTable& pid_keys(Moves moves) {
  return moves == Moves::slides  ? keys_of_pid<Moves::slides>()
         : moves == Moves::turns ? keys_of_pid<Moves::turns>()
                                 : keys_of_pid<Moves::both>();
}

const KeyTable& drive_keys() { return drive_keys(Moves::both); }

}  // namespace bielle::mechanism

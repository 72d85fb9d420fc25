// Samples of drives.
#include "tests/laws/sample.hpp"

namespace bielle::laws {
namespace {

using mechanism::Section;

/// Returns two nodes turned against each other, a joint whose axes are those of neither, and a drive.
std::string driven(const std::string& joint_type, const std::string& drive) {
  return R"yaml(
nodes:
  a: {position: [0.3, 0.1, -0.2], rotation_vector: [0.3, -0.5, 0.8]}
  b: {position: [1.1, 0.5, 0.4], rotation_vector: [-0.7, 0.2, 0.4]}
joints:
  axle: {type: )yaml" +
         joint_type + ", nodes: [a, b], position: [0.5, 0.2, 0.1], axis: [1, 2, 3]}\ndrives:\n  it: {" + drive + "}\n";
}

Sample drive(const std::string& joint_type, const std::string& law, const std::string& value,
             std::vector<BadValue> bad) {
  bad.push_back({"joint", "axis", "no 'axis'"});
  bad.push_back({law, "'x*t'", "x"});
  return {Section::drives, "drive", law + " of a " + joint_type,
          driven(joint_type, "joint: axle, " + law + ": \"" + value + "\""), std::move(bad)};
}

/// Returns a drive with keys beyond its law. @param keys  all but the joint
Sample with_keys(const std::string& joint_type, const std::string& variant, const std::string& keys,
                 std::vector<BadValue> bad) {
  bad.push_back({"joint", "axis", "no 'axis'"});
  return {Section::drives, "drive", variant + " of a " + joint_type, driven(joint_type, "joint: axle, " + keys),
          std::move(bad)};
}

std::vector<Sample> controllers() {
  std::vector<Sample> list;
  list.push_back(
      with_keys("hinge", "pid within limits",
                "pid: {target: \"0.3*t + 0.1*sin(t)\", kp: 3, ki: 2, kd: 0.5, limit: [-4, 5], tracking_time: "
                "0.7}, release: 1.5",
                {{"pid.target", "axle.angle.rate", "rate is not known"},
                 {"pid.kp", "big", ""},
                 {"pid.ki", "0", "tracking_time"},
                 {"pid.kd", "x", ""},
                 {"pid.limit", "[5, -4]", "lower limit first"},
                 {"pid.limit", "", "tracking_time"},
                 {"pid.measure", "axle.angle", "rate that is not known"},
                 {"pid.coordinate", "angel", "did you mean 'angle'"},
                 {"pid", "{target: 1}", "pid"},
                 {"limit", "3", "within `pid`"},
                 {"coordinate", "angle", "within `pid`"}}));
  list.push_back(
      with_keys("prismatic", "pid with a filter, released by a measure",
                "pid: {target: \"0.2*axle.displacement.rate + t\", kp: 3, ki: 2, kd: 0.4, filter: 0.1, limit: "
                "6}, release: {when: axle.displacement, crosses: 9, direction: rising}",
                {{"pid.kp", "0", "kp"},
                 {"pid.kd", "0", "kd"},
                 {"pid.target", "'x'", "x"},
                 {"release", "{crosses: 1}", "one of the two"},
                 {"release", "{event: arrived}", "no 'arrived'"},
                 {"release.when", "axle.angle", "no 'angle'"},
                 {"release.crosses", "far", ""},
                 {"release.event", "arrived", "one of the two"}}));
  list.push_back(
      with_keys("cylindrical", "pid on a measure",
                "pid: {coordinate: angle, measure: \"distance(a, b)\", target: 1, kp: 3, kd: 0.3, filter: 0.05}",
                {{"pid.coordinate", "", "several coordinates"},
                 {"pid.measure", "'distance(a, c)'", "no node 'c'"},
                 {"pid.filter", "", "filter"}}));
  list.push_back(with_keys("spherical", "pid", "pid: {coordinate: ry, target: \"t\", kp: 2, kd: 0.5}",
                           {{"pid.coordinate", "angle", "ry"}}));
  list.push_back(with_keys("hinge", "torque within limits, released by a measure",
                           "torque: \"2 + 0.3*axle.angle\", limit: 40, release: {when: axle.angle, crosses: 9}",
                           {{"torque", "'x'", "x"}, {"limit", "[~, ~]", "no limit"}, {"release.when", "'x'", "x"}}));
  list.push_back(with_keys("hinge", "torque sought", "torque: sought",
                           {{"torque", "'x'", "x"},
                            {"limit", "3", "does not go with an effort that is sought"},
                            {"release", "1", "does not go with an effort that is sought"},
                            {"moves", "b", "no `motion`"},
                            {"moves", "c", "c"}}));
  list.push_back(with_keys("hinge", "angle, released", "angle: \"0.3*t\", release: 1.5",
                           {{"angle", "'x'", "x"}, {"limit", "3", "motion needs"}}));
  list.push_back(with_keys("hinge", "rate, released", "rate: \"0.3*t\", release: {when: axle.angle, crosses: 9}",
                           {{"rate", "'x'", "x"}, {"release.when", "'x'", "x"}}));
  return list;
}

std::vector<Sample> motors() {
  std::vector<Sample> list;
  list.push_back(with_keys("hinge", "motor",
                           "motor: {voltage: \"2*sin(t) - 0.3*axle.angle - 0.1*axle.angle.rate - 0.4*it.current\", "
                           "resistance: 0.7, inductance: 0.4, torque_constant: 0.6, back_emf: 0.5, gear_ratio: 1.5, "
                           "friction: 0.2}, release: 2",
                           {{"motor.voltage", "x", "x"},
                            {"motor.torque_constant", "0", "no torque"},
                            {"motor.gear_ratio", "0", "no torque"},
                            {"motor.coordinate", "angel", "did you mean 'angle'"},
                            {"limit", "3", "limit its voltage"},
                            {"coordinate", "angle", "within `motor`"}}));
  list.push_back(with_keys("cylindrical", "motor without inductance",
                           "motor: {coordinate: displacement, voltage: \"t - axle.angle\", resistance: 0.7, "
                           "torque_constant: 0.6}",
                           {{"motor.coordinate", "", "several coordinates"}}));
  list.back().has_no_power = true;  // in random states the current does not satisfy its algebraic equation
  return list;
}

}  // namespace

std::vector<Sample> drive_samples() {
  std::vector<Sample> list = controllers();
  for (Sample& each : motors()) list.push_back(std::move(each));
  // Formulas of the state: every kind of measure.
  const std::string everything =
      "2 + axle.angle*sin(t) - 0.3*axle.angle.rate + 0.1*axle.reaction.x - 0.2*axle.reaction.rz + "
      "b.position.y*a.velocity.z"
      " + b.rotation.x + 0.1*a.angular_velocity.y + distance(a, b)*angle(a, b)";
  Sample of_state = drive("hinge", "torque", everything, {{"torque", "'axle.angel'", "did you mean 'angle'"}});
  of_state.inertial = true;
  list.push_back(of_state);
  // Orientations are relative to the inertial axes; they change if the model is rotated as a whole.
  Sample of_orientation =
      drive("hinge", "torque",
            "2 + a.rotation_vector.x*b.rotation_vector.y.rate + b.bryant.a + a.bryant.b.rate - "
            "b.bryant.c.rate*a.euler.a + b.euler.b.rate*a.euler.c",
            {{"torque", "'a.bryant.d'", "did you mean"}, {"torque", "'a.eulr.b'", "did you mean 'euler.b'"}});
  of_orientation.inertial = true;
  list.push_back(of_orientation);
  Sample of_turns = drive("hinge", "torque", "2 + a.turn.x*b.turn.y.rate + 0.3*b.turn.z - a.turn.z.rate",
                          {{"torque", "'a.turn'", "did you mean"}, {"torque", "'a.turns.z'", "did you mean 'turn.z'"}});
  of_turns.inertial = true;
  list.push_back(of_turns);
  list.push_back(drive("hinge", "torque", "roll*sin(t) + 0.4*roll_rate^2", {}));
  list.back().model +=
      "measures:\n"
      "  roll: {node: b, relative_to: a, quantity: turn, direction: [1, 2, 3]}\n"
      "  roll_rate: {node: a, relative_to: b, quantity: turn_rate, direction: [-0.4, 1, 0.2]}\n";
  list.push_back(drive("spherical", "torque", "2 + axle.rx*axle.ry.rate", {{"coordinate", "angle", "rx"}}));
  list.back().model.replace(list.back().model.find("it: {joint: axle"), 16, "it: {coordinate: ry, joint: axle");
  list.push_back(drive("spherical", "rate", "0.3*t", {{"coordinate", "angle", "rx"}}));
  list.back().model.replace(list.back().model.find("it: {joint: axle"), 16, "it: {coordinate: rz, joint: axle");
  list.push_back(drive("spherical", "angle", "0.3*t", {{"coordinate", "angle", "rx"}}));
  list.back().model.replace(list.back().model.find("it: {joint: axle"), 16, "it: {coordinate: rx, joint: axle");
  list.push_back(drive("hinge", "angle", "0.3*t + 0.1*sin(t)", {}));
  list.push_back(drive("prismatic", "displacement", "0.3*t^2", {}));
  list.push_back(drive("hinge", "rate", "0.3*cos(t)", {}));
  list.push_back(drive("prismatic", "speed", "0.3*t", {}));
  list.push_back(drive("hinge", "torque", "2 + t", {}));
  list.push_back(drive("cylindrical", "force", "2 + t", {}));
  return list;
}

}  // namespace bielle::laws

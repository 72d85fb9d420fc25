// Messages about formulas of the state with unknown names.
#include <catch2/catch.hpp>

#include "mechanism/io/mechanism_file.hpp"
#include "tests/support/messages.hpp"

using namespace bielle::mechanism;
using bielle::test::message_of;

namespace {

/// Returns a torque's formula, and measures besides.
std::string model(const std::string& torque, const std::string& measures = "") {
  return R"yaml(
nodes: {pin: {position: [1, 0, 0]}, "end plate": {position: [2, 0, 0]}}
elements:
  pin: {type: rigid_body, node: pin, mass: 1, inertia: [1, 1, 1]}
  plate: {type: rigid_body, node: end plate, mass: 1, inertia: [1, 1, 1]}
joints:
  main: {type: hinge, nodes: [ground, pin], axis: [0, 0, 1]}
  "second joint": {type: cylindrical, nodes: [pin, end plate], axis: [0, 0, 1]}
)yaml" + measures +
         "drives:\n  motor: {joint: main, torque: \"" + torque + "\"}\n";
}

std::string message(const std::string& torque, const std::string& measures = "") {
  return message_of<bielle::InputError>([&] { read_mechanism_text(model(torque, measures), "model.yaml"); });
}

using Catch::Contains;

}  // namespace

TEST_CASE("an unknown joint, node, coordinate or component of a reaction in a formula is told with the nearest name") {
  CHECK_THAT(message("2*mian.angle"),
             Contains("model.yaml") && Contains("no joint, node or element 'mian'") && Contains("did you mean 'main'"));
  CHECK_THAT(message("2*main.angel"), Contains("'main' has no 'angel'") && Contains("did you mean 'angle'"));
  CHECK_THAT(message("2*main.angle.rat"), Contains("'main' has no 'angle.rat'") && Contains("'angle.rate'"));
  CHECK_THAT(message("main.reaction.w"), Contains("'main' has no 'reaction.w'") && Contains("reaction."));
  CHECK_THAT(message("pin.position.w"), Contains("no 'position.w'") && Contains("position."));
  CHECK_THAT(message("distance(pin, gruond)"), Contains("no node 'gruond'") && Contains("'ground'"));
  CHECK_THAT(message("'second joynt'.angle"), Contains("'second joynt'") && Contains("did you mean 'second joint'"));
}

TEST_CASE("functions of nodes take two different nodes") {
  CHECK_THAT(message("distance(pin)"), Contains("expected two nodes") && Contains("distance(a, b)"));
  CHECK_THAT(message("angle(pin, ground, 'end plate')"), Contains("expected two nodes") && Contains("angle(a, b)"));
  CHECK_THAT(message("distance(pin, pin)"), Contains("two different nodes"));
  CHECK_THAT(message("distance(pin, ground).x"), Contains("nothing can follow it"));
  CHECK_THAT(message("distance(pin, 2)"), Contains("no node '2'") && Contains("'end plate'"));
  CHECK_THAT(message("distance(pin, 2*t)"), Contains("takes names"));
}

TEST_CASE("names of several words are quoted, and a quote that is not closed is told") {
  CHECK(message("'second joint'.angle + distance(pin, 'end plate')") == "(nothing thrown)");
  CHECK(message("'second joint'.displacement.rate*main.reaction.rz") == "(nothing thrown)");
  CHECK_THAT(message("2*'second joint.angle"), Contains("not closed"));
  CHECK(message("second joint.angle") != "(nothing thrown)");
  CHECK_THAT(message("''.angle"), Contains("name is missing"));
}

TEST_CASE("what joints and nodes of one name have is found in either") {
  const std::string text = R"yaml(
nodes: {same: {position: [1, 0, 0]}}
elements: {body: {type: rigid_body, node: same, mass: 1, inertia: [1, 1, 1]}}
joints: {same: {type: hinge, nodes: [ground, same], axis: [0, 0, 1]}}
drives: {motor: {joint: same, torque: "FORMULA"}}
)yaml";
  const auto with = [&](const std::string& formula) {
    std::string filled = text;
    filled.replace(filled.find("FORMULA"), 7, formula);
    return message_of<bielle::InputError>([&] { read_mechanism_text(filled, "model.yaml"); });
  };
  CHECK(with("same.angle + same.position.x") == "(nothing thrown)");
  CHECK_THAT(with("same.angel"), Contains("did you mean 'angle'"));
  CHECK_THAT(with("same.positon.x"), Contains("did you mean 'position.x'"));
}

TEST_CASE("measures that refer to themselves, at once or through others, are refused where they do") {
  CHECK_THAT(message("one", "measures: {one: \"2*one + main.angle\"}\n"),
             Contains("model.yaml") && Contains("refers to itself"));
  const std::string through =
      message("one", "measures:\n  one: \"2*two\"\n  two: \"three + 1\"\n  three: \"one*main.angle\"\n");
  CHECK_THAT(through, Contains("model.yaml") && Contains("refers to itself") && Contains("'one'"));
  // Two references to the same measure are no cycle.
  CHECK(message("one + two", "measures:\n  one: \"2*three\"\n  two: \"3*three\"\n  three: main.angle\n") ==
        "(nothing thrown)");
  CHECK(message("one", "measures: {one: \"2*t\"}\n") == "(nothing thrown)");
  CHECK_THAT(message("1", "measures: {one: \"2*pi\"}\n"), Contains("a constant belongs to `parameters`"));
}

TEST_CASE("values of measures, inputs and events may have units, which must fit where they are known") {
  const auto said = [](const std::string& sections) { return message("1", sections); };
  CHECK(said("measures: {tip: {node: pin, direction: x, at: [12 mm, 0, 0]}}\n") == "(nothing thrown)");
  CHECK(said("inputs: {command: {start: 5 deg, units: rad}}\n") == "(nothing thrown)");
  CHECK(said("events: {there: {when: main.angle, crosses: 90 deg}}\n") == "(nothing thrown)");
  CHECK_THAT(said("measures: {tip: {node: pin, direction: x, at: [12 kg, 0, 0]}}\n"),
             Contains("measures.tip.at[1]: expected a value in m, found one in 'kg'"));
  CHECK_THAT(said("inputs: {command: {start: 5 nonsense}}\n"), Contains("inputs.command.start: 'nonsense' is no unit"));
  CHECK_THAT(said("events: {there: {when: main.angle, crosses: 9 nonsense}}\n"),
             Contains("events.there.crosses: 'nonsense' is no unit"));
}

// Tests of maps that are bound to tables of keys: refusals, units, ranges, defaults, and the forms of nested values.
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/common/input/foreign_words.hpp"
#include "reduce/common/input/key_table.hpp"
#include "reduce/common/input/key_words.hpp"
#include "reduce/common/input/yaml_file.hpp"
#include "tests/support/messages.hpp"

using namespace bielle;
using bielle::test::message_of;
using Catch::Matchers::Contains;

namespace test_key_table {
namespace {

const KeyTable& friction_keys() {
  using namespace keys;
  static const KeyTable table{"the friction",
                              "Friction of a hinge.",
                              {{"coefficient", number().non_negative(), otherwise("0.1"), "Coefficient."},
                               {"radius", number("m").positive(), required, "Radius of the pin."}}};
  return table;
}

const KeyTable& cylinder_keys() {
  using namespace keys;
  static const KeyTable table{
      "a cylinder",
      "A cylinder.",
      {{"cylinder", number("m"), required, "Radius."}, {"length", number("m"), required, "Length."}}};
  return table;
}

const KeyTable& ball_keys() {
  using namespace keys;
  static const KeyTable table{
      "a ball", "A ball.", {{"shape", text(), required, "The shape."}, {"radius", number("m"), required, "Radius."}}};
  return table;
}

const KeyTable& shape_keys() {
  using namespace keys;
  static const KeyTable table{"a shape",
                              "A shape.",
                              {{"shape", text(), required, "The shape."}, {"size", number("m"), required, "Size."}},
                              {{"cylinder", "", cylinder_keys}, {"shape", "ball", ball_keys}}};
  return table;
}

const KeyTable& hinge_keys() {
  using namespace keys;
  static const KeyTable table{
      "a hinge",
      "A hinge.",
      {{"nodes", list_of(2, name_of("node")), optional, "Nodes."},
       {"damping", number("N m s/rad").non_negative(), otherwise("0"), "Damping."},
       {"angle", number("rad"), otherwise("5 deg"), "Angle."},
       {"axis", direction(), otherwise("[0, 0, 2]"), "Axis."},
       {"count", integer().between(1, 4), otherwise("2"), "Count."},
       {"inside", number("m").inside(-1, 1), optional, "Inside."},
       {"most", number("m").at_most(3), optional, "Most."},
       {"least", number("m").at_least(2), optional, "Least."},
       {"kind", word({"dry", "wet"}, "a kind of friction"), otherwise("dry"), "Kind."},
       {"spin", formula("rad", {"t"}), optional, "Spin."},
       {"push", state_formula("N", {"e", "t"}).at_most(1000), optional, "Push."},
       {"friction", nested(friction_keys), optional, "Friction."},
       {"drag", {number("N").positive(), nested(friction_keys)}, optional, "Drag."},
       {"either", {nested(friction_keys), nested(cylinder_keys)}, optional, "One of two tables."},
       {"shape", nested(shape_keys), optional, "Shape."},
       {"shapes", list_of({number("m"), nested(shape_keys)}), optional, "Shapes."},
       {"pair", tuple({{number("m").positive()}, {number("rad")}}), optional, "A length and an angle."},
       {"matrix", matrix(2, 2, "N/m"), optional, "Matrix."},
       {"springs", entries("direction", {number("N/m").positive()}), optional, "Springs."},
       {"hinges", entries("hinge", {nested(friction_keys)}), optional, "Frictions."},
       {"table", {null(), nested(friction_keys)}, optional, "Friction or nothing."},
       {"sizes", entries("size", {number("any")}), optional, "Numbers with any unit."}}};
  return table;
}

YamlValue hinge(const std::string& text) {
  return YamlValue::parse("hinge: {" + text + "}", "a.yaml").at("hinge").keyed(hinge_keys());
}

template <class Action>
std::string why(const std::string& text, Action&& action) {
  return message_of<InputError>([&] { action(hinge(text)); });
}

/// Returns the message about a number.
std::string why_number(const std::string& key, const std::string& value) {
  return why(key + ": " + value, [&](const YamlValue& entry) { entry.at(key).number(); });
}

}  // namespace

TEST_CASE("An unknown key is refused with the nearest name") {
  const auto nothing = [](const YamlValue&) {};
  CHECK(why("dampng: 1", nothing) == "a.yaml:1: hinge: 'dampng' is not a key of a hinge; did you mean 'damping'?");
  CHECK_THAT(why("zzzzzz: 1", nothing), Contains("'zzzzzz' is not a key of a hinge; expected one of "));
  CHECK_THAT(message_of<InputError>([] { YamlValue::parse("a: 1", "a.yaml").at("a").keyed(hinge_keys()); }),
             Contains("a: expected a hinge as keys with values"));
}

TEST_CASE("Words of other programs are refused with the corresponding word, if that one is expected") {
  const auto nothing = [](const YamlValue&) {};
  CHECK(why("c: 1", nothing) == "a.yaml:1: hinge: 'c' is not a key of a hinge; here it is called 'damping'");
  CHECK(why("modes: 1", nothing) == "a.yaml:1: hinge: 'modes' is not a key of a hinge; here it is called 'count'");
  CHECK(why("i: a", nothing) ==
        "a.yaml:1: hinge: 'i' is not a key of a hinge; here both nodes are in one list: `nodes: [first, second]`");
  CHECK_THAT(why("k: 1", nothing),
             Contains("'k' is not a key of a hinge; expected one of "));  // no 'stiffness'
  const std::vector<std::string> both = {"speed", "rate"}, types = {"eigen", "dynamic"};
  CHECK(called_here("velocity", both) == "; here it is called 'rate' or 'speed'");
  CHECK(called_here("velocity", types) == did_you_mean("velocity", types));
  CHECK(called_here("transient", types) == "; here it is called 'dynamic'");
  CHECK(called_here("dynamc", types) == "; did you mean 'dynamic'?");
}

TEST_CASE("A key that is not given has its default, with the unit and the form of the key") {
  const YamlValue entry = hinge("");
  CHECK(entry.at("damping").number() == 0);
  CHECK(entry.at("angle").number() == Approx(0.0872664626));
  CHECK(entry.at("axis").direction() == Eigen::Vector3d(0, 0, 1));
  CHECK(entry.at("kind").word() == "dry");
  CHECK(entry.at("count").integer() == 2);
  CHECK_FALSE(entry.has("damping"));
  CHECK_FALSE(entry.find("damping"));
  CHECK(hinge("damping: 3").at("damping").number() == 3);
  CHECK(hinge("damping: 3").has("damping"));
}

TEST_CASE("Messages about a default, and about a missing key, have the place of the map") {
  const YamlValue entry = hinge("friction: {}");
  CHECK(entry.at("damping").located("wrong") == "a.yaml:1: hinge.damping: wrong");
  CHECK(entry.at("axis").at(1).located("wrong") == "a.yaml:1: hinge.axis[2]: wrong");
  CHECK(why("", [](const YamlValue& each) { each.at("nodes"); }) == "a.yaml:1: hinge: the key 'nodes' is missing");
  CHECK(why("friction: {}", [](const YamlValue& each) { each.at("friction").at("radius"); }) ==
        "a.yaml:1: hinge.friction: the key 'radius' is missing");
}

TEST_CASE("A key that the table lacks is an error of the program") {
  CHECK_THROWS_AS(hinge("").at("mass"), std::logic_error);
  CHECK_THAT(message_of<std::logic_error>([] { hinge("").at("mass"); }),
             Contains("the table of a hinge lacks the key 'mass', which is read"));
  CHECK_THROWS_AS(hinge("damping: 1").at("damping").word(), std::logic_error);
  CHECK_THROWS_AS(hinge("kind: dry").at("kind").expression(), std::logic_error);
}

TEST_CASE("Ranges are written in words") {
  CHECK(keys::number().range_words().empty());
  CHECK(keys::number().positive().range_words() == "greater than 0");
  CHECK(keys::number().non_negative().range_words() == "of at least 0");
  CHECK(keys::number().at_least(2).range_words() == "of at least 2");
  CHECK(keys::number().at_most(0.5).range_words() == "of at most 0.5");
  CHECK(keys::number().between(1, 2).range_words() == "between 1 and 2");
  CHECK(keys::number().inside(-1, 0.5).range_words() == "between -1 and 0.5, both excluded");
  CHECK(keys::number().positive().at_most(1).range_words() == "greater than 0 and at most 1");
  KeyForm below = keys::number().between(0, 1);
  below.below = true;
  CHECK(below.range_words() == "of at least 0 and less than 1");
  below = keys::number().at_most(1);
  below.below = true;
  CHECK(below.range_words() == "less than 1");
  CHECK_FALSE(below.in_range(1));
  CHECK(below.in_range(0.999));
}

TEST_CASE("Numbers out of range are refused, also with units and from formulas") {
  CHECK(why_number("damping", "-1") == "a.yaml:1: hinge.damping: expected a number of at least 0, found -1");
  CHECK(why_number("damping", "1 - 3") == "a.yaml:1: hinge.damping: expected a number of at least 0, found -2");
  CHECK(why_number("damping", "-5 N mm s/rad") ==
        "a.yaml:1: hinge.damping: expected a number of at least 0, found -0.005");
  CHECK_THAT(why_number("inside", "1"), Contains("expected a number between -1 and 1, both excluded, found 1"));
  CHECK_THAT(why_number("inside", "2000 mm"), Contains("expected a number between -1 and 1, both excluded, found 2"));
  CHECK(hinge("inside: 999 mm").at("inside").number() == Approx(0.999));
  CHECK_THAT(why_number("most", "3.5"), Contains("expected a number of at most 3, found 3.5"));
  CHECK(hinge("most: 3").at("most").number() == 3);
  CHECK_THAT(why_number("least", "1"), Contains("expected a number of at least 2, found 1"));
  const auto count = [](const YamlValue& entry) { entry.at("count").integer(); };
  CHECK_THAT(why("count: 5", count), Contains("expected a number between 1 and 4, found 5"));
  CHECK_THAT(why("count: 1.5", count), Contains("expected a whole number, found 1.5"));
  CHECK_THAT(why("count: 2 mm", count), Contains("expected a number without a unit, found the unit 'mm'"));
}

TEST_CASE("Units are those of the table") {
  CHECK(hinge("angle: 90 deg").at("angle").number() == Approx(std::acos(0.0)));
  CHECK(hinge("inside: 12 mm").at("inside").number() == Approx(0.012));
  CHECK(why_number("angle", "12 mm") ==
        "a.yaml:1: hinge.angle: expected a value in rad, found one in 'mm', which measures something else");
  CHECK_THAT(message_of<InputError>([] { YamlValue::parse("a: 5 mm", "a.yaml").at("a").number(); }),
             Contains("expected a number without a unit, found the unit 'mm'"));
}

TEST_CASE("Formulas of t take quantities, and are in range if they are constant") {
  CHECK(hinge("spin: 90 deg").at("spin").expression()(0.0) == Approx(std::acos(0.0)));
  CHECK(hinge("spin: 2 * t").at("spin").expression()(3.0) == 6);
  CHECK(hinge("spin: 3 - t").at("spin").expression()(1.0) == 2);
  CHECK_THAT(why("spin: 3 kg", [](const YamlValue& entry) { entry.at("spin").expression(); }),
             Contains("expected a value in rad, found one in 'kg'"));
  const auto push = [](const YamlValue& entry) { entry.at("push").expression(); };
  CHECK_THAT(why("push: 2 kN", push), Contains("expected a number of at most 1000, found 2000"));
  CHECK_THAT(why("push: 2000", push), Contains("expected a number of at most 1000, found 2000"));
  CHECK(hinge("push: 1 kN").at("push").formula_text({"e", "t"}, {}).replaced == "1000");
  CHECK(hinge("push: 2000 * e").at("push").expression().is_constant() == false);
}

TEST_CASE("A word is one of those of the table") {
  CHECK(hinge("kind: wet").at("kind").word() == "wet");
  CHECK(why("kind: wett", [](const YamlValue& entry) { entry.at("kind").word(); }) ==
        "a.yaml:1: hinge.kind: 'wett' is not a kind of friction; did you mean 'wet'?");
}

TEST_CASE("A nested table is bound when its map is read") {
  const YamlValue friction = hinge("friction: {radius: 12 mm}").at("friction");
  CHECK(friction.at("radius").number() == Approx(0.012));
  CHECK(friction.at("coefficient").number() == 0.1);
  CHECK(why("friction: {radus: 1}", [](const YamlValue& entry) { entry.at("friction"); }) ==
        "a.yaml:1: hinge.friction: 'radus' is not a key of the friction; did you mean 'radius'?");
  CHECK(why("friction: {radius: 0}", [](const YamlValue& e) { e.at("friction").at("radius").number(); }) ==
        "a.yaml:1: hinge.friction.radius: expected a number greater than 0, found 0");
  CHECK(why("friction: 5", [](const YamlValue& entry) { entry.at("friction").find("radius"); }) ==
        "a.yaml:1: hinge.friction: expected the friction as keys with values (`friction: {radius: 5}`)");
  CHECK(why("friction: 5", [](const YamlValue& entry) { entry.at("friction").has("radius"); }) ==
        "a.yaml:1: hinge.friction: expected the friction as keys with values (`friction: {radius: 5}`)");
}

TEST_CASE("The message about a number in place of a map suggests the only required key that it fits") {
  const auto find = [](const YamlValue& entry) { entry.at("friction").find("radius"); };
  CHECK(why("friction: 0.5", find) ==
        "a.yaml:1: hinge.friction: expected the friction as keys with values (`friction: {radius: 0.5}`)");
  CHECK(why("friction: dry", find) ==
        "a.yaml:1: hinge.friction: expected the friction as keys with values (`key: value`)");
  CHECK(why("friction: [0.5]", find) ==
        "a.yaml:1: hinge.friction: expected the friction as keys with values (`key: value`)");
  // A cylinder has two required keys.
  CHECK_THAT(message_of<InputError>([] { YamlValue::parse("a: 1", "a.yaml").at("a").keyed(cylinder_keys()); }),
             Contains("expected a cylinder as keys with values (`key: value`)"));
}

TEST_CASE("A number or a table: each has its own form") {
  CHECK(hinge("drag: 2 kN").at("drag").number() == 2000);
  CHECK_THAT(why_number("drag", "-2"), Contains("expected a number greater than 0, found -2"));
  CHECK(hinge("drag: {radius: 1}").at("drag").at("coefficient").number() == 0.1);
}

TEST_CASE("If there are several tables, the reader binds the one that it chooses") {
  const YamlValue either = hinge("either: {cylinder: 1 mm, length: 2}").at("either");
  CHECK(either.keyed(cylinder_keys()).at("cylinder").number() == Approx(1e-3));
  CHECK_THAT(message_of<InputError>([&] { either.keyed(friction_keys()); }),
             Contains("'cylinder' is not a key of the friction"));
  CHECK_THAT(message_of<InputError>([&] { either.at("cylinder").number(); }),
             Contains("expected a number without a unit"));  // unbound
}

TEST_CASE("Keys without a value are empty maps") {
  const YamlValue friction = hinge("friction: ").at("friction");
  CHECK(friction.is_null());
  CHECK(friction.at("coefficient").number() == 0.1);
  CHECK_FALSE(friction.find("radius"));
  CHECK_THAT(message_of<InputError>([&] { friction.at("radius"); }), Contains("the key 'radius' is missing"));
  CHECK_THROWS_AS(friction.at("mass"), std::logic_error);
  CHECK(hinge("table: ~").at("table").is_null());
  CHECK(hinge("friction: ~").at("friction").entries().empty());
  CHECK_THAT(why("damping: ", [](const YamlValue& entry) { entry.at("damping").number(); }),
             Contains("expected a number, found nothing"));
}

TEST_CASE("Variants are chosen by a key that is present") {
  const YamlValue shape = hinge("shape: {cylinder: 3 mm, length: 1 in}").at("shape");
  CHECK(shape.at("length").number() == Approx(0.0254));
  CHECK(why("shape: {cylinder: 3, lenght: 1}", [](const YamlValue& entry) { entry.at("shape"); }) ==
        "a.yaml:1: hinge.shape: 'lenght' is not a key of a cylinder; did you mean 'length'?");
  CHECK_THROWS_AS(shape.at("size"), std::logic_error);
}

TEST_CASE("Variants are chosen by the value of a key; other values have the keys of the table itself") {
  CHECK(hinge("shape: {shape: ball, radius: 2 mm}").at("shape").at("radius").number() == Approx(2e-3));
  CHECK_THAT(why("shape: {shape: ball, size: 1}", [](const YamlValue& entry) { entry.at("shape"); }),
             Contains("'size' is not a key of a ball"));
  CHECK(hinge("shape: {shape: cube, size: 3}").at("shape").at("size").number() == 3);
  // The reader of the map has a better message for a value that is none of the variants.
  CHECK(hinge("shape: {shape: cube, radius: 2}").at("shape").at("shape").text() == "cube");
}

TEST_CASE("A misspelt key that selects a variant is explained") {
  CHECK_THAT(why("shape: {cilinder: 3, length: 1}", [](const YamlValue& entry) { entry.at("shape"); }),
             Contains("'cilinder' is not a key of a shape; did you mean 'cylinder'?"));
}

TEST_CASE("Items of lists have the forms of the list") {
  const std::vector<YamlValue> shapes = hinge("shapes: [5 mm, {cylinder: 3, length: 1}]").at("shapes").items();
  CHECK(shapes[0].number() == Approx(5e-3));
  CHECK(shapes[1].at("length").number() == 1);
  CHECK(shapes[1].path() == "hinge.shapes[2]");
  CHECK_THAT(why("shapes: [{cylinder: 3, lenth: 1}]", [](const YamlValue& entry) { entry.at("shapes").items(); }),
             Contains("hinge.shapes[1]: 'lenth' is not a key of a cylinder"));
  CHECK(hinge("axis: [0, 0, 5]").at("axis").vector3() == Eigen::Vector3d(0, 0, 5));
}

TEST_CASE("Matrices have the unit of the table") {
  CHECK(hinge("matrix: [[2 N/mm, 0], [0, 1]]").at("matrix").matrix(2, 2)(0, 0) == Approx(2000));
  CHECK_THAT(why("matrix: [[2 kg, 0], [0, 1]]", [](const YamlValue& entry) { entry.at("matrix").matrix(2, 2); }),
             Contains("hinge.matrix[1][1]: expected a value in N/m, found one in 'kg'"));
}

TEST_CASE("Each item of a tuple has its own form, and items beyond it the form of the last") {
  const YamlValue pair = hinge("pair: [3 mm, 180 deg]").at("pair");
  CHECK(pair.at(0).number() == Approx(3e-3));
  CHECK(pair.at(1).number() == Approx(std::acos(-1.0)));
  CHECK_THAT(why("pair: [0, 1]", [](const YamlValue& entry) { entry.at("pair").at(0).number(); }),
             Contains("hinge.pair[1]: expected a number greater than 0, found 0"));
  CHECK_THAT(why("pair: [1, 3 mm]", [](const YamlValue& entry) { entry.at("pair").at(1).number(); }),
             Contains("expected a value in rad, found one in 'mm'"));
  const YamlValue longer = hinge("pair: [3 mm, 180 deg, 90 deg]").at("pair");
  CHECK(longer.size() == 3);
  CHECK(longer.at(2).number() == Approx(std::acos(0.0)));
  CHECK_THAT(message_of<InputError>([&] { pair.at(2); }), Contains("expected at least 3 items, found 2"));
}

TEST_CASE("Entries have keys that the user chooses, and values of one form") {
  const auto springs = hinge("springs: {left: 2 N/mm, right: 3}").at("springs").entries();
  REQUIRE(springs.size() == 2);
  CHECK(springs[0].first == "left");
  CHECK(springs[0].second.number() == Approx(2000));
  CHECK(springs[1].second.number() == 3);
  CHECK(hinge("springs: {left: 2 N/mm}").at("springs").at("left").number() == Approx(2000));
  CHECK_THAT(why("springs: {left: 0}", [](const YamlValue& entry) { entry.at("springs").at("left").number(); }),
             Contains("hinge.springs.left: expected a number greater than 0, found 0"));
  CHECK_THAT(why("springs: {left: 2}", [](const YamlValue& entry) { entry.at("springs").at("right"); }),
             Contains("hinge.springs: the key 'right' is missing"));
  CHECK_THAT(why("hinges: {a: {radus: 1}}", [](const YamlValue& entry) { entry.at("hinges").entries(); }),
             Contains("hinge.hinges.a: 'radus' is not a key of the friction"));
  CHECK(hinge("hinges: {a: }").at("hinges").at("a").at("coefficient").number() == 0.1);
  CHECK(hinge("sizes: {a: 3 mm, b: 2 kN}").at("sizes").at("b").number() == 2000);
}

TEST_CASE("Values that do not have the expected form are refused") {
  CHECK_THAT(why("axis: 3", [](const YamlValue& entry) { entry.at("axis").vector3(); }),
             Contains("hinge.axis: expected a list of three numbers"));
  CHECK_THAT(why_number("damping", "[1]"), Contains("hinge.damping: expected a number"));
  CHECK_THAT(why_number("damping", "{a: 1}"), Contains("hinge.damping: expected a number"));
  CHECK_THAT(why_number("damping", "stiff"), Contains("hinge.damping: "));
  CHECK_THAT(why("kind: [dry]", [](const YamlValue& entry) { entry.at("kind").word(); }),
             Contains("hinge.kind: expected a kind of friction as one word"));
  CHECK_THAT(why("springs: 3", [](const YamlValue& entry) { entry.at("springs").entries(); }),
             Contains("hinge.springs: expected keys with values"));
  CHECK_THAT(why("pair: 3", [](const YamlValue& entry) { entry.at("pair").items(); }),
             Contains("hinge.pair: expected a list"));
}

TEST_CASE("Tables list their names, and joined groups of keys keep their order") {
  CHECK(friction_keys().names() == std::vector<std::string>{"coefficient", "radius"});
  CHECK(friction_keys().find("radius")->presence.required);
  CHECK_FALSE(friction_keys().find("mass"));
  CHECK(keys::names_of(keys::joined({friction_keys().keys, cylinder_keys().keys})) ==
        std::vector<std::string>{"coefficient", "radius", "cylinder", "length"});
}

}  // namespace test_key_table

TEST_CASE("The keys of a table are found by its name, with blanks or underscores, or by words of the name") {
  using namespace keys;
  const auto table_named = [](const char* of, const char* about) {
    return KeyTable{of, about, {{"size", number("m"), required, ""}}};
  };
  static const KeyTable mass = table_named("a point_mass", "Mass without tapered edges, not a sampled one."),
                        state = table_named("a sampled state", "About."),
                        delay = table_named("a delayed state", "About.");
  static const auto mass_keys = []() -> const KeyTable& { return mass; };
  static const auto state_keys = []() -> const KeyTable& { return state; };
  static const auto delay_keys = []() -> const KeyTable& { return delay; };
  const KeyTable root{"everything",
                      "About.",
                      {{"mass", nested(mass_keys), optional, ""},
                       {"sampled", nested(state_keys), optional, ""},
                       {"delayed", nested(delay_keys), optional, ""}}};
  const auto headings = [&](const std::string& name) {
    const std::string text = keys_of_named(root, name);
    std::string found;
    for (const char* each : {"point_mass", "sampled state", "delayed state"})
      if (text.find(each) != std::string::npos) found += std::string(found.empty() ? "" : ", ") + each;
    return found;
  };
  CHECK(headings("point mass") == "point_mass");
  CHECK(headings("point_mass") == "point_mass");
  CHECK(headings("sampled") == "sampled state");
  CHECK(headings("state") == "sampled state, delayed state");
  CHECK(headings("tapered") == "point_mass");  // found by a word of its sentence, which counts if no name contains it
  CHECK_THAT(message_of<InputError>([&] { keys_of_named(root, "sample"); }),
             Contains("; expected 'sampled state'; `--keys all`"));
  CHECK_THAT(message_of<InputError>([&] { keys_of_named(root, "tate"); }),
             Contains("; expected one of 'delayed state', 'sampled state'"));
  CHECK_THAT(message_of<InputError>([&] { keys_of_named(root, "pont_mass"); }),
             Contains("; did you mean 'point_mass'?"));
  CHECK(keys_of_named(root, "mass").starts_with("'mass'; here it is called 'point_mass'\n\npoint_mass\n"));
  CHECK(message_of<InputError>([&] { keys_of_named(root, "frobnicate"); }) ==
        "--keys frobnicate: nothing has this name; `--keys all` prints all names with their keys");
}

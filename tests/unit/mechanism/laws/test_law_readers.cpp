// Keys of laws: values with units, and refusals of units that do not fit.
#include <catch2/catch.hpp>

#include "mechanism/laws/friction_law.hpp"
#include "mechanism/laws/normal_law.hpp"
#include "mechanism/laws/read_elastic_law.hpp"
#include "tests/support/messages.hpp"

using namespace bielle::mechanism;
using bielle::InputError;
using bielle::KeyTable;
using bielle::YamlValue;
using bielle::test::message_of;
using Catch::Contains;
using Catch::WithinRel;

namespace {

FrictionLaw friction(const std::string& text) {
  static const KeyTable table{"friction", "Friction.", keys_of_friction_law({"coulomb", "lugre"})};
  return read_friction_law(YamlValue::parse(text, "law.yaml").keyed(table));
}

NormalLaw normal(const std::string& text) {
  static const KeyTable table{"a contact", "A contact.", keys_of_normal_law()};
  return read_normal_law(YamlValue::parse(text, "law.yaml").keyed(table));
}

ElasticLaw elastic(const std::string& text) {
  static const KeyTable table{"a bushing", "A bushing.", keys_of_elastic_law()};
  ElasticLaw law({"x", "y", "z", "rx", "ry", "rz"}, {false, false, false, true, true, true});
  read_elastic_law(YamlValue::parse(text, "law.yaml").keyed(table), law);
  return law;
}

template <class Read>
std::string refusal(const Read& read, const std::string& text) {
  return message_of<InputError>([&] { read(text); });
}

}  // namespace

TEST_CASE("values of laws may have units, which must fit") {
  const FrictionLaw law = friction("{coefficient: 0.1, static: 0.2, stribeck_velocity: 3 m/min, viscous: 2 s/km}");
  CHECK_THAT(law.sticking, WithinRel(0.2, 1e-14));
  CHECK_THAT(law.stribeck_velocity, WithinRel(0.05, 1e-14));
  CHECK_THAT(law.viscous, WithinRel(0.002, 1e-14));
  CHECK_THAT(law.velocity, WithinRel(0.005, 1e-14));
  CHECK_THAT(normal("{stiffness: 1e9, damping: 5 ms/m}").damping, WithinRel(0.005, 1e-14));
  const ElasticLaw bush = elastic(
      "{stiffness: [1 kN/mm, 2, 3, 4 N m/deg, 5, 6], damping: 2 ms, preload: [0, 0, 1 kN, 0, 0, 0], "
      "maxwell: [{factor: 0.5, time: 10 ms}]}");
  CHECK_THAT(bush.K(0, 0), WithinRel(1e6, 1e-14));
  CHECK_THAT(bush.K(3, 3), WithinRel(4 * 180 / M_PI, 1e-14));
  CHECK_THAT(bush.D(1, 1), WithinRel(0.004, 1e-14));
  CHECK_THAT(bush.preload[2], WithinRel(1000.0, 1e-14));
  CHECK_THAT(bush.branches().at(0).time, WithinRel(0.01, 1e-14));
  CHECK_THAT(refusal(friction, "{coefficient: 0.1, velocity: 1 mm}"),
             Contains("velocity: expected a value in m/s, found one in 'mm'"));
  CHECK_THAT(refusal(normal, "{stiffness: 1, damping: 1 N}"),
             Contains("damping: expected a value in s/m, found one in 'N'"));
  CHECK_THAT(refusal(elastic, "stiffness: [1 N m, 2, 3, 4, 5, 6]"),
             Contains("stiffness[1]: expected a value in N/m, found one in 'N m'"));
  CHECK_THAT(refusal(elastic, "stiffness: [1, 2, 3, 4 N m, 5, 6]"),
             Contains("stiffness[4]: expected a value in N m/rad, found one in 'N m'"));
}

TEST_CASE("values of laws out of range are refused") {
  CHECK_THAT(refusal(friction, "coefficient: -1"), Contains("coefficient: expected a number of at least 0, found -1"));
  CHECK_THAT(refusal(friction, "{coefficient: 0.1, velocity: 0}"), Contains("greater than 0"));
  CHECK_THAT(refusal(friction, "{coefficient: 0.1, modl: lugre}"), Contains("did you mean 'model'"));
  CHECK_THAT(refusal(normal, "{stiffness: 1, restitution: 1.1}"), Contains("greater than 0 and at most 1"));
  CHECK_THAT(refusal(normal, "{stiffness: 1, exponent: 0.9}"), Contains("of at least 1"));
  CHECK_THAT(refusal(elastic, "{stiffness: [1, 1, 1, 1, 1, 1], maxwell: [{factor: 0.5, tme: 1}]}"),
             Contains("'tme' is not a key of a branch"));
}

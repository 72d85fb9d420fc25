#include "mechanism/joints/couplings/coupling_reader.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mechanism/joints/couplings/elastic_coupling.hpp"
#include "mechanism/joints/couplings/linear_coupling.hpp"
#include "mechanism/reading/names.hpp"
#include "mechanism/reading/read_numbers.hpp"
#include "reduce/common/input/plausible.hpp"

namespace bielle::mechanism {
namespace {

using Kind = JointCoordinate::Kind;

/// @param deformation  the coordinate at which the deformation is measured: "at the rack"
std::vector<Key> elastic_keys(const std::string& deformation, const std::string& unit, const std::string& stiffness,
                              const std::string& damping) {
  using namespace keys;
  return {{"stiffness", number(stiffness).positive(), optional,
           "Stiffness of the coupling, measured " + deformation + "; without it the coupling is rigid."},
          {"damping", number(damping).non_negative(), otherwise("0"),
           "Damping of an elastic coupling, while its flanks touch."},
          {"backlash", number(unit).non_negative(), otherwise("0"),
           "Play of an elastic coupling from flank to flank, measured " + deformation +
               "; the model is drawn in its middle."}};
}

constexpr PlausibleRange plausible_play{0, 0.5, "Gears have a play of 1e-4 to 1e-2 rad, or 1e-5 to 1e-3 m"};

CoordinateCoupling& add_coupling(const char* type, const std::string& name, const YamlValue& entry, Model& model) {
  std::unique_ptr<CoordinateCoupling> made;
  if (const auto stiffness = entry.find("stiffness")) {
    if (const auto backlash = entry.find("backlash")) warn_outside(*backlash, backlash->number(), plausible_play);
    made = std::make_unique<ElasticCoupling>(
        type, name,
        ElasticCoupling::Law{stiffness->number(), entry.at("damping").number(), entry.at("backlash").number()});
  } else {
    for (const char* key : {"damping", "backlash"})
      if (const auto given = entry.find(key))
        given->fail("belongs to an elastic coupling: give its `stiffness` as well");
    made = std::make_unique<LinearCoupling>(type, name);
  }
  CoordinateCoupling& coupling = *made;
  model.add(std::move(made), Entry{Section::joints, name});
  return coupling;
}

YamlValue joints_of(const YamlValue& entry, std::size_t count, const char* expected) {
  YamlValue joints = entry.at("joints");
  if (!joints.is_sequence() || joints.size() != count) joints.fail(fmt::format("expected {}", expected));
  return joints;
}

/// Looks up the coordinates of a coupling after all joints have been read.
void connect_later(CoordinateCoupling& coupling, const YamlValue& joints, std::vector<double> factors,
                   std::vector<std::optional<Kind>> kinds, Model& model) {
  model.when_read(Model::Stage::connections, [&coupling, joints, factors, kinds, &model] {
    std::vector<NamedCoordinate> named;
    for (std::size_t k = 0; k < factors.size(); ++k) {
      const NamedCoordinate each = coordinate_named_by(joints.at(k), model, kinds[k]);
      for (const NamedCoordinate& before : named)
        if (before.joint == each.joint && before.index == each.index)
          joints.at(k).fail("is coupled with itself: name each coordinate once");
      named.push_back(each);
      coupling.add_term(each, factors[k]);
    }
  });
}

double other_than_zero(const YamlValue& value) {
  const double number = value.number();
  if (number == 0) value.fail("expected a number other than 0");
  return number;
}

/// Returns the ratio of the second wheel's rate to the first's.
double ratio_of_gear(const YamlValue& entry) {
  if (entry.has("ratio") == entry.has("teeth"))
    entry.fail("a gear takes `ratio` (rate of the second joint over that of the first), or `teeth`, or `factors`");
  if (entry.has("ratio")) {
    if (const auto internal = entry.find("internal"))
      internal->fail("is a key of `teeth`: the sign of `ratio` says it");
    return other_than_zero(entry.at("ratio"));
  }
  const Eigen::VectorXd teeth = read_numbers(entry.at("teeth"), 2, "[teeth of the first wheel, of the second]");
  return (entry.at("internal").boolean() ? 1 : -1) * teeth[0] / teeth[1];
}

}  // namespace

const KeyTable& gear_keys() {
  using namespace keys;
  static const KeyTable table{
      "a gear", "Coordinates of joints in a fixed ratio.",
      joined({{type_key(),
               {"joints", list_of(coordinate_forms()).items_at_least(2), required,
                "Coordinates that are coupled: angles of two joints; with `factors` any coordinates."},
               {"ratio", number(), optional,
                "Rate of the second coordinate over that of the first, with its sign; not 0."},
               {"teeth", list_of(2, number().positive()), optional,
                "Numbers of teeth of two wheels, in place of `ratio`."},
               {"internal", boolean(), otherwise("false"), "Whether one of two wheels with `teeth` is a ring."},
               {"factors", list_of(number("any")).items_at_least(2), optional,
                "Factors of the coordinates, in place of `ratio`: the sum of factor times coordinate is zero."}},
              elastic_keys("as an angle of the second joint (with `factors`, as their sum)", "rad or m",
                           "N m/rad or N/m", "N m s/rad or N s/m")})};
  return table;
}

const KeyTable& differential_keys() {
  using namespace keys;
  static const KeyTable table{
      "a differential", "Angles of an input shaft and of two others that share its motion.",
      joined(
          {{type_key(),
            {"joints", list_of(3, coordinate_forms()), required, "Angles of the input, the left and the right shaft."},
            {"ratio", number(), otherwise("1"), "Rate of the input over the mean of the other two; not 0."}},
           elastic_keys("as an angle of the input", "rad", "N m/rad", "N m s/rad")})};
  return table;
}

const KeyTable& rack_and_pinion_keys() {
  using namespace keys;
  static const KeyTable table{
      "a rack and pinion", "A displacement that is a radius times an angle.",
      joined(
          {{type_key(),
            {"joints", list_of(2, coordinate_forms()), required, "Angle of the pinion and displacement of the rack."},
            {"radius", number("m"), required, "Displacement of the rack over the angle of the pinion; not 0."}},
           elastic_keys("as a displacement of the rack", "m", "N/m", "N s/m")})};
  return table;
}

void read_gear(const std::string& name, const YamlValue& entry, Model& model) {
  CoordinateCoupling& coupling = add_coupling("gear", name, entry, model);
  if (const auto given = entry.find("factors")) {
    for (const char* other : {"ratio", "teeth", "internal"})
      if (const auto too_much = entry.find(other)) too_much->fail("a gear has either `factors` or a ratio");
    const std::vector<YamlValue> items = given->items();
    if (items.size() < 2) given->fail("expected the factors of two or more coordinates, in the order of `joints`");
    std::vector<double> factors;
    for (const YamlValue& item : items) factors.push_back(other_than_zero(item));
    const YamlValue joints = joints_of(entry, items.size(), "as many coordinates of joints as `factors`");
    connect_later(coupling, joints, factors, std::vector<std::optional<Kind>>(items.size()), model);
    return;
  }
  const double ratio = ratio_of_gear(entry);
  connect_later(coupling, joints_of(entry, 2, "two joints (for more, give `factors`)"), {-ratio, 1},
                {Kind::angle, Kind::angle}, model);
}

void read_differential(const std::string& name, const YamlValue& entry, Model& model) {
  const double ratio = other_than_zero(entry.at("ratio"));
  connect_later(add_coupling("differential", name, entry, model),
                joints_of(entry, 3, "three joints: [input, left, right]"), {1, -ratio / 2, -ratio / 2},
                {Kind::angle, Kind::angle, Kind::angle}, model);
}

void read_rack_and_pinion(const std::string& name, const YamlValue& entry, Model& model) {
  const double radius = other_than_zero(entry.at("radius"));
  const YamlValue joints = joints_of(entry, 2, "two joints: [pinion, rack]");
  connect_later(add_coupling("rack_and_pinion", name, entry, model), joints, {-radius, 1},
                {Kind::angle, Kind::displacement}, model);
  model.when_read(Model::Stage::connections, [name, joints, radius, &model] {
    const JointFrames& pinion = coordinate_named_by(joints.at(0), model, Kind::angle).joint->frames();
    model.add_shape({Section::joints, name}, {.shape = "gear",
                                              .places = {{pinion.second, pinion.on_second}},
                                              .values = {{"radius", std::abs(radius)}, {"inner", false}}});
  });
}

}  // namespace bielle::mechanism

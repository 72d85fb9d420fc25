#include "mechanism/joints/flexible/bearing.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include <fmt/format.h>

#include "mechanism/joints/actions/joint_actions.hpp"
#include "mechanism/measures/middle_frame.hpp"

namespace bielle::mechanism {
namespace {

constexpr int bearing_x = 0, bearing_y = 1, bearing_z = 2;

std::vector<JointCoordinate> bearing_coordinates() {
  using Kind = JointCoordinate::Kind;
  return {{"x", Kind::displacement, bearing_x},
          {"y", Kind::displacement, bearing_y},
          {"z", Kind::displacement, bearing_z},
          {"tilt_x", Kind::rotation, JointCoordinate::by_type},
          {"tilt_y", Kind::rotation, JointCoordinate::by_type},
          {"angle", Kind::angle, bearing_z}};
}

/// theta/sin(theta) with its first two derivatives by c = cos(theta), -1 < c <= 1.
struct TiltFactor {
  double f, f1, f2;
  explicit TiltFactor(double c) {
    // f solves (1 - c^2) f' = c f - 1; near c = 1 the series in s = 1 - c:  sum of a_k s^k, a_k = a_(k-1) k/(2k + 1).
    const double s = 1 - c;
    if (s < 0.05) {
      double a = 1, power = 1;  // a_k, s^k
      f = 1;
      f1 = f2 = 0;
      double power_1 = 1, power_2 = 1;  // s^(k-1), s^(k-2)
      for (int k = 1; k < 16; ++k) {
        a *= k / (2.0 * k + 1);
        power *= s;
        f += a * power;
        f1 -= k * a * power_1;
        if (k > 1) {
          f2 += k * (k - 1) * a * power_2;
          power_2 *= s;
        }
        power_1 *= s;
      }
      return;
    }
    const double w = 1 - c * c;
    f = std::acos(c) / std::sqrt(w);
    f1 = (c * f - 1) / w;
    f2 = (f + 3 * c * f1) / w;
  }
};

}  // namespace

Bearing::Bearing(std::string name, JointFrames frames, const Model& model)
    : ElasticPair("bearing", std::move(name), std::move(frames), bearing_coordinates(),
                  ElasticLaw({"x", "y", "z", "tilt_x", "tilt_y"}, {false, false, false, true, true}), model) {}

void Bearing::calc_measures(const LocalState& state, ElasticLaw::Measures& measures, bool /*second*/) const {
  for (const int axis : {bearing_x, bearing_y, bearing_z})
    measures[static_cast<std::size_t>(axis)] = position(axis, state);
  const auto shaft_along = [&](int axis) {
    return measure_alignment(state.node(0), state.node(1), frames().on_first.R.col(axis),
                             frames().on_second.R.col(bearing_z));
  };
  PairMeasure c = shaft_along(bearing_z);
  const TiltFactor tilt(std::min(1.0, c.value));
  const PairMeasure factor = compose(c, tilt.f, tilt.f1, tilt.f2);
  measures[3] = -(factor * shaft_along(bearing_y));
  measures[4] = factor * shaft_along(bearing_x);
}

void Bearing::accept(const LocalState& state, Eigen::Ref<VectorX> memory) const {
  Joint::accept(state, memory);
  ElasticLaw::Measures measures;
  calc_measures(state, measures, false);
  constexpr int tilt_x = 3, tilt_y = 4, entry = 2;  // the memory holds [value, rate] of each coordinate
  const Vector3 tilt(measures[tilt_x].value, measures[tilt_y].value, 0),
      before(memory[entry * tilt_x], memory[entry * tilt_y], 0);
  check_half_turn(state, fmt::format("bearing '{}'", name()), tilt, before,
                  "What is to tilt freely is a `spherical` joint, or a `bushing` without stiffness of rotations");
  memory[entry * tilt_x] = tilt.x();
  memory[entry * tilt_y] = tilt.y();
}

namespace {

/// Returns the table of one direction, or of two that may differ: a number is valid for both.
KeyTable direction_table(const char* stiffness_unit, const char* damping_unit, bool two) {
  using namespace keys;
  const auto forms = [&](const char* unit) {
    const KeyForm one = number(unit).non_negative();
    return two ? KeyForms{one, list_of(2, one)} : KeyForms{one};
  };
  return {"a direction of a bearing",
          "Stiffness and damping of a bearing in one direction.",
          {{"stiffness", forms(stiffness_unit), otherwise("0"), "Stiffness."},
           {"damping", forms(damping_unit), otherwise("0"), "Damping."}}};
}

const KeyTable& radial_keys() {
  static const KeyTable table = direction_table("N/m", "N s/m", true);
  return table;
}

const KeyTable& axial_keys() {
  static const KeyTable table = direction_table("N/m", "N s/m", false);
  return table;
}

const KeyTable& tilting_keys() {
  static const KeyTable table = direction_table("N m/rad", "N m s/rad", true);
  return table;
}

/// Reads `{stiffness, damping}` or only the stiffness, for one direction or for two equal ones.
void read_bearing_part(const YamlValue& entry, const char* key, std::span<const int> directions, ElasticLaw& law) {
  const auto value = entry.find(key);
  if (!value) return;
  const auto read = [&](const YamlValue& given, Matrix6& A) {
    if (given.is_sequence()) {
      const Eigen::VectorXd numbers = given.vector();
      if (directions.size() != 2 || numbers.size() != 2)
        given.fail(directions.size() == 2 ? "expected a number, or two: along x and y of the housing"
                                          : "expected a number");
      for (std::size_t k = 0; k < 2; ++k) A(directions[k], directions[k]) = numbers[static_cast<Eigen::Index>(k)];
      return;
    }
    for (const int k : directions) A(k, k) = given.number();
  };
  if (!value->is_map()) {
    read(*value, law.K);
    return;
  }
  if (!value->has("stiffness") && !value->has("damping")) value->fail("expected `stiffness` or `damping`");
  read(value->at("stiffness"), law.K);
  read(value->at("damping"), law.D);
}

}  // namespace

const KeyTable& bearing_keys() {
  using namespace keys;
  static const KeyTable table = [] {
    const KeyForm force = number("N/m").non_negative(), moment = number("N m/rad").non_negative();
    return KeyTable{
        "a bearing", "An elastic hinge, whose shaft turns freely.",
        joined({joint_frame_keys(AxisNeed::required),
                {{"radial",
                  {force, list_of(2, force), nested(radial_keys)},
                  required,
                  "Radial stiffness, one number or two along x and y of the housing; or stiffness and damping."},
                 {"axial", {force, nested(axial_keys)}, otherwise("0"), "Axial stiffness; or stiffness and damping."},
                 {"tilting",
                  {moment, list_of(2, moment), nested(tilting_keys)},
                  otherwise("0"),
                  "Stiffness against tilting, one number or two about x and y of the housing; or stiffness and "
                  "damping."}},
                joint_action_keys(Moves::both)})};
  }();
  return table;
}

void read_bearing(const std::string& name, const YamlValue& entry, Model& model) {
  auto made = std::make_unique<Bearing>(name, read_joint_frames(entry, model, AxisNeed::required), model);
  constexpr int radial[] = {0, 1}, axial[] = {2}, tilting[] = {3, 4};
  if (!entry.has("radial")) entry.fail("a bearing needs its `radial` stiffness [N/m]");
  read_bearing_part(entry, "radial", radial, made->law());
  read_bearing_part(entry, "axial", axial, made->law());
  read_bearing_part(entry, "tilting", tilting, made->law());
  Bearing& bearing = *made;
  model.add(std::move(made), Entry{Section::joints, name});
  read_joint_actions(entry, bearing, model);
}

}  // namespace bielle::mechanism

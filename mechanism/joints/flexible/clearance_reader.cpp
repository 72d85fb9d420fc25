// Readers of `clearance_hinge` and `clearance_spherical`.
//
// Stiffness from the materials, E* = 1/((1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2):
//   ball of radius r in a socket of radius r + gap   F = 4/3 E* sqrt(r (r + gap)/gap) p^1.5 (Hertz) cylinder along a
//   length l                        F = pi/4 E* l p
// References: K. L. Johnson, Contact Mechanics (Cambridge, 1985), chapter 4; V. L. Popov, Contact Mechanics and
// Friction (Springer, 2010), chapter 5; H. M. Lankarani, P. E. Nikravesh, J. Mech. Design 112 (1990) 369, for spheres
// in sockets. Both are valid if the contact is small relative to the radius: gaps must not be small relative to the
// penetration.
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "mechanism/joints/actions/joint_actions.hpp"
#include "mechanism/joints/flexible/clearance_joint.hpp"

namespace bielle::mechanism {
namespace {

const KeyTable& clearance_friction_keys() {
  static const KeyTable table{"friction in a clearance",
                              "Friction of the surfaces that touch, at the journal's `radius`.",
                              keys_of_friction_law({"coulomb", "lugre"})};
  return table;
}

const KeyTable& clearance_contact_keys() {
  static const KeyTable table{"a contact", "Normal force of the surfaces that touch.", keys_of_normal_law()};
  return table;
}

/// Returns the keys of a contact whose stiffness may follow from the materials.
const KeyTable& contact_of_materials_keys() {
  using namespace keys;
  static const KeyTable table = [] {
    const KeyForm modulus = number("Pa").positive();
    KeyForm ratio = number().between(-1, 0.5);
    ratio.above = true;
    std::vector<Key> of_normal_law = keys_of_normal_law();
    for (Key& key : of_normal_law) key.presence.required = false;
    return KeyTable{"a contact",
                    "Normal force of the surfaces that touch, by a stiffness or by the materials of both parts.",
                    joined({of_normal_law,
                            {{"young",
                              {modulus, list_of(2, modulus)},
                              optional,
                              "Young's modulus of both parts, or of bush and journal, in place of `stiffness` and "
                              "`exponent`, which then are those of a sphere in a socket (Hertz, n = 1.5), or of a "
                              "cylinder along half the `length` (n = 1)."},
                             {"poisson",
                              {ratio, list_of(2, ratio)},
                              optional,
                              "Poisson's ratio of both parts, or of bush and journal, which `young` needs."}}})};
  }();
  return table;
}

std::vector<Key> clearance_keys(AxisNeed need) {
  using namespace keys;
  return joined({joint_frame_keys(need),
                 {{"radial_gap", number("m").non_negative(), required,
                   "Gap between journal and bush, or ball and socket: half the difference of the diameters. With 0 "
                   "contact begins at the centred position."},
                  {"radius", number("m").non_negative(), otherwise("0"),
                   "Radius of the journal or ball, at which friction acts; with 0 friction has no moment."},
                  {"contact", nested(contact_of_materials_keys), required, "Contact of the surfaces."},
                  {"friction", nested(clearance_friction_keys), optional, "Friction of the surfaces."}},
                 joint_action_keys(Moves::both, {"friction"})});
}

/// Reads a number for both parts, or one for each.
std::array<double, 2> read_of_both(const YamlValue& value, const char* expected) {
  if (!value.is_sequence()) return {value.number(), value.number()};
  const Eigen::VectorXd numbers = value.vector();
  if (numbers.size() != 2) value.fail(expected);
  return {numbers[0], numbers[1]};
}

/// Reads the materials of a contact, and returns E*.
double read_contact_modulus(const YamlValue& contact) {
  const YamlValue young = contact.at("young"), poisson = contact.at("poisson");
  const auto E = read_of_both(young, "expected a modulus, or two: of bush and journal"),
             nu = read_of_both(poisson, "expected a ratio, or two: of bush and journal");
  double compliance = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    compliance += (1 - nu[k] * nu[k]) / E[k];
  }
  return 1 / compliance;
}

constexpr double hertzian = 1.5;  ///< exponent

struct MaterialStiffness {
  double per_modulus;  ///< stiffness divided by E* [m^(2 - exponent)]
  double exponent;
};

NormalLaw read_contact_law(const YamlValue& entry, const MaterialStiffness& of_materials) {
  if (!entry.has("young") && !entry.has("poisson")) return read_normal_law(entry);
  for (const char* key : {"stiffness", "exponent"})
    if (const auto given = entry.find(key)) given->fail("follows from `young` and `poisson`");
  return read_normal_law(entry, read_contact_modulus(entry) * of_materials.per_modulus, of_materials.exponent);
}

std::optional<FrictionLaw> read_clearance_friction(const YamlValue& entry) {
  const auto friction = entry.find("friction");
  if (!friction) return std::nullopt;
  if (!entry.has("radius")) friction->fail("surfaces rub at the journal's `radius`, which is missing");
  return read_friction_law(*friction);
}

void add_clearance(std::unique_ptr<ClearanceJoint> made, const YamlValue& entry, Model& model) {
  ClearanceJoint& joint = *made;
  model.add(std::move(made), Entry{Section::joints, joint.name()});
  read_joint_actions(entry, joint, model, {"friction"});
}

using Kind = JointCoordinate::Kind;

}  // namespace

const KeyTable& clearance_hinge_keys() {
  using namespace keys;
  static const KeyTable table{
      "a clearance_hinge", "A journal with play in a bush.",
      joined(
          {clearance_keys(AxisNeed::required),
           {{"length", number("m").non_negative(), otherwise("0"),
             "Length of the journal, which touches the bore at either end; this limits its tilt, and each end has a "
             "contact of its own. With 0 it touches in the middle alone."},
            {"axial_gap", number("m").non_negative(), optional,
             "Axial play of the journal to either side, until its collars touch; without it the journal slides "
             "freely."},
            {"axial_contact", nested(clearance_contact_keys), computed("as `contact`"), "Contact of the collars."}}})};
  return table;
}

const KeyTable& clearance_spherical_keys() {
  static const KeyTable table{"a clearance_spherical joint", "A ball with play in a socket.",
                              clearance_keys(AxisNeed::optional)};
  return table;
}

void read_clearance_hinge(const std::string& name, const YamlValue& entry, Model& model) {
  JointFrames frames = read_joint_frames(entry, model, AxisNeed::required);
  const double gap = entry.at("radial_gap").number(), radius = entry.at("radius").number(),
               l = entry.at("length").number();
  const auto axial_gap = entry.find("axial_gap"), axial_contact = entry.find("axial_contact");
  const YamlValue contact = entry.at("contact");
  if (contact.is_map() && contact.has("young") && l == 0)
    contact.at("young").fail(fmt::format("the stiffness of a cylinder follows from its `length`, which is {}",
                                         entry.has("length") ? "0" : "missing"));
  const NormalLaw law = read_contact_law(contact, {M_PI / 4 * l / 2, 1});
  std::vector<ClearanceJoint::Place> places;
  if (l > 0) {
    places.push_back({"at the end at -z", {ClearancePlace::Kind::bore, gap, -l / 2, 1, radius}, law});
    places.push_back({"at the end at +z", {ClearancePlace::Kind::bore, gap, l / 2, 1, radius}, law});
  } else {
    places.push_back({"in the bore", {ClearancePlace::Kind::bore, gap, 0, 1, radius}, law});
  }
  if (axial_contact && !axial_gap)
    axial_contact->fail("is the contact of collars with an `axial_gap`, which is missing");
  if (axial_gap) {
    const double play = axial_gap->number();
    if (!axial_contact && contact.has("young"))
      axial_gap->fail("give the stiffness of the collars, too: `axial_contact: {stiffness: ..}`");
    const NormalLaw of_faces = axial_contact ? read_normal_law(*axial_contact) : law;
    if (play == 0) {  // only one of the two collars touches at a time, and the stiffness is that of one
      places.push_back({"of the collars", {ClearancePlace::Kind::faces, 0, 0, 1, radius}, of_faces});
    } else {
      places.push_back({"of the collar at -z", {ClearancePlace::Kind::face, play, 0, -1, radius}, of_faces});
      places.push_back({"of the collar at +z", {ClearancePlace::Kind::face, play, 0, 1, radius}, of_faces});
    }
  }
  add_clearance(std::make_unique<ClearanceJoint>("clearance_hinge", name, std::move(frames),
                                                 std::vector<JointCoordinate>{{"x", Kind::displacement, 0},
                                                                              {"y", Kind::displacement, 1},
                                                                              {"z", Kind::displacement, 2},
                                                                              {"angle", Kind::angle, 2}},
                                                 std::move(places), read_clearance_friction(entry), model),
                entry, model);
}

void read_clearance_spherical(const std::string& name, const YamlValue& entry, Model& model) {
  JointFrames frames = read_joint_frames(entry, model, AxisNeed::optional);
  const double gap = entry.at("radial_gap").number(), radius = entry.at("radius").number();
  const YamlValue contact = entry.at("contact");
  if (contact.is_map() && contact.has("young") && radius == 0)
    contact.at("young").fail(fmt::format("the stiffness of a ball follows from its `radius`, which is {}",
                                         entry.has("radius") ? "0" : "missing"));
  if (contact.is_map() && contact.has("young") && gap == 0)
    entry.at("radial_gap")
        .fail("a ball that fills its socket is stiffer than any number: give the contact a `stiffness`");
  const NormalLaw law = read_contact_law(contact, {4.0 / 3 * std::sqrt(radius * (radius + gap) / gap), hertzian});
  add_clearance(
      std::make_unique<ClearanceJoint>(
          "clearance_spherical", name, std::move(frames),
          std::vector<JointCoordinate>{{"x", Kind::displacement, 0},
                                       {"y", Kind::displacement, 1},
                                       {"z", Kind::displacement, 2},
                                       {"rx", Kind::rotation, 0},
                                       {"ry", Kind::rotation, 1},
                                       {"rz", Kind::rotation, 2}},
          std::vector<ClearanceJoint::Place>{{"in the socket", {ClearancePlace::Kind::socket, gap, 0, 1, radius}, law}},
          read_clearance_friction(entry), model),
      entry, model);
}

}  // namespace bielle::mechanism

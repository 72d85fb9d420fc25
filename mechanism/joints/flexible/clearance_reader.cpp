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

/// Reads a number for both parts, or one for each.
std::array<double, 2> read_of_both(const YamlValue& value, const char* expected) {
  if (!value.is_sequence()) return {value.number(), value.number()};
  const Eigen::VectorXd numbers = value.vector();
  if (numbers.size() != 2) value.fail(expected);
  return {numbers[0], numbers[1]};
}

/// E*
double read_contact_modulus(const YamlValue& contact) {
  const YamlValue young = contact.at("young"), poisson = contact.at("poisson");
  const auto E = read_of_both(young, "expected a modulus, or two: of bush and journal"),
             nu = read_of_both(poisson, "expected a ratio, or two: of bush and journal");
  double compliance = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    if (!(E[k] > 0)) young.fail("expected a modulus greater than 0");
    if (!(nu[k] > -1 && nu[k] <= 0.5)) poisson.fail("expected a ratio in (-1, 0.5]");
    compliance += (1 - nu[k] * nu[k]) / E[k];
  }
  return 1 / compliance;
}

struct MaterialStiffness {
  double per_modulus;  ///< stiffness divided by E* [m^(2 - exponent)]
  double exponent;
};

/// @param of_materials  dependence of the stiffness on the materials, if there is one
NormalLaw read_contact_law(const YamlValue& entry, const std::optional<MaterialStiffness>& of_materials,
                           double exponent) {
  std::vector<std::string> keys = normal_law_keys();
  if (of_materials) keys.insert(keys.end(), {"young", "poisson"});
  entry.check_keys(keys, "a contact");
  if (!entry.has("young") && !entry.has("poisson")) return read_normal_law(entry, exponent);
  for (const char* key : {"stiffness", "exponent"})
    if (const auto given = entry.find(key)) given->fail("follows from `young` and `poisson`");
  return read_normal_law(entry, of_materials->exponent, read_contact_modulus(entry) * of_materials->per_modulus);
}

std::optional<FrictionLaw> read_clearance_friction(const YamlValue& entry) {
  const auto friction = entry.find("friction");
  if (!friction) return std::nullopt;
  friction->check_keys(friction_law_keys(), "friction in a clearance");
  if (!entry.has("radius")) friction->fail("surfaces rub at the journal's `radius`, which is missing");
  return read_friction_law(*friction, {"coulomb", "lugre"});
}

double read_radius(const YamlValue& entry) {
  const auto radius = entry.find("radius");
  return radius ? radius->non_negative_number() : 0;
}

void check_clearance_keys(const YamlValue& entry, std::initializer_list<const char*> own, const char* words) {
  std::vector<std::string> keys = joint_frame_keys(), actions = joint_action_keys();
  keys.insert(keys.end(), actions.begin(), actions.end());
  keys.insert(keys.end(), own.begin(), own.end());
  entry.check_keys(keys, words);
}

void add_clearance(std::unique_ptr<ClearanceJoint> made, const YamlValue& entry, Model& model) {
  ClearanceJoint& joint = *made;
  model.add(std::move(made), Entry{Section::joints, joint.name()});
  read_joint_actions(entry, joint, model, {"friction"});
}

using Kind = JointCoordinate::Kind;

}  // namespace

void read_clearance_hinge(const std::string& name, const YamlValue& entry, Model& model) {
  check_clearance_keys(entry, {"radial_gap", "axial_gap", "length", "radius", "contact", "axial_contact", "friction"},
                       "a clearance_hinge");
  JointFrames frames = read_joint_frames(entry, model, AxisNeed::required);
  const double gap = entry.at("radial_gap").non_negative_number(), radius = read_radius(entry);
  const auto length = entry.find("length"), axial_gap = entry.find("axial_gap"),
             axial_contact = entry.find("axial_contact");
  const double l = length ? length->non_negative_number() : 0;
  const YamlValue contact = entry.at("contact");
  if (contact.is_map() && contact.has("young") && l == 0)
    contact.at("young").fail(
        fmt::format("the stiffness of a cylinder follows from its `length`, which is {}", length ? "0" : "missing"));
  const NormalLaw law = read_contact_law(contact, MaterialStiffness{M_PI / 4 * l / 2, 1}, 1.5);
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
    const double play = axial_gap->non_negative_number();
    if (!axial_contact && contact.has("young"))
      axial_gap->fail("give the stiffness of the collars, too: `axial_contact: {stiffness: ..}`");
    const NormalLaw of_faces = axial_contact ? read_contact_law(*axial_contact, std::nullopt, 1.5) : law;
    places.push_back({"of the collar at -z", {ClearancePlace::Kind::face, play, 0, -1, radius}, of_faces});
    places.push_back({"of the collar at +z", {ClearancePlace::Kind::face, play, 0, 1, radius}, of_faces});
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
  check_clearance_keys(entry, {"radial_gap", "radius", "contact", "friction"}, "a clearance_spherical joint");
  JointFrames frames = read_joint_frames(entry, model, AxisNeed::optional);
  const double gap = entry.at("radial_gap").non_negative_number(), radius = read_radius(entry);
  const YamlValue contact = entry.at("contact");
  if (contact.is_map() && contact.has("young") && radius == 0)
    contact.at("young").fail(fmt::format("the stiffness of a ball follows from its `radius`, which is {}",
                                         entry.has("radius") ? "0" : "missing"));
  if (contact.is_map() && contact.has("young") && gap == 0)
    entry.at("radial_gap")
        .fail("a ball that fills its socket is stiffer than any number: give the contact a `stiffness`");
  const NormalLaw law =
      read_contact_law(contact, MaterialStiffness{4.0 / 3 * std::sqrt(radius * (radius + gap) / gap), 1.5}, 1.5);
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

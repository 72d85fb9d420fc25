#include "reduce/body_file/body_masses.hpp"

#include "reduce/body_file/body_axes.hpp"
#include "reduce/body_file/body_interfaces.hpp"
#include "reduce/body_file/body_surfaces.hpp"
#include "reduce/common/input/yaml_file.hpp"
#include "reduce/superelement/inertia_tensor.hpp"

namespace bielle::reduce {

namespace {

/// Reads the inertia about the centre of the mass, in the axes of the body.
Eigen::Matrix3d read_inertia(const YamlValue& mass) {
  const auto axes = mass.find("axes");
  const auto inertia = mass.find("inertia");
  if (!inertia) {
    if (axes) axes->fail("they are the axes of `inertia`, which is not given");
    return Eigen::Matrix3d::Zero();
  }
  const Eigen::Matrix3d tensor = read_inertia_tensor(*inertia);
  const std::string fault = inertia_fault(tensor);
  if (!fault.empty())
    inertia->fail(fault +
                  ". Is the tensor about the centre of mass, and are the products of inertia entries of the "
                  "tensor? A mass without inertia has no `inertia`");
  if (!axes) return tensor;
  const Eigen::Matrix3d R = read_axes(*axes);
  return R * tensor * R.transpose();
}

CoatingRequest read_coating(const std::string& name, const YamlValue& value, MeshRequest& mesh) {
  for (const char* key : {"mass", "at", "position", "inertia", "axes"})
    if (const auto given = value.find(key))
      given->fail(
          "`per_area` spreads mass over a surface, which has neither a total nor a centre of its own: remove "
          "this key");
  return {name, read_surface(value, "surface", mesh), value.at("per_area").number(), value.path()};
}

MassRequest from_deck(const std::string& name, const YamlValue& value, double kilograms, DeckReader& deck) {
  for (const char* key : {"surface", "at", "mass", "position", "inertia", "axes", "per_area"})
    if (const auto given = value.find(key)) given->fail("the deck has it: remove this key, or 'from'");
  return deck.read_mass(value.at("from"), name, kilograms);
}

MassRequest read_mass(const std::string& name, const YamlValue& value, MeshRequest& mesh) {
  if (value.has("surface") == value.has("at"))
    value.fail("expected either `surface`, whose mean the mass follows, or `at`, its place [x, y, z in m]");
  MassRequest request;
  request.name = name;
  request.subject = value.path();
  if (value.has("surface")) request.group = read_surface(value, "surface", mesh);
  if (const auto place = value.find("at")) request.place = place->vector3();
  if (const auto position = value.find("position")) request.position = position->vector3();
  request.mass = value.at("mass").number();
  request.inertia = read_inertia(value);
  return request;
}

}  // namespace

const KeyTable& mass_keys() {
  using namespace keys;
  static const KeyTable table{
      "an added mass",
      "A rigid mass that the body carries without being stiffened by it, or mass spread over a surface.",
      {{"from", text(), optional,
        "A point mass of the Nastran, Abaqus or CalculiX file that is the geometry, by its name: `CONM2 7001`, `mass "
        "12`, "
        "`rotary inertia 12`. Its tie or its node carries it; other keys are refused next to it."},
       {"surface", surface_forms(), optional,
        "A surface that carries the mass, which moves as its area-weighted mean, as the node of an interface with "
        "`tie: "
        "average` does. It may touch interfaces."},
       {"at", vector3("m"), optional,
        "A place in the mesh that carries the mass, in place of `surface`; the mass follows the nodes around it, of "
        "which the nearest count most."},
       {"mass", number("kg").positive(), optional, "The mass, which is needed without `per_area`."},
       {"position", vector3("m"), computed("the centroid of the surface, or the place"),
        "Its centre of mass, connected by a rigid arm."},
       {"inertia", inertia_tensor_forms(), computed("none: a point mass"),
        "Inertia tensor about its centre of mass as `[xx, yy, zz]`, `[xx, yy, zz, xy, xz, yz]` or three rows of "
        "three."},
       {"axes", nested(axes_keys), computed("the axes of the body"), "Axes of `inertia`."},
       {"per_area", number("kg/m^2").positive(), optional,
        "Mass per area of the `surface`, in place of `mass`: paint, lining, insulation."}}};
  return table;
}

void read_masses(const YamlValue& value, double kilograms, MeshRequest& mesh, DeckReader& deck,
                 ReductionOptions& options) {
  if (!value.is_map()) {
    if (!value.is_scalar() || value.is_null())
      value.fail("expected masses by their names, e.g. {motor: {surface: flange, mass: 3}}, or from_file");
    value.word();  // from_file
    options.masses = deck.read_masses(value, kilograms);
    return;
  }
  for (const auto& [name, entry] : value.entries()) {
    check_name(name, entry);
    if (entry.has("from"))
      options.masses.push_back(from_deck(name, entry, kilograms, deck));
    else if (entry.has("per_area"))
      options.coatings.push_back(read_coating(name, entry, mesh));
    else
      options.masses.push_back(read_mass(name, entry, mesh));
  }
}

}  // namespace bielle::reduce

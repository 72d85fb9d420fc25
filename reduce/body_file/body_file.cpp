#include "reduce/body_file/body_file.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "reduce/body_file/body_interfaces.hpp"
#include "reduce/body_file/body_loads.hpp"
#include "reduce/body_file/body_masses.hpp"
#include "reduce/body_file/body_materials.hpp"
#include "reduce/body_file/body_mesh.hpp"
#include "reduce/body_file/body_pieces.hpp"
#include "reduce/body_file/body_points.hpp"
#include "reduce/body_file/deck_materials.hpp"
#include "reduce/body_file/deck_ties.hpp"
#include "reduce/body_file/matrix_body.hpp"
#include "reduce/body_file/requested_modes.hpp"
#include "reduce/common/input/plausible.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::reduce {

namespace {

const KeyTable& recovery_keys() {
  using namespace keys;
  const KeyForm extent = word({"none", "surface", "all"}, "an extent of recovery");
  static const KeyTable table{
      "the recovery",
      "Fields of the body that the mechanism can recover. Strain follows from stress and material.",
      {{"displacement", extent, otherwise("all"), "Nodes whose displacements can be recovered."},
       {"stress", extent, otherwise("surface"),
        "Nodes whose stress and strain can be recovered; `all` needs all displacements."}}};
  return table;
}

bool takes_masses_from_file(const YamlValue& root) {
  const auto masses = root.find("masses");
  if (!masses || !masses->is_map()) return masses.has_value();
  const auto entries = masses->entries();
  return std::any_of(entries.begin(), entries.end(),
                     [](const auto& entry) { return entry.second.is_map() && entry.second.has("from"); });
}

void read_regions(const YamlValue& root, BodyFile& body) {
  ReductionOptions& options = body.options;
  const YamlValue materials = root.at("materials");
  std::map<std::string, std::string> of_deck;
  if (!materials.is_map()) {
    materials.word();  // from_file
    of_deck = read_deck_materials(root, body);
  } else {
    for (const auto& [name, value] : materials.entries()) {
      options.materials.emplace(name, read_material(value));
      warn_of_material(value);
    }
    if (root.has("mass_unit") && !takes_masses_from_file(root))
      root.at("mass_unit")
          .fail("it belongs to 'materials: from_file' and to masses of the file: other values are in SI units");
  }
  std::vector<std::string> names;
  for (const auto& [name, material] : options.materials) names.push_back(name);
  if (names.empty()) materials.fail("expected at least one material");

  if (!root.has("regions")) {
    if (of_deck.empty())
      root.fail("the key 'regions' is missing: it tells which volumes have which material, e.g. all: " + names.front());
    options.regions = of_deck;
    for (const auto& [group, material] : of_deck) body.mesh.volumes.push_back({group, materials.path()});
    return;
  }
  const YamlValue regions = root.at("regions");
  for (const auto& [group, value] : regions.entries()) {
    const std::string material = value.text();
    if (!options.materials.contains(material))
      value.fail(fmt::format("there is no material '{}'{}", material, did_you_mean(material, names)));
    options.regions[group] = material;
    body.mesh.volumes.push_back({group, value.path()});
  }
  if (options.regions.empty()) regions.fail("expected at least one region, e.g. all: " + names.front());
  if (options.regions.contains("all") && options.regions.size() > 1)
    regions.fail("'all' is the whole body: with other regions, cells would have two materials");
}

RecoveryExtent read_extent(const YamlValue& value) {
  const std::string word = value.word();
  return word == "none" ? RecoveryExtent::none : word == "surface" ? RecoveryExtent::surface : RecoveryExtent::all;
}

/// Refuses the key `strain` of `recovery`, which users expect, and explains how strain is obtained.
void refuse_strain(const YamlValue& file) {
  const auto recovery = file.find("recovery");
  if (!recovery || !recovery->is_map()) return;
  if (const auto strain = recovery->find("strain"))
    strain->fail("strain follows from stress and material: `stress: surface` or `stress: all` gives both");
}

void read_recovery(const YamlValue& value, ReductionOptions& options) {
  options.displacement_recovery = read_extent(value.at("displacement"));
  options.stress_recovery = read_extent(value.at("stress"));
  if (options.stress_recovery == RecoveryExtent::all && options.displacement_recovery == RecoveryExtent::surface)
    value.fail("'stress: all' needs 'displacement: all': the superelement then keeps the whole mesh");
}

void read_parameters(YamlValue root) {
  if (const auto given = root.find("parameters"))
    for (const auto& [name, value] : given->entries())
      root.set_parameter(name, value.number());  // a parameter may use those above it
}

BodyFile read(const YamlValue& file) {
  refuse_strain(file);
  const YamlValue root = file.keyed(body_file_keys());
  read_parameters(root);
  BodyFile body;
  body.lines = KeyLines(file);
  if (root.has("matrices")) {
    body.matrices = read_matrix_body(root);
    body.warnings = root.warnings();
    return body;
  }
  for (const char* key : {"geometry", "materials", "interfaces", "modes"})
    if (!root.has(key))
      root.fail(
          fmt::format("the key '{}' is missing{}", key,
                      std::string(key) == "geometry" ? "; a body of another program's matrices has `matrices`" : ""));
  if (const auto spin = root.find("spin")) spin->fail("it belongs to the geometric stiffness of `matrices`");
  body.options.name = root.at("body").text();
  body.options.input_text = root.source_text();
  read_mesh(root, body.mesh);
  read_regions(root, body);
  const std::string integration = root.at("integration").word();
  body.options.integration = integration == "plain"     ? Integration::plain
                             : integration == "reduced" ? Integration::reduced
                                                        : Integration::standard;
  const YamlValue interfaces = root.at("interfaces");
  DeckReader deck(body.mesh);
  for (const auto& [name, value] : interfaces.entries())
    body.options.interfaces.push_back(read_interface(name, value, body.mesh, deck));
  if (body.options.interfaces.empty())
    interfaces.fail(
        "expected at least one: a mechanism moves a body by its interfaces, and one with 'tie: average' on "
        "any surface leaves the body free");
  const RequestedModes modes = read_modes(root.at("modes"));
  body.options.modes = modes.request;
  body.options.modes_proven = modes.proven;
  body.options.inertia_relief = root.at("inertia_relief").boolean();
  if (const auto damping = root.find("damping")) {
    const RequestedDamping requested = read_damping(*damping);
    body.options.damping_ratios = requested.ratios;
    body.options.rayleigh = requested.rayleigh;
  }
  if (const auto loads = root.find("loads"))
    for (const auto& [name, value] : loads->entries()) body.options.loads.push_back(read_load(name, value, body.mesh));
  if (const auto masses = root.find("masses"))
    read_masses(*masses, kilograms_per(root.at("mass_unit").word()), body.mesh, deck, body.options);
  body.options.lumped = root.at("lumped").boolean();
  if (const auto points = root.find("points")) body.options.points = read_points(*points, body.mesh);
  if (const auto recovery = root.find("recovery")) read_recovery(*recovery, body.options);
  if (const auto pieces = root.find("pieces")) body.pieces = read_pieces(*pieces, body.mesh.cuts);
  resolve_sizes(root, body.options, body.mesh);
  body.warnings.insert(body.warnings.end(), deck.notes().begin(), deck.notes().end());
  body.warnings.insert(body.warnings.end(), root.warnings().begin(), root.warnings().end());
  return body;
}

}  // namespace

const KeyTable& body_file_keys() {
  using namespace keys;
  static const KeyTable table{
      "a body file",
      "A body and its reduction to a superelement. All values are in SI units, also if the geometry is in others.",
      {{"body", text(), required, "Name of the body."},
       {"parameters", entries("parameter", {number("any")}), optional,
        "Numbers that expressions may use; each may use those above it."},
       {"geometry", file("geometry or mesh"), computed("required without `matrices`"),
        "File of the geometry or the mesh."},
       {"matrices",
        {file("matrices"), nested(matrices_keys)},
        optional,
        "File with the stiffness and mass of the body as another program computed them, full or reduced, in place of "
        "`geometry`. Then `body`, `parameters`, `interfaces`, `modes`, `damping`, `points` and `spin` alone are used."},
       {"length_unit", word({"m", "mm", "cm", "um", "km", "in", "ft"}, "a unit of length"),
        computed("the unit that the geometry declares, otherwise m"),
        "Unit of a geometry that declares none. It scales the geometry alone, no other value of this file."},
       {"volume",
        {integer().positive(), name_of("solid")},
        optional,
        "The solid of an assembly that is the body, by its number in `--list`, or by the name of a solid, part or "
        "physical volume. Without `volume` and `volumes` the body consists of all solids."},
       {"volumes", list_of({integer().positive(), name_of("solid")}).items_at_least(1), optional,
        "Several solids, each named as for `volume`; a name selects all solids that have it."},
       {"glue", boolean(), otherwise("false"),
        "Solids that touch are glued: they get common faces, through which the mesh is connected."},
       {"mesh", nested(mesh_keys), optional, "The mesh of a geometry."},
       {"materials",
        {entries("material", material_forms()), word({"from_file"}, "a source of materials")},
        computed("required with a geometry"),
        "Materials by their names; `from_file` takes those of the Nastran, Abaqus or CalculiX file that is the "
        "geometry."},
       {"mass_unit", word(mass_units(), "a unit of mass"), otherwise("kg"),
        "Unit of mass of the materials and masses that are taken from the file; their length has the `length_unit`, "
        "their time is "
        "in seconds. A file in N, mm and MPa has `t`."},
       {"integration", word({"standard", "plain", "reduced"}, "an integration"), otherwise("standard"),
        "Integration of the stiffness. `plain` leaves out the internal modes of hexahedra with 8 nodes and of wedges "
        "with 6, which then lock in bending, as C3D8 and C3D6 of other programs; `reduced` takes 2 x 2 x 2 points in "
        "hexahedra with 20 nodes, as C3D20R, and warns of hourglass modes."},
       {"regions", entries("physical volume", {name_of("material")}), computed("those of the file, with `from_file`"),
        "Materials of the physical volumes, or of the solids by their names if there are none; `all` is the whole "
        "body."},
       {"interfaces", entries("interface", {nested(interface_keys)}),
        computed("required with a geometry; of matrices: the nodes that their file declares, or all"),
        "Interfaces by their names, at least one."},
       {"modes", nested(modes_keys), computed("required with a geometry; of small or reduced matrices: all"),
        "Fixed-boundary modes to keep."},
       {"inertia_relief", boolean(), otherwise("false"),
        "Residual vectors for the accelerations of the body itself are added."},
       {"damping", nested(damping_keys), optional, "Damping of the body, which is undamped without it."},
       {"loads", entries("load", {nested(load_keys)}), optional, "Patterns of load by their names."},
       {"points", entries("point", {nested(point_keys)}), optional, "Points inside the body by their names."},
       {"masses",
        {entries("mass", {nested(mass_keys)}), word({"from_file"}, "a source of masses")},
        optional,
        "Masses that the body carries: equipment, paint; by their names. `from_file` takes all point masses of the "
        "Nastran, Abaqus or CalculiX file that is the geometry."},
       {"lumped", boolean(), otherwise("false"),
        "The mesh has a diagonal mass matrix, to compare with other programs: row sums for cells of order 1, the "
        "scaled "
        "diagonal for cells of order 2. Frequencies become less accurate."},
       {"recovery", nested(recovery_keys), optional, "Fields that the mechanism can recover."},
       {"spin", vector3("rad/s"), optional,
        "Angular velocity about one axis of the body to which the geometric stiffness of `matrices` belongs."},
       {"pieces", nested(pieces_keys), optional,
        "Cuts that divide the body into several superelements; it is one without them."}}};
  return table;
}

BodyFile read_body_file(const std::string& path) { return read(YamlValue::load(path)); }

BodyFile parse_body_file(const std::string& text, const std::string& name) {
  return read(YamlValue::parse(text, name));
}

GeometryFile read_geometry_of(const std::string& body_path) {
  const YamlValue root = YamlValue::load(body_path);
  const auto unit = root.find("length_unit"), materials = root.find("materials"), regions = root.find("regions");
  GeometryFile result{root.at("geometry").file_path(), unit ? std::optional(unit->text()) : std::nullopt, {}};
  if (!materials || !regions || !materials->is_map() || !regions->is_map()) return result;
  read_parameters(root);
  for (const auto& [region, material] : regions->entries())
    if (const auto found = materials->find(material.text())) result.densities[region] = read_material(*found).density;
  return result;
}

}  // namespace bielle::reduce

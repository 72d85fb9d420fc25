#include "mechanism/io/component_table.hpp"

#include <optional>
#include <utility>

#include <fmt/format.h>

#include "mechanism/contacts/contact.hpp"
#include "mechanism/elements/beam/beam.hpp"
#include "mechanism/elements/control/state_reader.hpp"
#include "mechanism/elements/forces/load.hpp"
#include "mechanism/elements/forces/node_force.hpp"
#include "mechanism/elements/forces/spring_damper.hpp"
#include "mechanism/elements/forces/stiffness_field.hpp"
#include "mechanism/elements/rigid_body/rigid_body.hpp"
#include "mechanism/elements/superelement/superelement_body.hpp"
#include "mechanism/hydraulics/reading/actuator_reader.hpp"
#include "mechanism/joints/actions/drive.hpp"
#include "mechanism/joints/cables/rope_section.hpp"
#include "mechanism/joints/cams/cam.hpp"
#include "mechanism/joints/couplings/coupling_reader.hpp"
#include "mechanism/joints/flexible/bearing.hpp"
#include "mechanism/joints/flexible/bushing.hpp"
#include "mechanism/joints/flexible/clearance_joint.hpp"
#include "mechanism/joints/flexible/journal_bearing.hpp"
#include "mechanism/joints/flexible/rolling_bearing.hpp"
#include "mechanism/joints/gears/gear_mesh.hpp"
#include "mechanism/joints/pairs/guided_point.hpp"
#include "mechanism/joints/pairs/links.hpp"
#include "mechanism/joints/pairs/lower_pairs.hpp"
#include "mechanism/joints/pairs/point_on_curve.hpp"
#include "mechanism/joints/pairs/screw.hpp"
#include "mechanism/joints/pairs/slider.hpp"
#include "mechanism/joints/pairs/universal.hpp"
#include "mechanism/joints/pairs/wheel.hpp"
#include "mechanism/joints/tyres/tyre.hpp"
#include "mechanism/reading/read_activity.hpp"
#include "reduce/common/input/foreign_words.hpp"

namespace bielle::mechanism {

namespace {

/// Returns the table of a type whose entries can be inactive.
template <const KeyTable& (*keys)()>
const KeyTable& with_activity() {
  static const KeyTable table = [] {
    KeyTable whole = keys();
    whole.keys.push_back(activity_key());
    return whole;
  }();
  return table;
}

}  // namespace

const std::vector<ComponentType>& component_table() {
  static const std::vector<ComponentType> table = {
      {Section::elements, "rigid_body", read_rigid_body, rigid_body_keys},
      {Section::elements, "point_mass", read_point_mass, point_mass_keys},
      {Section::elements, "beam", read_beam, beam_keys},
      {Section::elements, "superelement", read_superelement_body, superelement_keys},
      {Section::elements, "spring_damper", read_spring_damper, with_activity<spring_damper_keys>},
      {Section::elements, "node_force", read_node_force, with_activity<node_force_keys>},
      {Section::elements, "stiffness_field", read_stiffness_field, with_activity<stiffness_field_keys>},
      {Section::elements, "hydraulic_actuator", read_hydraulic_actuator, with_activity<hydraulic_actuator_keys>},
      {Section::joints, "rigid", read_rigid, with_activity<rigid_keys>},
      {Section::joints, "hinge", read_hinge, with_activity<hinge_keys>},
      {Section::joints, "prismatic", read_prismatic, with_activity<prismatic_keys>},
      {Section::joints, "cylindrical", read_cylindrical, with_activity<cylindrical_keys>},
      {Section::joints, "spherical", read_spherical, with_activity<spherical_keys>},
      {Section::joints, "planar", read_planar, with_activity<planar_keys>},
      {Section::joints, "screw", read_screw, with_activity<screw_keys>},
      {Section::joints, "universal", read_universal, with_activity<universal_keys>},
      {Section::joints, "constant_velocity", read_constant_velocity, with_activity<constant_velocity_keys>},
      {Section::joints, "distance", read_distance, with_activity<distance_keys>},
      {Section::joints, "spherical_spherical", read_spherical_spherical, with_activity<spherical_spherical_keys>},
      {Section::joints, "revolute_spherical", read_revolute_spherical, with_activity<revolute_spherical_keys>},
      {Section::joints, "point_on_line", read_point_on_line, with_activity<point_on_line_keys>},
      {Section::joints, "point_on_plane", read_point_on_plane, with_activity<point_on_plane_keys>},
      {Section::joints, "point_on_curve", read_point_on_curve, with_activity<point_on_curve_keys>},
      {Section::joints, "slider", read_slider, with_activity<slider_keys>},
      {Section::joints, "wheel", read_wheel, with_activity<wheel_keys>},
      {Section::joints, "tyre", read_tyre, with_activity<tyre_keys>},
      {Section::joints, "bushing", read_bushing, with_activity<bushing_keys>},
      {Section::joints, "bearing", read_bearing, with_activity<bearing_keys>},
      {Section::joints, "ball_bearing", read_ball_bearing, with_activity<ball_bearing_keys>},
      {Section::joints, "roller_bearing", read_roller_bearing, with_activity<roller_bearing_keys>},
      {Section::joints, "journal_bearing", read_journal_bearing, with_activity<journal_bearing_keys>},
      {Section::joints, "clearance_hinge", read_clearance_hinge, with_activity<clearance_hinge_keys>},
      {Section::joints, "clearance_spherical", read_clearance_spherical, with_activity<clearance_spherical_keys>},
      {Section::joints, "gear", read_gear, with_activity<gear_keys>},
      {Section::joints, "gear_mesh", read_gear_mesh, with_activity<gear_mesh_keys>},
      {Section::joints, "differential", read_differential, with_activity<differential_keys>},
      {Section::joints, "rack_and_pinion", read_rack_and_pinion, with_activity<rack_and_pinion_keys>},
      {Section::joints, "cam", read_cam, with_activity<cam_keys>},
      {Section::joints, "belt", read_belt, with_activity<belt_keys>},
      {Section::joints, "cable", read_cable, with_activity<cable_keys>},
      {Section::joints, "contact", read_contact, with_activity<contact_keys>},
      {Section::drives, "drive", read_drive, drive_keys},
      {Section::loads, "load", read_load, with_activity<load_keys>},
      {Section::states, "state", read_state, state_keys},
  };
  return table;
}

namespace {

/// Returns a clause with this program's name for a type that other programs call `wanted`; no value if there is none.
std::optional<std::string> own_name(Section section, const std::string& wanted) {
  std::vector<std::string> types;
  for (const ComponentType& type : component_table()) types.emplace_back(type.name);
  const std::vector<std::string> own = names_here(wanted, types);
  if (own.empty()) return {};
  const std::string clause = called_here_clause(own);
  for (const ComponentType& type : component_table())
    if (own.front() == type.name && type.section != section)
      return fmt::format("{}, one of the {}", clause, section_name(type.section));
  return clause;
}

/// Returns a clause that names the section to which a type belongs, if it is another one; no value otherwise.
std::optional<std::string> where_it_belongs(Section section, const std::string& wanted) {
  for (const ComponentType& type : component_table())
    if (type.section != section && wanted == type.name) {
      const bool has_types = type.section == Section::elements || type.section == Section::joints;
      return has_types ? fmt::format("; it is one of the {}: write it there", section_name(type.section))
                       : fmt::format("; `{}` is a section of its own: write it there, without a type",
                                     section_name(type.section));
    }
  // Users may write these names as types, although they are sections, or belong to them.
  static const std::vector<std::pair<std::string, std::string>> others = {
      {"measure", "measures"},   {"input", "inputs"},           {"event", "events"},        {"node", "nodes"},
      {"line", "hydraulics"},    {"volume", "hydraulics"},      {"junction", "hydraulics"}, {"supply", "hydraulics"},
      {"orifice", "hydraulics"}, {"accumulator", "hydraulics"}, {"valve", "hydraulics"},    {"pump", "hydraulics"}};
  for (const auto& [name, home] : others)
    if (wanted == name) return fmt::format("; it stands in the section `{}`", home);
  return {};
}

}  // namespace

void read_component(Section section, const std::string& name, const YamlValue& entry, Model& model) {
  std::vector<std::string> names;
  for (const ComponentType& type : component_table())
    if (type.section == section) names.push_back(type.name);
  const bool has_types = section == Section::elements || section == Section::joints;
  const std::string wanted = has_types ? entry.at("type").text() : names.front();
  for (const ComponentType& type : component_table())
    if (type.section == section && wanted == type.name) {
      const YamlValue keyed = type.keys ? entry.keyed(type.keys()) : entry;
      type.read(name, keyed, model);
      return read_activity(keyed, {section, name}, model);
    }
  std::optional<std::string> clause = where_it_belongs(section, wanted);
  if (!clause) clause = own_name(section, wanted);
  entry.at("type").fail(fmt::format("'{}' is not a type of the {}{}", wanted, section_name(section),
                                    clause.value_or(did_you_mean(wanted, names))));
}

}  // namespace bielle::mechanism

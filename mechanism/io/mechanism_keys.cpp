#include "mechanism/io/mechanism_keys.hpp"

#include "mechanism/analyses/analysis_table.hpp"
#include "mechanism/elements/superelement/body_points.hpp"
#include "mechanism/hydraulics/reading/circuit_reader.hpp"
#include "mechanism/io/component_table.hpp"
#include "mechanism/io/node_reader.hpp"
#include "mechanism/io/output_options.hpp"
#include "mechanism/joints/actions/event_reader.hpp"
#include "mechanism/language/language_keys.hpp"
#include "mechanism/measures/input_measure.hpp"
#include "mechanism/measures/read_measure.hpp"

namespace bielle::mechanism {
namespace {

/// Returns a table with a variant for each type. @param of_word  description of the value of `type`: "a type of
/// analysis"
template <class Types, class Is>
KeyTable by_type(const Types& types, const Is& is, const char* of, const char* about, const std::string& of_word) {
  KeyTable table{of, about, {}, {}};
  std::vector<std::string> names;
  for (const auto& type : types)
    if (is(type)) {
      names.emplace_back(type.name);
      table.variants.push_back({"type", type.name, type.keys});
    }
  table.keys = {{"type", keys::word(names, of_word), keys::required, "The type of the entry."}};
  return table;
}

/// Returns the table of the entries of a section.
KeyTable of_section(Section section, const char* of, const char* about) {
  const auto is = [=](const ComponentType& type) { return type.section == section; };
  return by_type(component_table(), is, of, about, std::string("a type of the ") + section_name(section));
}

/// Returns the table of the only type of a section.
const KeyTable& (*keys_of(Section section))() {
  for (const ComponentType& type : component_table())
    if (type.section == section) return type.keys;
  return nullptr;
}

}  // namespace

const KeyTable& element_keys() {
  static const KeyTable table =
      of_section(Section::elements, "an element", "A body, a spring, a field or an actuator.");
  return table;
}

const KeyTable& joint_keys() {
  static const KeyTable table = of_section(Section::joints, "a joint", "A connection of nodes, or of joints.");
  return table;
}

const KeyTable& analysis_keys() {
  static const KeyTable table = by_type(
      analysis_table(), [](const AnalysisType&) { return true; }, "an analysis",
      "A computation; analyses follow one another from the state that the last one left.", "a type of analysis");
  return table;
}

namespace {

const KeyTable& part_definition_keys();

/// Returns the sections of a model and of a part.
std::vector<Key> section_keys() {
  using namespace keys;
  return {
      {"parameters", entries("parameter", {number("any")}), optional,
       "Named numbers for formulas; each may use those before it."},
      {"nodes", entries("entry", {nested(node_keys)}), optional, "Points with axes, which move."},
      {"points", entries("entry", {nested(point_keys)}), optional, "Nodes at points of superelements."},
      {"elements", entries("entry", {nested(element_keys)}), optional, "Bodies, springs and actuators."},
      {"joints", entries("entry", {nested(joint_keys)}), optional, "Connections of nodes."},
      {"drives", entries("entry", {nested(keys_of(Section::drives))}), optional,
       "Motions, forces and controls of joints."},
      {"loads", entries("entry", {nested(keys_of(Section::loads))}), optional, "Forces and moments on nodes."},
      {"states", entries("entry", {nested(keys_of(Section::states))}), optional,
       "Differential equations and control blocks."},
      {"measures", entries("entry", {state_formula("any", {"t"}), nested(measure_keys)}), optional,
       "Named quantities of the state."},
      {"inputs", entries("entry", {number("any"), nested(input_keys)}), optional,
       "Numbers that a program sets while the mechanism moves."},
      {"events", entries("entry", {nested(event_keys)}), optional, "Quantities that cross a value."},
      {"hydraulics", nested(hydraulics_keys), optional, "Circuits of fluid."},
      {"parts", entries("entry", {nested(part_keys)}), optional, "Sub-assemblies that are placed in the mechanism."}};
}

const KeyTable& part_definition_keys() {
  static const KeyTable table{"a definition of a part", "Sections of a sub-assembly, as in a mechanism file.",
                              section_keys()};
  return table;
}

const KeyTable& case_keys() {
  using namespace keys;
  static const KeyTable table{
      "a case",
      "A set of parameters with the analyses that belong to it.",
      {{"parameters", entries("parameter", {number("any")}), optional, "Values of parameters, in place of the file's."},
       {"analysis", list_of(nested(analysis_keys)), computed("those of the file"), "Analyses of this case."},
       {"output", nested(output_keys), computed("that of the file"), "Output of this case."}}};
  return table;
}

}  // namespace

const KeyTable& mechanism_file_keys() {
  using namespace keys;
  static const KeyTable table{
      "a mechanism file",
      "A mechanism, the analyses to run on it, and the results that are kept. Units are SI, angles are in radians.",
      joined({{{"mechanism", text(), optional, "Title."},
               {"gravity", vector3("m/s^2").as_vector(), otherwise("[0, 0, 0]"),
                "Acceleration of gravity, in inertial components."},
               {"include",
                {file("mechanism"), list_of(file("mechanism"))},
                optional,
                "Files whose entries belong to this one. Parameters of this file replace those of included ones."}},
              section_keys(),
              {{"definitions", entries("part", {nested(part_definition_keys)}), optional,
                "Sub-assemblies that are written once and placed by `parts`."},
               {"analysis", list_of(nested(analysis_keys)), optional, "Analyses, one after the other."},
               {"output", nested(output_keys), optional, "Results that are kept."},
               {"cases", entries("case", {nested(case_keys)}), optional,
                "Named sets of parameters and analyses, which `--case` runs."}}})};
  return table;
}

}  // namespace bielle::mechanism

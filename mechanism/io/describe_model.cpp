#include "mechanism/io/describe_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mechanism/analyses/summary_text.hpp"
#include "mechanism/model/description.hpp"
#include "mechanism/session/unique_reactions.hpp"
#include "mechanism/solvers/constraints/redundancy.hpp"
#include "mechanism/solvers/start/massless_direction.hpp"
#include "reduce/common/counted.hpp"

namespace bielle::mechanism {
namespace {

constexpr std::array described_sections = {Section::elements, Section::joints,     Section::drives,   Section::loads,
                                           Section::states,   Section::hydraulics, Section::measures, Section::events};

/// Returns whether a member is an entry of the file, and not a measure that a formula has created for internal use.
bool is_own(const Member& member) {
  return member.entry.section != Section::measures || member.recorded != Recorded::no;
}

/// Returns one line of a list of counts: "  elements     3 (beam 2, rigid_body 1)".
std::string count_line(const std::string& title, const std::string& noun, const std::map<std::string, int>& types) {
  if (types.empty()) return {};
  int total = 0;
  std::vector<std::string> parts;
  for (const auto& [type, count] : types) {
    total += count;
    parts.push_back(types.size() == 1 ? type : fmt::format("{} {}", type, count));
  }
  const bool says_more = types.size() > 1 || types.begin()->first != noun;
  return fmt::format("  {:<12} {}{}\n", title, total, says_more ? fmt::format(" ({})", fmt::join(parts, ", ")) : "");
}

/// Counts the entries of each type. A beam counts once, for any number of elements.
std::string count_entries(const Model& model) {
  std::string text;
  // Actions in joints, which are counted one by one, because a joint may have several.
  std::map<std::string, int> in_joints;
  for (const Section section : described_sections) {
    std::map<std::string, int> types;
    for (const std::string& name : model.names_in(section)) {
      bool first = true;
      for (const std::size_t m : model.members_of({section, name})) {
        const Member& member = model.members()[m];
        if (member.entry != Entry{section, name} || !is_own(member)) continue;
        if (first)
          ++types[member.component->type()];
        else if (section == Section::joints)
          ++in_joints[member.component->type()];
        first = false;
      }
    }
    text += count_line(section_name(section), section_noun(section), types);
    if (section == Section::joints) text += count_line("in joints", "", in_joints);
  }
  return text;
}

/// Describes every entry by its components.
std::string describe_entries(const Model& model, const System& system, const State& state) {
  std::string text;
  for (const Section section : described_sections)
    for (const std::string& name : model.names_in(section)) {
      const Entry entry{section, name};
      Description description(model);
      std::string type;
      for (const std::size_t m : model.members_of(entry)) {
        const Member& member = model.members()[m];
        // A drive is an entry of its own, although its joint contains it.
        if (member.entry != entry || !is_own(member)) continue;
        if (type.empty()) type = member.component->type();
        member.component->describe(LocalState(state, system.slots()[m], model.environment), description);
      }
      if (type.empty()) continue;
      const std::string noun = section_noun(section);
      const std::vector<std::string> lines = description.lines();
      text += fmt::format("  {} '{}'{}{}{}\n", noun, name, type == noun ? "" : fmt::format(" ({})", type),
                          lines[0].empty() ? "" : ": ", lines[0]);
      for (std::size_t k = 1; k < lines.size(); ++k) text += "    " + lines[k] + "\n";
    }
  return text;
}

/// Returns "rotation y, rotation z of node 'pin'". @param unknowns  unknowns of the node
std::string name_directions(const System& system, int node, const std::vector<int>& unknowns) {
  const NodeFreedom& freedom = system.kinematics().freedom(node);
  std::vector<std::string> names;
  for (const int unknown : unknowns) {
    Eigen::Index direction = 0;
    freedom.G.col(unknown - freedom.begin).cwiseAbs().maxCoeff(&direction);
    names.push_back(fmt::format("{} {}", direction < 3 ? "displacement" : "rotation", "xyz"[direction % 3]));
  }
  return fmt::format("{} of node '{}'", fmt::join(names, ", "), system.model().node(node).name);
}

/// Lists the warnings of entries, in the order of the file. @param most  number of entries that have a line of their
/// own
std::string describe_remarks(const Model& model, std::size_t most) {
  std::string text;
  std::size_t count = 0;
  for (const Member& member : model.members())
    if (const std::string remark = member.component->remark(); !remark.empty() && ++count <= most)
      text += fmt::format("  {}: {}\n", describe(member), remark);
  if (count > most) text += fmt::format("  and likewise {} (--check lists all)\n", counted(count - most, "more joint"));
  return text;
}

/// Describes start values and rates of coordinates.
std::string describe_start_conditions(const System& system) {
  std::string text;
  for (const CoordinateCondition& each : conditions_of_file(system).coordinates) {
    const StartCoordinate coordinate = start_coordinate(system, each);
    std::vector<std::string> asked;
    if (each.value) asked.push_back(fmt::format("{:.6g} {}", *each.value, coordinate.units));
    if (each.rate) asked.push_back(fmt::format("{:.6g} {}", *each.rate, coordinate.rate_units));
    text += fmt::format("  start        {}: {}\n", coordinate_name(system, each.member, coordinate),
                        fmt::join(asked, ", "));
  }
  return text;
}

/// Lists nodes without components.
std::string describe_unused(const Model& model, const System& system) {
  std::vector<bool> used(model.nodes().size(), false);
  for (const Slots& slots : system.slots())
    for (const int node : slots.nodes) used[static_cast<std::size_t>(node)] = true;
  for (const Node& node : model.nodes())
    if (node.carrier) used[static_cast<std::size_t>(*node.carrier)] = true;
  std::string text;
  for (std::size_t k = 1; k < used.size(); ++k)  // the ground comes first, and may have no components
    if (!used[k])
      text +=
          fmt::format("  unused       node '{}': no element, joint or load is attached to it\n", model.nodes()[k].name);
  return text;
}

/// Returns "  mass         12.5 kg, centre at [0, 0, 1.2] m"; empty without mass. Both follow from the energy of
/// gravity, -m g . c, by unit accelerations and a unit displacement of all nodes.
std::string describe_mass(const Model& model, const System& system, const State& state) {
  Environment environment = model.environment;
  const auto energy = [&](int direction, const State& at) {
    environment.gravity = Vector3::Unit(direction);
    return system.energy(at, environment).gravity;
  };
  State displaced = state;
  for (NodeState& node : displaced.nodes) node.x += Vector3::UnitZ();
  const double mass = energy(2, state) - energy(2, displaced);
  if (!(mass > 0)) return {};
  Vector3 centre;
  double size = 0;  // largest coordinate: a component within its rounding is zero
  for (const NodeState& node : state.nodes) size = std::max(size, node.x.cwiseAbs().maxCoeff());
  constexpr double rounding = 1e-12;
  for (int k = 0; k < 3; ++k) {
    centre[k] = -energy(k, state) / mass;
    if (std::abs(centre[k]) <= rounding * size) centre[k] = 0;
  }
  return fmt::format("  mass         {:.6g} kg, centre at [{:.6g}, {:.6g}, {:.6g}] m\n", mass, centre.x(), centre.y(),
                     centre.z());
}

/// Lists directions without mass.
std::string describe_massless(const Model& model, const System& system, const State& state) {
  std::vector<double> values;
  system.tangent(state, model.environment, {0, 0, 1, 0, 0}, nullptr, values);
  const auto has_mass = [&](int unknown) {
    const int place = system.pattern().find(unknown, unknown);
    return place >= 0 && values[static_cast<std::size_t>(place)] != 0;
  };
  std::string text;
  std::map<std::string, int> inner;  // number of nodes inside of elements without mass, by element
  for (int k = 0; k < static_cast<int>(model.nodes().size()); ++k) {
    const Node& node = model.node(k);
    const NodeFreedom& freedom = system.kinematics().freedom(k);
    std::vector<int> without;
    for (int i = freedom.begin; i < freedom.begin + freedom.count; ++i)
      if (!has_mass(i)) without.push_back(i);
    if (node.internal && !without.empty() && static_cast<int>(without.size()) == freedom.count)
      ++inner[node.name.substr(0, node.name.rfind('.'))];
    else if (without.size() == 6)
      text += fmt::format("  massless     node '{}'\n", node.name);
    else if (!without.empty())
      text += fmt::format("  massless     {}\n", name_directions(system, k, without));
    if (const auto direction = massless_direction(system, values, k))
      text += fmt::format("  massless     {}\n", massless_name(system, k, *direction));
  }
  for (const auto& [element, count] : inner)
    text += fmt::format("  massless     {} of '{}'\n", counted(count, "inner node"), element);
  if (!text.empty())
    text +=
        "               a part without mass must be held (`fixed`), joined to something, or given inertia by a body\n";
  return text;
}

}  // namespace

std::string describe_model(const MechanismFile& file) { return describe_model(CheckedModel(file)); }

std::string describe_model(const CheckedModel& checked) {
  if (checked.failure) std::rethrow_exception(checked.failure);
  const Model& model = checked.file.model;
  const System& system = checked.system;
  const State& state = checked.state;
  std::string text = fmt::format("{}\n", model.title.empty() ? "mechanism" : model.title);
  int internal = 0;
  for (const Node& node : model.nodes()) internal += node.internal;
  text += fmt::format("  nodes        {}{}\n", model.nodes().size() - static_cast<std::size_t>(internal),
                      internal > 0 ? fmt::format(" and {} inside of elements", internal) : "");
  text += count_entries(model);
  text += describe_mass(model, system, state);
  const Mobility mobility = count_mobility(system, model.environment, state);
  text += fmt::format("  unknowns     {}, {} of first order, {}\n",
                      counted(system.dofs(), "displacement or amplitude", "displacements and amplitudes"),
                      system.first_orders(), counted(system.multipliers(), "multiplier"));
  text +=
      fmt::format("  freedom      {} after {}\n", counted(mobility.degrees, "degree of freedom", "degrees of freedom"),
                  counted(mobility.independent, "independent constraint"));
  text += format_start(checked.report);
  for (const std::string& names : name_constraints(system, checked.redundant))
    text += fmt::format("  redundant    {}: set aside\n", names);
  if (const std::string loose = describe_loose(system); !loose.empty())
    text += fmt::format("  loose        {}\n", loose);
  for (const std::string& names : mobility.nearly_redundant)
    text += fmt::format("  nearly       redundant: {}\n", names);
  if (const NotUnique found = find_not_unique(system, model.environment, state); !found.none())
    text += fmt::format("  reactions    {}\n", describe_not_unique(found));
  text += describe_start_conditions(system) + describe_remarks(model, model.members().size());
  text += describe_unused(model, system) + describe_massless(model, system, state);
  text += describe_entries(model, system, state);
  return text;
}

std::string format_summary(const MechanismFile& file, const std::vector<AnalysisSummary>& summaries,
                           const std::vector<PhaseReport>& phases, const std::string& results_path) {
  std::string text = fmt::format("{}\n", file.model.title.empty() ? "mechanism" : file.model.title);
  constexpr std::size_t most_remarks = 5;
  text += describe_remarks(file.model, most_remarks);
  for (const AnalysisSummary& summary : summaries) text += summary.text;
  for (const PhaseReport& phase : phases) text += fmt::format("  {:<12} {:8.2f} s\n", phase.name, phase.seconds);
  text += fmt::format("results: {}\n", results_path);
  return text;
}

}  // namespace bielle::mechanism

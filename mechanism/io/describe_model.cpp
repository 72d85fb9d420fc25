#include "mechanism/io/describe_model.hpp"

#include <cmath>
#include <map>
#include <set>

#include <Eigen/LU>
#include <fmt/format.h>

#include "mechanism/analyses/summary_text.hpp"
#include "mechanism/elements/beam_element.hpp"
#include "mechanism/elements/rigid_body.hpp"
#include "mechanism/joints/joint.hpp"
#include "mechanism/session/unique_reactions.hpp"
#include "mechanism/solvers/massless_direction.hpp"
#include "mechanism/solvers/redundancy.hpp"

namespace bielle::mechanism {
namespace {

std::string format_vector(const Vector3& v) {
  // Rounding residue of orthogonal axes reads as zero.
  const auto clean = [](double x) { return std::abs(x) < 1e-14 ? 0.0 : x; };
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", clean(v.x()), clean(v.y()), clean(v.z()));
}

/// What the user's numbers made of bodies and beams.
std::string describe_elements(const Model& model) {
  std::string text;
  std::map<std::string, std::vector<const BeamElement*>> beams;
  for (const Member& member : model.members()) {
    const Component* component = member.component.get();
    if (const auto* body = dynamic_cast<const RigidBody*>(component)) {
      const MassProperties& p = body->properties();
      const Matrix3& J = p.inertia;
      text += fmt::format("  element '{}' ({}): mass {:.6g} kg, centre {}", body->name(), body->type(), p.mass,
                          format_vector(p.centre));
      if (!J.isZero(0))
        text +=
            fmt::format(", inertia about it xx {:.6g}, yy {:.6g}, zz {:.6g}, xy {:.6g}, xz {:.6g}, yz {:.6g} kg m^2",
                        J(0, 0), J(1, 1), J(2, 2), J(0, 1), J(0, 2), J(1, 2));
      text += "\n";
    }
    if (const auto* beam = dynamic_cast<const BeamElement*>(component)) beams[beam->name()].push_back(beam);
  }
  const auto section = [](const char* where, const BeamElement& element) {
    const Matrix6& C = element.section();
    const bool coupled = !C.isDiagonal(1e-12);
    const std::string line = fmt::format(
        "    section in the middle of {} element: EA {:.6g}, GAy {:.6g}, GAz {:.6g} N, GJ {:.6g}, EIy {:.6g}, EIz "
        "{:.6g} N "
        "m^2{}\n",
        where, C(0, 0), C(1, 1), C(2, 2), C(3, 3), C(4, 4), C(5, 5),
        coupled ? " about the node line, and coupling terms" : "");
    if (!coupled) return line;
    const Vector6 alone = C.inverse().diagonal().cwiseInverse();
    return line + fmt::format("      against one moment alone: GJ {:.6g}, EIy {:.6g}, EIz {:.6g} N m^2\n", alone[3],
                              alone[4], alone[5]);
  };
  for (const auto& [name, elements] : beams) {
    double length = 0, mass = 0;
    for (const BeamElement* element : elements) {
      length += element->length();
      mass += element->mass();
    }
    text += fmt::format("  element '{}' (beam): length {:.6g} m, mass {:.6g} kg, elements {}\n", name, length, mass,
                        elements.size());
    const bool uniform = elements.front()->section() == elements.back()->section();
    text += section(uniform ? "each" : "the first", *elements.front());
    if (!uniform) text += section("the last", *elements.back());
  }
  return text;
}

/// Nodes that nothing uses, and directions that no mass resists.
std::string describe_nodes(const Model& model, const System& system, const State& state) {
  std::string text;
  std::set<int> used;
  for (const Slots& slots : system.slots()) used.insert(slots.nodes.begin(), slots.nodes.end());
  for (const Node& node : model.nodes())
    if (node.carrier) used.insert(*node.carrier);
  for (int k = 0; k < static_cast<int>(model.nodes().size()); ++k)
    if (used.count(k) == 0 && model.node(k).name != "ground")
      text +=
          fmt::format("  unused       node '{}': no element, joint or load is attached to it\n", model.node(k).name);
  std::vector<double> values;
  system.tangent(state, model.environment, {0, 0, 1, 0, 0}, nullptr, values);
  const auto mass = [&](int row, int column) {
    const int place = system.pattern().find(row, column);
    return place < 0 ? 0.0 : values[static_cast<std::size_t>(place)];
  };
  std::map<std::string, int> inner;  // nodes inside of elements without mass, by the element
  for (int k = 0; k < static_cast<int>(model.nodes().size()); ++k) {
    const Node& node = model.node(k);
    const NodeFreedom& freedom = system.kinematics().freedom(k);
    std::vector<int> without;
    for (int i = freedom.begin; i < freedom.begin + freedom.count; ++i)
      if (mass(i, i) == 0) without.push_back(i);
    if (node.internal && !without.empty() && static_cast<int>(without.size()) == freedom.count)
      ++inner[node.name.substr(0, node.name.rfind('.'))];
    else if (without.size() == 6)
      text += fmt::format("  massless     node '{}'\n", node.name);
    else
      for (const int i : without) text += fmt::format("  massless     {}\n", system.unknown_name(i));
    if (const auto direction = massless_direction(system, values, k))
      text += fmt::format("  massless     {}\n", massless_name(system, k, *direction));
  }
  for (const auto& [element, count] : inner)
    text += fmt::format("  massless     {} inner node{} of '{}'\n", count, count == 1 ? "" : "s", element);
  if (text.find("massless") != std::string::npos)
    text += "               what has no mass must be held (`fixed`), joined to something, or given inertia by a body\n";
  return text;
}

}  // namespace

std::string describe_model(const MechanismFile& file) {
  const Model& model = file.model;
  System system(model);
  State state = system.start(0);
  const std::vector<int> redundant = take_out_redundant(system, model.environment, state);
  StartReport report;
  assemble_positions(system, model.environment, state, report);

  std::string text = fmt::format("{}\n", model.title.empty() ? "mechanism" : model.title);
  int internal = 0;
  for (const Node& node : model.nodes()) internal += node.internal;
  text += fmt::format("  nodes        {}{}\n", model.nodes().size() - static_cast<std::size_t>(internal),
                      internal > 0 ? fmt::format(" and {} inside of elements", internal) : "");
  // By the names that the user gave: a beam counts once, whatever it is divided into.
  std::map<std::string, std::map<std::string, std::set<std::string>>> counts;  // section -> type -> names
  for (const Member& member : model.members()) {
    const std::string& type = member.component->type();
    const bool own_section = type == "drive" || type == "load" || type == "event";
    if (own_section)
      counts[type + "s"][type].insert(member.component->name());
    else if (type.rfind("joint_", 0) == 0)  // what acts on their coordinates: several may act in one joint
      counts["in joints"][type.substr(6)].insert(fmt::format("{}", counts["in joints"][type.substr(6)].size()));
    else if (!member.group.empty())  // measures that formulas made for themselves have none
      counts[member.group.substr(0, member.group.find('/'))][type].insert(member.component->name());
  }
  for (const auto& [section, types] : counts) {
    text += fmt::format("  {:<12}", section);
    const char* separator = " ";
    for (const auto& [type, names] : types) {
      text += fmt::format("{}{} {}", separator, names.size(), type);
      separator = ", ";
    }
    text += "\n";
  }
  int independent = system.multipliers();
  system.for_each_idle(state, [&](int) { --independent; });
  text += fmt::format("  unknowns     {} displacements and amplitudes, {} first-order, {} multipliers\n", system.dofs(),
                      system.first_orders(), system.multipliers());
  text += fmt::format("  freedom      {} degrees of freedom after {} independent constraints\n",
                      system.dofs() - independent, independent);
  text += format_start(report);
  for (const std::string& names : name_constraints(system, redundant))
    text += fmt::format("  redundant    {}: set aside\n", names);
  if (const std::vector<std::string> joints = joints_not_unique(system, model.environment, state); !joints.empty())
    text += fmt::format("  reactions    {}\n", describe_not_unique(joints));
  text += describe_nodes(model, system, state);
  text += describe_elements(model);
  for (const Member& member : model.members()) {
    const auto* joint = dynamic_cast<const Joint*>(member.component.get());
    if (!joint) continue;
    const NodeState& first = state.nodes[static_cast<std::size_t>(joint->frames().first)];
    const Matrix3 axes = first.R * joint->frames().on_first.R;
    text += fmt::format("  joint '{}' ({}): at {}, x {}, z {}\n", joint->name(), joint->type(),
                        format_vector(first.x + first.R * joint->frames().on_first.x), format_vector(axes.col(0)),
                        format_vector(axes.col(2)));
  }
  return text;
}

std::string format_summary(const MechanismFile& file, const std::vector<AnalysisSummary>& summaries,
                           const std::vector<PhaseReport>& phases, const std::string& results_path) {
  std::string text = fmt::format("{}\n", file.model.title.empty() ? "mechanism" : file.model.title);
  for (const AnalysisSummary& summary : summaries) text += summary.text;
  for (const PhaseReport& phase : phases) text += fmt::format("  {:<12} {:8.2f} s\n", phase.name, phase.seconds);
  text += fmt::format("results: {}\n", results_path);
  return text;
}

}  // namespace bielle::mechanism

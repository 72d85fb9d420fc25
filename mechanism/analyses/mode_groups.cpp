#include "mechanism/analyses/mode_groups.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <sstream>

#include <fmt/format.h>

#include "mechanism/model/slender_component.hpp"

namespace bielle::mechanism {
namespace {

/// A group of entries whose names differ only in numbers, while the entries are gathered.
struct Gathered {
  ModeGroup group;
  std::map<std::string, std::vector<int>> nodes;  ///< nodes of each entry, by its name
};

void add_nodes(const std::vector<int>& of_member, std::vector<int>& nodes) {
  for (const int node : of_member)
    if (std::find(nodes.begin(), nodes.end(), node) == nodes.end()) nodes.push_back(node);
}

void begin_group(ModeGroup& group, Eigen::Index modes) {
  for (VectorX* sum : {&group.kinetic, &group.turning, &group.energy, &group.deformation, &group.extension,
                       &group.torsion, &group.bending_y, &group.bending_z, &group.flap, &group.edge})
    *sum = VectorX::Zero(modes);
}

void add_energies(const MemberEnergies& energies, Eigen::Index m, int softer_axis, ModeGroup& group) {
  group.kinetic += energies.kinetic.row(m).transpose();
  group.turning += energies.turning.row(m).transpose();
  group.energy += energies.kinetic.row(m).transpose();
  group.extension += energies.extension.row(m).transpose().cwiseAbs();
  group.torsion += energies.torsion.row(m).transpose().cwiseAbs();
  const VectorX y = energies.bending_y.row(m).transpose().cwiseAbs(),
                z = energies.bending_z.row(m).transpose().cwiseAbs();
  group.bending_y += y;
  group.bending_z += z;
  if (softer_axis == 0) return;
  group.flap += softer_axis == 1 ? y : z;
  group.edge += softer_axis == 1 ? z : y;
}

/// Names groups after their entries if their short names are the same.
void name_groups(const std::vector<Entry>& kinds, std::vector<ModeGroup>& groups) {
  const auto same = [&](const std::string& name) {
    return std::count_if(groups.begin(), groups.end(), [&](const ModeGroup& other) { return other.name == name; });
  };
  for (const bool with_section : {false, true}) {
    std::vector<std::size_t> ambiguous;
    for (std::size_t k = 0; k < groups.size(); ++k)
      if (same(groups[k].name) > 1) ambiguous.push_back(k);
    for (const std::size_t k : ambiguous)
      groups[k].name =
          with_section ? fmt::format("{} {}", section_noun(kinds[k].section), kinds[k].name) : kinds[k].name;
  }
}

}  // namespace

std::string with_stars(const std::string& name) {
  std::string pattern;
  for (const char c : name)
    if (std::isdigit(static_cast<unsigned char>(c)) == 0)
      pattern += c;
    else if (pattern.empty() || pattern.back() != '*')
      pattern += '*';
  return pattern;
}

std::string short_name(const std::string& starred) {
  std::string name, before;
  std::istringstream words(starred);
  for (std::string word; std::getline(words, word, '.');) {
    std::erase(word, '*');
    const auto is_link = [](char c) { return c == '_' || c == '-' || c == ' '; };
    while (!word.empty() && is_link(word.back())) word.pop_back();
    while (!word.empty() && is_link(word.front())) word.erase(word.begin());
    if (word.empty() || word == before) continue;
    name += (name.empty() ? "" : ".") + word;
    before = word;
  }
  return name.empty() ? starred : name;
}

std::vector<ModeGroup> mode_groups(const System& system, const ModesReport& report) {
  const MemberEnergies& energies = report.energies;
  std::map<Entry, Gathered> gathered;
  const auto& members = system.model().members();
  for (std::size_t k = 0; k < members.size(); ++k) {
    const auto m = static_cast<Eigen::Index>(k);
    if (energies.kinetic.row(m).isZero(0)) continue;
    const Entry& entry = members[k].entry;
    Gathered& found = gathered[{entry.section, with_stars(entry.name)}];
    if (found.nodes.empty()) begin_group(found.group, energies.kinetic.cols());
    const Slots& slots = system.slots()[k];
    add_nodes(slots.nodes, found.nodes[entry.name]);
    const auto* slender = dynamic_cast<const SlenderComponent*>(members[k].component.get());
    found.group.flexible = found.group.flexible || slender || slots.amplitudes > 0;
    if (slots.amplitudes > 0) found.group.deformation += energies.potential.row(m).transpose().cwiseAbs();
    add_energies(energies, m, slender ? slender->softer_axis() : 0, found.group);
  }
  // The potential energy of an entry is the sum over its members, whose contributions may cancel.
  std::map<Entry, VectorX> potential;
  for (std::size_t k = 0; k < members.size(); ++k) {
    const auto m = static_cast<Eigen::Index>(k);
    const auto [sum, added] = potential.try_emplace(members[k].entry, VectorX::Zero(energies.potential.cols()));
    sum->second += energies.potential.row(m).transpose();
  }
  for (const auto& [entry, sum] : potential)
    if (const auto found = gathered.find({entry.section, with_stars(entry.name)}); found != gathered.end())
      found->second.group.energy += sum.cwiseAbs();
  std::vector<Entry> kinds;
  std::vector<ModeGroup> groups;
  for (auto& [kind, found] : gathered) {
    for (const auto& [entry, nodes] : found.nodes) found.group.nodes.push_back(nodes);
    found.group.name = found.nodes.size() == 1 ? found.nodes.begin()->first : short_name(kind.name);
    kinds.push_back(found.nodes.size() == 1 ? Entry{kind.section, found.nodes.begin()->first} : kind);
    ModeGroup& group = groups.emplace_back(std::move(found.group));
    group.deformation += group.extension + group.torsion + group.bending_y + group.bending_z;
  }
  name_groups(kinds, groups);
  return groups;
}

}  // namespace bielle::mechanism

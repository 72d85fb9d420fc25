#include "mechanism/analyses/mode_names.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "mechanism/analyses/campbell_arrays.hpp"
#include "mechanism/solvers/newton/model_length.hpp"

namespace bielle::mechanism {
namespace {

/// Replaces each number in a name by a star.
std::string with_stars(const std::string& name) {
  std::string pattern;
  for (const char c : name)
    if (std::isdigit(static_cast<unsigned char>(c)) == 0)
      pattern += c;
    else if (pattern.empty() || pattern.back() != '*')
      pattern += '*';
  return pattern;
}

/// Entries with a common name, and the nodes of their members.
struct EntryGroup {
  std::set<std::string> entries;
  std::set<int> nodes;
  VectorX kinetic;  ///< in each mode
  std::string name() const { return entries.size() == 1 ? *entries.begin() : with_stars(*entries.begin()); }
};

std::vector<EntryGroup> entry_groups(const System& system, const ModesReport& report) {
  std::map<std::pair<Section, std::string>, EntryGroup> groups;
  const auto& members = system.model().members();
  for (std::size_t m = 0; m < members.size(); ++m) {
    const VectorX kinetic = report.energies.kinetic.row(static_cast<Eigen::Index>(m)).transpose();
    if (kinetic.isZero(0)) continue;
    const Entry& entry = members[m].entry;
    EntryGroup& group = groups[{entry.section, with_stars(entry.name)}];
    if (group.entries.empty()) group.kinetic = VectorX::Zero(kinetic.size());
    group.entries.insert(entry.name);
    group.kinetic += kinetic;
    group.nodes.insert(system.slots()[m].nodes.begin(), system.slots()[m].nodes.end());
  }
  std::vector<EntryGroup> list;
  for (auto& [key, group] : groups) list.push_back(std::move(group));
  return list;
}

/// Sums of squares of the displacements and rotations of nodes along three directions.
struct Motions {
  Vector3 displacement = Vector3::Zero(), rotation = Vector3::Zero();
};

Motions motions_of(const EntryGroup& group, const NodeShapes& shapes) {
  Motions sums;
  for (const int node : group.nodes) {
    sums.displacement += shapes.displacement.col(node).cwiseAbs2();
    sums.rotation += shapes.rotation.col(node).cwiseAbs2();
  }
  return sums;
}

constexpr double hardly_moves = 1e-2;  // displacement of a part that turns about itself, by rotation and extent

std::string direction_of(const Motions& motions, double length) {
  static const char* const axes[] = {"x", "y", "z"};
  Eigen::Index along = 0, about = 0;
  const double moved = motions.displacement.maxCoeff(&along), turned = motions.rotation.maxCoeff(&about);
  return moved > std::pow(hardly_moves * length, 2) * turned ? fmt::format("along {}", axes[along])
                                                             : fmt::format("about {}", axes[about]);
}

std::string direction_behind_joint(const EntryGroup& group, const NodeShapes& shapes, const Vector3& axis,
                                   double length) {
  double along = 0, across = 0, about = 0, tilting = 0;
  for (const int node : group.nodes) {
    const Eigen::Vector3cd moved = shapes.displacement.col(node);
    const double part = std::norm(axis.cast<std::complex<double>>().dot(moved));
    along += part;
    across += moved.squaredNorm() - part;
    const Eigen::Vector3cd turned = shapes.rotation.col(node);
    const double spin = std::norm(axis.cast<std::complex<double>>().dot(turned));
    about += spin;
    tilting += turned.squaredNorm() - spin;
  }
  if (along + across <= std::pow(hardly_moves * length, 2) * (about + tilting))
    return about > tilting ? "about the axis" : "tilting";
  return along > across ? "along the axis" : "across the axis";
}

}  // namespace

std::vector<std::string> mode_names(const System& system, const ModesReport& report, const ModeParts& parts) {
  std::vector<std::string> names;
  if (parts.names.empty()) return std::vector<std::string>(report.found.modes.size());
  const std::vector<EntryGroup> groups = entry_groups(system, report);
  const State& state = report.about.state;
  for (std::size_t k = 0; k < report.found.modes.size(); ++k) {
    const EntryGroup* most = nullptr;
    const auto mode = static_cast<Eigen::Index>(k);
    for (const EntryGroup& group : groups)
      if (!most || group.kinetic[mode] > most->kinetic[mode]) most = &group;
    if (!most) {
      names.emplace_back();
      continue;
    }
    const NodeShapes shapes = node_shapes(system, state, report.found.modes[k]);
    bool behind = report.turning.has_value();
    for (const int node : most->nodes) behind = behind && report.turning_nodes[static_cast<std::size_t>(node)] != 0;
    std::string name = most->name() + " ";
    name += behind ? direction_behind_joint(*most, shapes, report.turning_axis, model_extent(state))
                   : direction_of(motions_of(*most, shapes), model_extent(state));
    const bool oscillates = report.found.modes[k].s.imag() > 0;
    if (const double whirl = report.turning_whirl(system, k); oscillates && !std::isnan(whirl))
      name += fmt::format(", {}", whirl_name(whirl));
    names.push_back(std::move(name));
  }
  return names;
}

std::vector<std::string> numbered_names(const std::vector<std::string>& names, const std::vector<double>& rates) {
  std::vector<std::string> numbered = names;
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (names[k].empty() || std::count(names.begin(), names.end(), names[k]) == 1) continue;
    int number = 1;
    for (std::size_t j = 0; j < names.size(); ++j)
      if (names[j] == names[k] && (rates[j] < rates[k] || (rates[j] == rates[k] && j < k))) ++number;
    const bool teen = number % 100 / 10 == 1;
    const char* const ending[] = {"th", "st", "nd", "rd"};
    numbered[k] += fmt::format(", {}{}", number, teen || number % 10 > 3 ? "th" : ending[number % 10]);
  }
  return numbered;
}

}  // namespace bielle::mechanism

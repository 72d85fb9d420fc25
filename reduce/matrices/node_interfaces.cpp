#include "reduce/matrices/node_interfaces.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reduce/common/counted.hpp"
#include "reduce/common/direction_words.hpp"
#include "reduce/common/error.hpp"
#include "reduce/fe/relative_weights.hpp"
#include "reduce/fe/weighted_nodes.hpp"
#include "reduce/reduction/ties.hpp"

namespace bielle::reduce {

namespace {

constexpr std::size_t most_default_interfaces = 200;

/// Returns the motion of a node (translation, then rotation, body axes) for one direction of an interface.
Eigen::Matrix<double, 6, 1> carried_motion(const Interface& interface, int axis, const Eigen::Vector3d& node) {
  const Eigen::Vector3d unit = interface.rotation.col(axis % 3);
  Eigen::Matrix<double, 6, 1> motion;
  if (axis < 3)
    motion << unit, Eigen::Vector3d::Zero();
  else
    motion << unit.cross(node - interface.position), unit;
  return motion;
}

class NodeTieMaker {
 public:
  explicit NodeTieMaker(const MatrixSet& set)
      : set_(set),
        unknown_of_(set.numbers.size(), {-1, -1, -1, -1, -1, -1}),
        owner_(set.numbers.size(), -1),
        is_carried_(set.unknowns.size(), false) {
    for (std::size_t k = 0; k < set.unknowns.size(); ++k)
      if (const NodalUnknown& u = set.unknowns[k]; !u.is_scalar())
        unknown_of_[static_cast<std::size_t>(u.node)][static_cast<std::size_t>(u.component)] =
            static_cast<Eigen::Index>(k);
  }

  void add(const NodeInterface& request) {
    if (!names_.insert(request.name).second)
      throw InputError(fmt::format("there are two interfaces '{}'", request.name));
    std::vector<int> nodes;
    for (const std::int64_t number : request.nodes) nodes.push_back(node_index(set_, number));
    for (const int node : nodes) own(node, request.nodes.size());
    if (nodes.size() == 1 && request.tie == Tie::rigid && !request.position)
      add_node(request, nodes.front());
    else if (request.tie == Tie::average)
      add_average(request, nodes);
    else
      add_rigid(request, nodes);
    ++count_;
  }

  NodeTies finish() {
    for (std::size_t k = 0; k < is_carried_.size(); ++k)
      if (!is_carried_[k]) {
        inside_.emplace_back(static_cast<int>(k), static_cast<int>(ties_.inner.size()), 1.0);
        ties_.inner.push_back(static_cast<Eigen::Index>(k));
      }
    const auto made = [&](const std::vector<Eigen::Triplet<double>>& entries, std::size_t columns) {
      SparseColumns result(set_.size(), static_cast<Eigen::Index>(columns));
      result.setFromTriplets(entries.begin(), entries.end());
      return result;
    };
    ties_.carry = made(carry_, static_cast<std::size_t>(kept_));
    ties_.inside = made(inside_, ties_.inner.size());
    ties_.spread = made(spread_, ties_.averages.size());
    return std::move(ties_);
  }

 private:
  void own(int node, std::size_t nodes) {
    int& owner = owner_[static_cast<std::size_t>(node)];
    if (owner == count_)
      throw InputError(fmt::format("node {} stands twice among its {}", set_.numbers[static_cast<std::size_t>(node)],
                                   counted(nodes, "node")));
    if (owner >= 0)
      throw InputError(fmt::format("node {} belongs to the interface '{}' already; interfaces must not share nodes",
                                   set_.numbers[static_cast<std::size_t>(node)],
                                   ties_.interfaces[static_cast<std::size_t>(owner)].name));
    owner = count_;
  }

  const std::array<Eigen::Index, 6>& unknowns_at(int node) const { return unknown_of_[static_cast<std::size_t>(node)]; }

  /// Returns whether the node has the unknowns to move in a direction: that unknown for a direction along its axis, all
  /// three for any other one.
  bool is_movable(int node, const Eigen::Matrix3d& rotation, int axis) const {
    const int first = axis < 3 ? 0 : 3;
    const Eigen::Vector3d along = set_.axes[static_cast<std::size_t>(node)].transpose() * rotation.col(axis - first);
    for (int c = 0; c < 3; ++c)
      if (std::abs(along(c)) > 1e-9 && unknowns_at(node)[static_cast<std::size_t>(first + c)] < 0) return false;
    return true;
  }

  std::string directions_of(int node) const {
    std::vector<std::string> words;
    for (std::size_t c = 0; c < 6; ++c)
      if (unknowns_at(node)[c] >= 0) words.emplace_back(direction_words[c]);
    return words.empty() ? "none" : fmt::format("{}", fmt::join(words, ", "));
  }

  void add_node(const NodeInterface& request, int node) {
    Interface interface { request.name, set_.positions.col(node) };
    interface.rotation = request.rotation.value_or(set_.axes[static_cast<std::size_t>(node)]);
    for (int axis = 0; axis < 6; ++axis) {
      const bool movable = is_movable(node, interface.rotation, axis);
      const bool wanted = request.kept ? (*request.kept)[static_cast<std::size_t>(axis)] : movable;
      if (wanted && !movable)
        throw InputError(
            fmt::format("node {} has no unknown for the direction {}; it has {}. To hold rotations of "
                        "nodes without them, tie several nodes",
                        set_.numbers[static_cast<std::size_t>(node)], direction_words[static_cast<std::size_t>(axis)],
                        directions_of(node)));
      interface.kept[static_cast<std::size_t>(axis)] = wanted;
    }
    require_kept(interface);
    move_node(interface, node);
    ties_.interfaces.push_back(interface);
  }

  /// Replaces the unknowns of a node by its directions: kept ones, then interior ones.
  void move_node(const Interface& interface, int node) {
    for (int axis = 0; axis < 6; ++axis) {
      const bool kept = interface.kept[static_cast<std::size_t>(axis)];
      const bool released = !kept && is_movable(node, interface.rotation, axis);
      if (!kept && !released) continue;
      const int column = kept ? kept_++ : new_interior();
      add_motion(node, carried_motion(interface, axis, interface.position), kept ? carry_ : inside_, column);
    }
    mark_carried(node);
  }

  void add_rigid(const NodeInterface& request, const std::vector<int>& nodes) {
    const Interface interface = tied_interface(request, nodes);
    for (int axis = 0; axis < 6; ++axis) {
      const bool kept = interface.kept[static_cast<std::size_t>(axis)];
      const int column = kept ? kept_++ : new_interior();
      for (const int node : nodes)
        add_motion(node, carried_motion(interface, axis, set_.positions.col(node)), kept ? carry_ : inside_, column);
    }
    for (const int node : nodes) mark_carried(node);
    ties_.interfaces.push_back(interface);
  }

  void add_average(const NodeInterface& request, const std::vector<int>& nodes) {
    for (const int node : nodes)
      if (!is_movable(node, Eigen::Matrix3d::Identity(), 0) || !is_movable(node, Eigen::Matrix3d::Identity(), 1) ||
          !is_movable(node, Eigen::Matrix3d::Identity(), 2))
        throw InputError(fmt::format("an average tie needs the three translations of its nodes; node {} has {}",
                                     set_.numbers[static_cast<std::size_t>(node)], directions_of(node)));
    const SurfaceIntegrals surface = weighted(request, nodes);
    NodeInterface placed = request;
    if (!placed.position) placed.position = surface.centroid;
    const Interface interface = tied_interface(placed, nodes);
    for (int axis = 0; axis < 6; ++axis) {
      if (!interface.kept[static_cast<std::size_t>(axis)]) continue;
      const Eigen::Matrix3Xd forces = spread_unit_load(surface, interface, axis);
      const int column = static_cast<int>(ties_.averages.size());
      for (std::size_t a = 0; a < surface.nodes.size(); ++a) {
        Eigen::Matrix<double, 6, 1> force = Eigen::Matrix<double, 6, 1>::Zero();
        force.head<3>() = forces.col(static_cast<Eigen::Index>(a));
        add_motion(surface.nodes[a], force, spread_, column);
      }
      ties_.averages.push_back(kept_++);
    }
    ties_.interfaces.push_back(interface);
  }

  SurfaceIntegrals weighted(const NodeInterface& request, const std::vector<int>& nodes) const {
    std::vector<std::size_t> order(nodes.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return nodes[a] < nodes[b]; });
    const std::vector<double> weights = relative_weights(request.weights);
    Mesh mesh;
    mesh.points = set_.positions;
    Group& group = mesh.groups["nodes"];
    for (const std::size_t k : order) {
      group.nodes.push_back(nodes[k]);
      group.weights.push_back(weights.empty() ? 1.0 : weights[k]);
    }
    return integrate_tied(mesh, "nodes");
  }

  Interface tied_interface(const NodeInterface& request, const std::vector<int>& nodes) const {
    Interface interface {
      request.name, request.position.value_or(Eigen::Vector3d(set_.positions(Eigen::all, nodes).rowwise().mean()))
    };
    interface.rotation = request.rotation.value_or(Eigen::Matrix3d::Identity());
    if (request.kept) interface.kept = *request.kept;
    require_kept(interface);
    return interface;
  }

  static void require_kept(const Interface& interface) {
    if (std::none_of(interface.kept.begin(), interface.kept.end(), [](bool kept) { return kept; }))
      throw InputError("it has no unknowns by which it could hold the body");
  }

  /// Adds a motion (or forces) of a node, body axes, to a column in terms of the node's unknowns.
  void add_motion(int node, const Eigen::Matrix<double, 6, 1>& motion, std::vector<Eigen::Triplet<double>>& into,
                  int column) const {
    const Eigen::Matrix3d& axes = set_.axes[static_cast<std::size_t>(node)];
    for (int c = 0; c < 6; ++c) {
      const Eigen::Index unknown = unknowns_at(node)[static_cast<std::size_t>(c)];
      const double value = axes.col(c % 3).dot(c < 3 ? motion.head<3>() : motion.tail<3>());
      if (unknown >= 0 && value != 0) into.emplace_back(static_cast<int>(unknown), column, value);
    }
  }

  void mark_carried(int node) {
    for (const Eigen::Index unknown : unknowns_at(node))
      if (unknown >= 0) is_carried_[static_cast<std::size_t>(unknown)] = true;
  }

  int new_interior() {
    ties_.inner.push_back(-1);
    return static_cast<int>(ties_.inner.size()) - 1;
  }

  const MatrixSet& set_;
  std::vector<std::array<Eigen::Index, 6>> unknown_of_;  // by node; -1: the node has none
  std::vector<int> owner_;                               // interface of each node
  std::vector<bool> is_carried_;                         // by unknown
  std::set<std::string> names_;
  std::vector<Eigen::Triplet<double>> carry_, inside_, spread_;
  NodeTies ties_;
  int count_ = 0, kept_ = 0;
};

}  // namespace

int node_index(const MatrixSet& set, std::int64_t number) {
  const auto found = std::find(set.numbers.begin(), set.numbers.end(), number);
  if (found != set.numbers.end()) return static_cast<int>(found - set.numbers.begin());
  std::vector<std::int64_t> nearest = set.numbers;
  const std::size_t shown = std::min<std::size_t>(5, nearest.size());
  std::partial_sort(nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(shown), nearest.end(),
                    [&](std::int64_t a, std::int64_t b) { return std::abs(a - number) < std::abs(b - number); });
  nearest.resize(shown);
  throw InputError(fmt::format("the file has no node {}; the nearest are {}", number, fmt::join(nearest, ", ")));
}

std::string name_of_kept(const std::vector<Interface>& interfaces, Eigen::Index kept) {
  Eigen::Index next = 0;
  for (const Interface& interface : interfaces)
    for (std::size_t axis = 0; axis < 6; ++axis)
      if (interface.kept[axis] && next++ == kept) return fmt::format("{} {}", interface.name, direction_words[axis]);
  return "";
}

std::vector<NodeInterface> default_interfaces(const MatrixSet& set) {
  std::vector<NodeInterface> result;
  const auto add = [&](const std::string& name, int node) {
    NodeInterface interface;
    interface.name = name;
    interface.nodes = {set.numbers[static_cast<std::size_t>(node)]};
    result.push_back(interface);
  };
  // In the order of their first unknowns.
  std::map<int, std::string> names;
  for (const auto& [name, node] : set.interfaces) names[node] = name;
  std::set<int> seen;
  for (const NodalUnknown& u : set.unknowns) {
    if (u.is_scalar() || !seen.insert(u.node).second) continue;
    const auto named = names.find(u.node);
    if (named != names.end())
      add(named->second, u.node);
    else if (names.empty())
      add(fmt::format("node_{}", set.numbers[static_cast<std::size_t>(u.node)]), u.node);
    if (result.size() > most_default_interfaces)
      throw InputError(
          fmt::format("{} has more than {} nodes with unknowns: these are full matrices, for which a body file names "
                      "the interfaces "
                      "(key `matrices`)",
                      set.source, most_default_interfaces));
  }
  if (result.empty()) throw InputError(fmt::format("{} has no node that could be an interface", set.source));
  return result;
}

NodeTies tie_nodes(const MatrixSet& set, const std::vector<NodeInterface>& requests) {
  NodeTieMaker maker(set);
  for (const NodeInterface& request : requests) about(request.subject, [&] { maker.add(request); });
  return maker.finish();
}

}  // namespace bielle::reduce

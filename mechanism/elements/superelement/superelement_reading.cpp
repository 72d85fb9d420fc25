#include "mechanism/elements/superelement/superelement_reading.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "mechanism/reading/names.hpp"
#include "mechanism/reading/read_frame.hpp"
#include "mechanism/reading/start_motion.hpp"
#include "reduce/common/input/plausible.hpp"
#include "reduce/dense/dense_solves.hpp"
#include "reduce/superelement/modal_damping.hpp"

namespace bielle::mechanism {
namespace {

/// Permitted distance of a node from its interface, relative to the body's size: positions in input files have a few
/// digits. The remaining distance becomes part of the undeformed body, so that it starts without stress.
constexpr double position_tolerance = 1e-5;

std::string text_of(const Vector3& x) { return fmt::format("[{:.9g}, {:.9g}, {:.9g}]", x.x(), x.y(), x.z()); }

double size_of(const Superelement& body) {
  double size = std::sqrt(body.inertia.trace() / body.total_mass);
  for (const Interface& interface : body.interfaces) size = std::max(size, (interface.position - body.centre).norm());
  return size;
}

int kept_rotations(const Interface& interface) {
  return static_cast<int>(std::count(interface.kept.begin() + 3, interface.kept.end(), true));
}

/// Checks that named nodes are at their interfaces.
void check_position(const YamlValue& value, const Node& node, const Interface& interface, const Superelement& body,
                    const Vector3& expected, bool placed) {
  const double distance = (node.frame.x - expected).norm();
  if (distance <= position_tolerance * size_of(body)) return;
  std::string message =
      fmt::format("node '{}' stands at {}, but interface '{}' of '{}' at {}, {:.3g} m away", node.name,
                  text_of(node.frame.x), interface.name, body.name, text_of(expected), distance);
  if (!placed)
    message += "; the body stands as meshed: `position` and an orientation (such as `rotation_vector`) place it";
  value.fail(message);
}

/// Creates a node for an interface for which the file names none.
int create_node(const std::string& name, const YamlValue& entry, const Interface& interface, const Frame& placement,
                Model& model) {
  const auto kept = std::count(interface.kept.begin(), interface.kept.begin() + 3, true);
  const int rotations = kept_rotations(interface);
  if (kept != 3 || (rotations != 0 && rotations != 3))
    entry.fail(
        fmt::format("interface '{}' leaves some directions of its node free: name a node for it under `nodes` and "
                    "hold or use those directions there",
                    interface.name));
  Node node;
  node.name = name + "." + interface.name;
  if (model.find_node(node.name)) entry.fail(fmt::format("there is already a node '{}'", node.name));
  node.frame = placement * Frame{interface.position, interface.rotation};
  // A node that only transmits forces must not rotate.
  if (rotations == 0) std::fill(node.freedom.begin() + 3, node.freedom.end(), Freedom::fixed);
  return model.add_node(std::move(node));
}

/// Returns the rigid motion, at a place, that is closest to that of nodes.
StartMotion rigid_motion_of(const Model& model, const RigidlyFollowed& followed, const Vector3& place) {
  Matrix6 normal = Matrix6::Zero();
  Vector6 right = Vector6::Zero();
  const double area = followed.size * followed.size;
  for (std::size_t k = 0; k < followed.nodes.size(); ++k) {
    const StartMotion node = start_motion(model, followed.nodes[k]);
    Eigen::Matrix<double, 3, 6> rows;
    rows << Matrix3::Identity(), -skew(node.x - place);
    normal += rows.transpose() * rows;
    right += rows.transpose() * node.v;
    if (!followed.turns[k]) continue;
    normal.bottomRightCorner<3, 3>() += area * Matrix3::Identity();
    right.tail<3>() += area * node.omega;
  }
  // The rotation is zero about an axis that the nodes do not determine (because they are on one line). The refinement
  // reduces the error of all other components to rounding.
  constexpr double little = 1e-12;
  Matrix6 regular = normal;
  regular.bottomRightCorner<3, 3>() += little * area * Matrix3::Identity();
  Vector6 motion = solve_symmetric(regular, right);
  motion += solve_symmetric(regular, Vector6(right - normal * motion));
  return {place, motion.head<3>(), motion.tail<3>()};
}

}  // namespace

void follow_rigidly(int node, const RigidlyFollowed& followed, Model& model) {
  if (followed.nodes.empty()) return;
  when_motion_is_known(model, [node, followed, &model] {
    if (model.node(node).carrier) return;
    set_start_motion(model, node, rigid_motion_of(model, followed, model.node(node).frame.x));
  });
}

MatrixX read_superelement_damping(const YamlValue& entry, const Superelement& body) {
  if (entry.has("ratio") == entry.has("rayleigh")) entry.fail("expected either `ratio` or `rayleigh`");
  if (const auto rayleigh = entry.find("rayleigh")) {
    if (!rayleigh->is_sequence() || rayleigh->size() != 2)
      rayleigh->fail("expected [alpha, beta]: alpha [1/s] times the mass plus beta [s] times the stiffness");
    const VectorX factors = rayleigh->vector();
    return rayleigh_damping(body, factors[0], factors[1]);
  }
  const YamlValue ratio = entry.at("ratio");
  std::vector<double> ratios;
  if (ratio.is_sequence())
    for (const YamlValue& item : ratio.items()) ratios.push_back(item.number());
  else
    ratios.push_back(ratio.number());
  for (const double each : ratios) warn_outside(ratio, each, plausible_damping_ratio);
  try {
    return modal_damping(body, ratios);
  } catch (const InputError& error) {
    ratio.fail(error.what());
  }
}

void read_body_frame(const YamlValue& entry, const Superelement& body, SuperelementPlacement& setup) {
  if (!entry.is_map()) {
    setup.frame = entry.word() == "mean" ? BodyFrame::mean : BodyFrame::mean_axes;
    return;
  }
  const YamlValue value = entry.at("interface");
  const std::string name = value.text();
  std::vector<std::string> interfaces;
  for (const Interface& interface : body.interfaces) interfaces.push_back(interface.name);
  const auto found = std::find(interfaces.begin(), interfaces.end(), name);
  if (found == interfaces.end())
    value.fail(fmt::format("'{}' is no interface of '{}'{}", name, body.name, did_you_mean(name, interfaces)));
  setup.frame = BodyFrame::carried;
  setup.frame_interface = static_cast<std::size_t>(found - interfaces.begin());
}

std::vector<SuperelementPlacement::Load> read_superelement_loads(const YamlValue& entry, const Superelement& body) {
  std::vector<std::string> names;
  for (const auto& [name, pattern] : body.loads) names.push_back(name);
  std::vector<SuperelementPlacement::Load> loads;
  for (const auto& [name, value] : entry.entries()) {
    if (!body.loads.count(name))
      value.fail(names.empty()
                     ? fmt::format("'{}' has no load patterns", body.name)
                     : fmt::format("'{}' is no load pattern of '{}'{}", name, body.name, did_you_mean(name, names)));
    SuperelementPlacement::Load load;
    load.pattern = name;
    if (value.is_map()) {
      load.factor = value.at("factor").expression();
      load.follows = value.at("follower").boolean();
    } else {
      load.factor = value.expression();
    }
    loads.push_back(std::move(load));
  }
  return loads;
}

std::vector<int> read_interface_nodes(const std::string& name, const YamlValue& entry, const Superelement& body,
                                      const Frame& placement, Model& model) {
  const std::vector<Key> of_frame = frame_keys();
  const bool placed =
      std::any_of(of_frame.begin(), of_frame.end(), [&](const Key& key) { return entry.has(key.name); });
  std::vector<std::string> interfaces;
  for (const Interface& interface : body.interfaces) interfaces.push_back(interface.name);
  std::vector<int> nodes(interfaces.size(), -1);
  if (const auto named = entry.find("nodes"))
    for (const auto& [interface, value] : named->entries()) {
      const auto found = std::find(interfaces.begin(), interfaces.end(), interface);
      if (found == interfaces.end())
        value.fail(
            fmt::format("'{}' is no interface of '{}'{}", interface, body.name, did_you_mean(interface, interfaces)));
      const auto k = static_cast<std::size_t>(found - interfaces.begin());
      nodes[k] = node_named_by(value, model);
      check_position(value, model.node(nodes[k]), body.interfaces[k], body,
                     (placement * Frame{body.interfaces[k].position, Matrix3::Identity()}).x, placed);
    }
  RigidlyFollowed named{{}, {}, size_of(body)};
  for (std::size_t k = 0; k < nodes.size(); ++k)
    if (nodes[k] >= 0) named.add(nodes[k], kept_rotations(body.interfaces[k]) > 0);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (nodes[k] >= 0) continue;
    nodes[k] = create_node(name, entry, body.interfaces[k], placement, model);
    follow_rigidly(nodes[k], named, model);
  }
  return nodes;
}

SuperelementPlacement place_superelement(std::vector<int> nodes, const Frame& placement, const Model& model) {
  SuperelementPlacement setup;
  for (const int index : nodes) {
    const Node& node = model.node(index);
    const Frame in_body = inverse(placement) * node.frame;
    setup.reference_positions.push_back(in_body.x);
    setup.reference_rotations.push_back(in_body.R);
    setup.node_names.push_back(node.name);
  }
  setup.nodes = std::move(nodes);
  return setup;
}

}  // namespace bielle::mechanism

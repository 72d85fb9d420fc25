// A mechanism as described, before it is numbered: named nodes and components. Readers of input files fill it.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "mechanism/math/se3.hpp"
#include "mechanism/system/component.hpp"
#include "reduce/common/expression.hpp"
#include "reduce/common/yaml_file.hpp"

namespace bielle::mechanism {

/// How a direction of a node (x y z rx ry rz) moves.
enum class Freedom { free, fixed, prescribed };

/// A node: start values and how it is held.
struct Node {
  std::string name;
  Frame frame;                                 ///< start position and axes (node -> inertial)
  Vector3 velocity = Vector3::Zero();          ///< start [m/s], inertial
  Vector3 angular_velocity = Vector3::Zero();  ///< start [rad/s], node axes
  std::array<Freedom, 6> freedom{};
  /// Prescribed translations are displacements added to the start position [m]; prescribed rotations the components of
  /// a rotation vector [rad] about inertial axes, applied to the start axes: R = exp(psi(t)) R_start.
  std::array<Expression, 6> motion;
  std::optional<int> carrier;  ///< rigidly carried by this node, at the relative position of the start
  bool internal = false;       ///< made by an element (inside of a beam): recorded with it, not under /nodes
};

/// A component with the place of its results.
struct Member {
  std::unique_ptr<Component> component;
  std::string group;     ///< results group: "joints/main", "elements/shaft"; empty: records nothing
  bool stacked = false;  ///< one of several alike in the group, whose records form an array (elements of a beam)
};

/// A chain of nodes recorded together as (rows, nodes, 3) positions and (rows, nodes, 4) quaternions (a beam).
struct Chain {
  std::string group;
  std::vector<int> nodes;
};

class Model {
 public:
  Model();  ///< holds the built-in fixed node `ground` (index 0) at the origin

  int add_node(Node node);  ///< @throws InputError when the name is taken
  const Node& node(int index) const { return nodes_[static_cast<std::size_t>(index)]; }
  Node& node(int index) { return nodes_[static_cast<std::size_t>(index)]; }
  const std::vector<Node>& nodes() const { return nodes_; }
  std::optional<int> find_node(const std::string& name) const;
  /// The node that a value of the input file names. @throws InputError with the nearest name
  int node_named_by(const YamlValue& value) const;
  /// The value must be a list of exactly `count` node names.
  std::vector<int> nodes_named_by(const YamlValue& value, std::size_t count) const;

  /// Adds a component. @param group see Member
  Component& add(std::unique_ptr<Component> component, const std::string& group, bool stacked = false);
  void add_chain(const std::string& group, std::vector<int> nodes) { chains_.push_back({group, std::move(nodes)}); }
  const std::vector<Member>& members() const { return members_; }
  const std::vector<Chain>& chains() const { return chains_; }
  /// The component recorded under `section`/`name` that a value of the input file names ("joints": drives name joints).
  /// @throws InputError with the nearest name
  Component& component_named_by(const YamlValue& value, const std::string& section);
  std::vector<std::string> names_in(const std::string& section) const;  ///< in the order of the file, each once
  /// The components recorded in a group ("elements/shaft").
  std::vector<Component*> components_in(const std::string& group);

  /// The elements and joints of a name, in the order of the file.
  std::vector<Component*> components_named(const std::string& name) const;

  /// What entries of the input file need of others is looked up when all of them are read: first what components are
  /// made of others, then formulas and measures.
  enum class Stage { connections, formulas };
  void when_read(Stage stage, std::function<void()> action);
  /// All entries are read: does what waits. @throws what it throws
  void connect();

  /// A measure that the user has named: made when somebody asks for it, at the latest by connect().
  void announce_measure(const std::string& name, std::function<void()> make);
  /// @param recorded  among the results, under its name
  Measure& add_measure(std::unique_ptr<Measure> measure, bool recorded);
  /// A measure by its name, made now if it is announced, or nullptr. @throws InputError when it is being made already
  const Measure* find_measure(const std::string& name);
  std::vector<std::string> announced_measures() const;

  /// Takes a results group ("nodes/pin", "joints/main", "elements/shaft") out of what is recorded.
  void leave_out(const std::string& group) { left_out_.insert(group); }
  bool records(const std::string& group) const { return !left_out_.contains(group); }

  Environment environment;  ///< gravity with load factor 1
  std::string title;
  Parameters parameters;  ///< of the input file, overrides included

 private:
  std::vector<Node> nodes_;
  std::map<std::string, int> node_index_;
  std::vector<Member> members_;
  std::vector<Chain> chains_;
  std::set<std::string> left_out_;
  std::array<std::vector<std::function<void()>>, 2> waiting_;  ///< by stage
  struct AnnouncedMeasure {
    std::string name;
    std::function<void()> make;
    bool under_way = false;
  };
  std::vector<AnnouncedMeasure> announced_;
  std::map<std::string, const Measure*> measures_;
};

/// Reads one entry of a section of the mechanism file (`name: {type: ..., ...}`) into the model. Each component type
/// has one, in its own file; io/component_table lists them.
using ComponentReader = void (*)(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism

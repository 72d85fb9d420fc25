// A mechanism as described, before its unknowns are numbered: named nodes and components. The readers of input files
// build it.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "mechanism/drawing/drawn_item.hpp"
#include "mechanism/math/se3.hpp"
#include "mechanism/model/component.hpp"
#include "mechanism/model/entry.hpp"
#include "mechanism/model/prescribed_motion.hpp"
#include "reduce/common/error.hpp"
#include "reduce/common/formula/expression.hpp"

namespace bielle::mechanism {

/// Motion of a direction of a node (x y z rx ry rz).
enum class Freedom { free, fixed, prescribed };

/// A node: start values, and supports of its directions.
struct Node {
  std::string name;
  Frame frame;                                 ///< start position and axes (node -> inertial)
  Vector3 velocity = Vector3::Zero();          ///< start velocity [m/s], inertial
  Vector3 angular_velocity = Vector3::Zero();  ///< start angular velocity [rad/s], node axes
  std::array<Freedom, 6> freedom{};
  /// Prescribed translations are displacements added to the start position [m]; prescribed rotations the components of
  /// a rotation vector [rad] about inertial axes, applied to the start axes: R = exp(psi(t)) R_start.
  std::array<PrescribedMotion, 6> motion;
  std::optional<int> carrier;  ///< node that carries this one rigidly, at the relative position of the start
  bool internal = false;       ///< created by an element (inside of a beam): recorded with it, not under /nodes
};

/// How the results of a component are stored under the name of an entry: not at all, alone, or as one row of an array
/// over several similar components (elements of a beam).
enum class Recorded { no, alone, stacked };

/// A component with its identity and the path of its results.
struct Member {
  std::unique_ptr<Component> component;
  Entry entry;    ///< entry that it was created from
  Entry results;  ///< entry under whose name its results are stored: its own, or the joint that a drive acts in
  Recorded recorded = Recorded::alone;
};

/// A chain of nodes recorded together as (rows, nodes, 3) positions and (rows, nodes, 4) quaternions (a beam).
struct Chain {
  Entry entry;
  std::vector<int> nodes;
};

class Model {
 public:
  Model();  ///< contains the built-in fixed node `ground` (index 0) at the origin

  int add_node(Node node);  ///< @throws InputError if the name is taken
  const Node& node(int index) const { return nodes_[static_cast<std::size_t>(index)]; }
  Node& node(int index) { return nodes_[static_cast<std::size_t>(index)]; }
  const std::vector<Node>& nodes() const { return nodes_; }
  std::optional<int> find_node(const std::string& name) const;
  /// Returns the node that carries a node rigidly, directly or over other nodes; the node itself if none does.
  int root_carrier(int node) const;

  /// Adds a component that is created from an entry. Several components may be created from one entry (the joint first,
  /// then its springs).
  Component& add(std::unique_ptr<Component> component, const Entry& entry, Recorded recorded = Recorded::alone);
  /// Adds a component that acts in another entry and records its results there (a drive in its joint).
  Component& add_within(std::unique_ptr<Component> component, const Entry& entry, const Entry& within);
  void add_chain(const Entry& entry, std::vector<int> nodes) { chains_.push_back({entry, std::move(nodes)}); }
  const std::vector<Member>& members() const { return members_; }
  const std::vector<Chain>& chains() const { return chains_; }
  /// Names of the entries that members are created from, in the order of the file, each once.
  const std::vector<std::string>& names_in(Section section) const { return names_[static_cast<std::size_t>(section)]; }
  /// Numbers of the members that are created from an entry or act in it, in the order of the file; empty if there are
  /// none.
  const std::vector<std::size_t>& members_of(const Entry& entry) const;
  /// Returns the components of these members.
  std::vector<Component*> components_of(const Entry& entry) const;

  /// Returns the components of the element, the joint and the hydraulic part with this name, and those that act in
  /// them.
  std::vector<Component*> components_named(const std::string& name) const;

  /// Registers an action that needs other entries of the input file. Actions run after all entries have been read:
  /// first those that connect components, then those that read formulas and measures.
  enum class Stage { connections, formulas };
  void when_read(Stage stage, std::function<void()> action);
  /// Call after all entries have been read; runs the deferred actions. @throws the exceptions of the actions
  void connect();

  /// Announces a measure that the user has named: it is created when it is first needed, at the latest by connect().
  void announce_measure(const std::string& name, std::function<void()> make);
  /// @param recorded  whether it is recorded among the results, under its name
  Measure& add_measure(std::unique_ptr<Measure> measure, bool recorded);
  /// Adds a measure that belongs to an entry of another section (a state), and is recorded among the results of
  /// measures.
  Measure& add_measure_of(const Entry& entry, std::unique_ptr<Measure> measure, bool recorded);
  /// Returns a measure by its name, created now if it is announced, or nullptr. @throws InputError if it is already
  /// being created
  const Measure* find_measure(const std::string& name);
  /// Returns whether entries that are still being read may use a measure of this name.
  bool announces_measure(const std::string& name) const { return announced_index_.contains(name); }
  /// Names of the announced measures, sorted.
  std::vector<std::string> announced_measures() const;

  /// Adds a condition that the start of the first analysis has to satisfy, in addition to the constraints.
  void add_start_condition(StartCondition condition) { start_conditions_.push_back(condition); }
  const std::vector<StartCondition>& start_conditions() const { return start_conditions_; }

  /// Adds an item by which an entry is drawn: a shape that the user gives it, or one that only its reader knows (the
  /// sections of a beam, the course of a rope).
  void add_shape(const Entry& entry, DrawnItem shape) { shapes_.emplace_back(entry, std::move(shape)); }
  const std::vector<std::pair<Entry, DrawnItem>>& shapes() const { return shapes_; }

  /// Excludes a node, joint or element from the recorded results.
  void leave_out(const Entry& entry) { left_out_.insert(entry); }
  bool records(const Entry& entry) const { return !left_out_.contains(entry); }

  Environment environment;  ///< gravity with load factor 1
  std::string title;
  Parameters parameters;  ///< parameters of the input file, overrides included
  /// The values that nodes and components were read from, each with the path of its key, "joints.main.stops.damping",
  /// as YamlValue::digest gives it. The list is empty if the model was not read from a file.
  std::vector<std::pair<std::string, std::string>> source;

 private:
  std::vector<Node> nodes_;
  std::map<std::string, int> node_index_;
  void add_to_index(const Entry& entry, std::size_t member);

  std::vector<Member> members_;
  std::map<Entry, std::vector<std::size_t>> members_of_;
  std::array<std::vector<std::string>, section_count> names_;  ///< names of entries, by section
  std::vector<Chain> chains_;
  std::set<Entry> left_out_;
  std::vector<std::pair<Entry, DrawnItem>> shapes_;
  std::vector<StartCondition> start_conditions_;
  std::array<std::vector<std::function<void()>>, 2> waiting_;  ///< deferred actions, by stage
  struct AnnouncedMeasure {
    std::string name;
    std::function<void()> make;
    bool under_way = false;
  };
  std::vector<AnnouncedMeasure> announced_;
  std::map<std::string, std::size_t> announced_index_;
  std::map<std::string, const Measure*> measures_;
};

/// Creates the same model with another value of one of its parameters. @throws InputError
using ModelMaker = std::function<Model(const std::string& parameter, double value)>;

}  // namespace bielle::mechanism

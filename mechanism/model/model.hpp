// A mechanism as described, before it is numbered: named nodes and components. Readers of input files fill it.
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

#include "mechanism/math/se3.hpp"
#include "mechanism/model/component.hpp"
#include "mechanism/model/entry.hpp"
#include "mechanism/model/prescribed_motion.hpp"
#include "reduce/common/error.hpp"
#include "reduce/common/formula/expression.hpp"

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
  std::array<PrescribedMotion, 6> motion;
  std::optional<int> carrier;  ///< rigidly carried by this node, at the relative position of the start
  bool internal = false;       ///< made by an element (inside of a beam): recorded with it, not under /nodes
};

/// How a component's results stand under the name of an entry: not at all, as its own, or as those of one of several
/// alike, whose records form an array (elements of a beam).
enum class Recorded { no, alone, stacked };

/// A component with its identity and the place of its results.
struct Member {
  std::unique_ptr<Component> component;
  Entry entry;    ///< that it was made of
  Entry results;  ///< under whose name its results stand: the entry, or the joint that a drive acts in
  Recorded recorded = Recorded::alone;
};

/// A chain of nodes recorded together as (rows, nodes, 3) positions and (rows, nodes, 4) quaternions (a beam).
struct Chain {
  Entry entry;
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

  /// Adds a component that is made of an entry. Several may be made of one (the joint first, then its springs).
  Component& add(std::unique_ptr<Component> component, const Entry& entry, Recorded recorded = Recorded::alone);
  /// Adds one that acts in another entry and records its results there (a drive in its joint).
  Component& add_within(std::unique_ptr<Component> component, const Entry& entry, const Entry& within);
  void add_chain(const Entry& entry, std::vector<int> nodes) { chains_.push_back({entry, std::move(nodes)}); }
  const std::vector<Member>& members() const { return members_; }
  const std::vector<Chain>& chains() const { return chains_; }
  /// Names of entries that members are made of, in the order of the file, each once.
  const std::vector<std::string>& names_in(Section section) const { return names_[static_cast<std::size_t>(section)]; }
  /// Numbers of the members that are made of an entry or act in it, in the order of the file; empty: there is none.
  const std::vector<std::size_t>& members_of(const Entry& entry) const;
  /// The same as components.
  std::vector<Component*> components_of(const Entry& entry) const;

  /// The components of the element, the joint and the part of the hydraulics of a name, with those that act in them.
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
  /// One that belongs to an entry of another section (a state), and stands among the results of measures.
  Measure& add_measure_of(const Entry& entry, std::unique_ptr<Measure> measure, bool recorded);
  /// A measure by its name, made now if it is announced, or nullptr. @throws InputError when it is being made already
  const Measure* find_measure(const std::string& name);
  /// Whether entries that are still being read may use a measure of this name.
  bool announces_measure(const std::string& name) const { return announced_index_.contains(name); }
  /// Their names, sorted.
  std::vector<std::string> announced_measures() const;

  /// What the start of the first analysis has to satisfy besides the constraints.
  void add_start_condition(StartCondition condition) { start_conditions_.push_back(condition); }
  const std::vector<StartCondition>& start_conditions() const { return start_conditions_; }

  /// Takes a node, joint or element out of what is recorded.
  void leave_out(const Entry& entry) { left_out_.insert(entry); }
  bool records(const Entry& entry) const { return !left_out_.contains(entry); }

  Environment environment;  ///< gravity with load factor 1
  std::string title;
  Parameters parameters;  ///< of the input file, overrides included
  /// The source holds the values that nodes and components were read from: each by the path of its key,
  /// "joints.main.stops.damping", as YamlValue::digest gives it. It is empty if the model was made otherwise.
  std::vector<std::pair<std::string, std::string>> source;

 private:
  std::vector<Node> nodes_;
  std::map<std::string, int> node_index_;
  void add_to_index(const Entry& entry, std::size_t member);

  std::vector<Member> members_;
  std::map<Entry, std::vector<std::size_t>> members_of_;
  std::array<std::vector<std::string>, section_count> names_;  ///< by section
  std::vector<Chain> chains_;
  std::set<Entry> left_out_;
  std::vector<StartCondition> start_conditions_;
  std::array<std::vector<std::function<void()>>, 2> waiting_;  ///< by stage
  struct AnnouncedMeasure {
    std::string name;
    std::function<void()> make;
    bool under_way = false;
  };
  std::vector<AnnouncedMeasure> announced_;
  std::map<std::string, std::size_t> announced_index_;
  std::map<std::string, const Measure*> measures_;
};

/// The same model with another value of one of its parameters. @throws InputError
using ModelMaker = std::function<Model(const std::string& parameter, double value)>;

}  // namespace bielle::mechanism

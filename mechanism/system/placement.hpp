// How one member's local rows and columns reach those of the whole.
//
// Local entries are first reduced to the independent increments of the member's nodes; where every node is free in all
// directions, or held in all, the reduced rows are the local ones. Reduced entries then go to their places among the
// values of the tangent.
#pragma once

#include <vector>

#include "mechanism/system/unknowns.hpp"

namespace bielle::mechanism {

/// A node among a member's local unknowns: its own, or of a component that it refers to.
struct NodePart {
  int node, local, reduced;  ///< first rows
};

/// Neighbouring scalars of one kind among them.
struct ScalarPart {
  Kind kind;
  int local, reduced, count;  ///< first rows
  int unknown;                ///< first global unknown
  bool own;
};

/// Where local entries go: three neighbours that are neighbours there, too, and single ones.
struct Targets {
  /// A local entry and its place among the global values.
  struct Target {
    int entry, place;
  };
  std::vector<Target> triples, singles;

  Targets() = default;
  /// @param all  by ascending entries
  explicit Targets(const std::vector<Target>& all);
  /// Adds local entries to the global values.
  void scatter(const double* entries, std::vector<double>& values) const;
  /// The same in two steps, between which they wait elsewhere.
  /// @param waiting  (count)
  void collect(const double* entries, double* waiting) const;
  void scatter_collected(const double* waiting, std::vector<double>& values) const;
  std::size_t count() const { return 3 * triples.size() + singles.size(); }
};

struct Placement {
  // As the component declares it.
  bool stiffness = false, damping = false, mass = false;  ///< what it contributes to
  bool blocks_only = false;                               ///< it never asks for a dense matrix

  bool plain = true;                ///< every node is free in all six directions, or held in all
  bool in_place = false;            ///< its blocks go straight to their places
  bool lone_amplitudes = false;     ///< no other member has entries in the rows and columns of its amplitudes
  bool reads_multipliers = false;   ///< of components that it refers to
  int own_size = 0;                 ///< local rows of its own
  int own_nodes_end = 0;            ///< local rows of its own nodes
  std::vector<NodePart> nodes;      ///< own ones first
  std::vector<ScalarPart> scalars;  ///< own ones first
  std::vector<int> nonholonomic;    ///< local rows
  std::vector<int> unknown;         ///< global unknown of each reduced row, -1 where held

  // Of the reduced entries (by columns) that are kept, unless they go in place: those in rows and columns of lone
  // amplitudes, where no other member adds; and all others.
  Targets lone, targets;
  SparsePlaces places;  ///< of the local entries that go in place

  explicit Placement(const Declaration& declaration);
  int reduced_size() const { return static_cast<int>(unknown.size()); }
  bool contributes() const { return stiffness || damping || mass; }
  /// Finds rows and unknowns, once all members are numbered.
  void find_rows(const NodeKinematics& kinematics, const Unknowns& unknowns, const Slots& slots);
  /// The member's own amplitudes, or nullptr.
  const ScalarPart* own_amplitudes() const;
  /// Reduced entries that can differ from zero, and belong to equations that the member may add to.
  LocalPattern pattern(const Component& component, const Slots& slots) const;
  /// Takes the places of the entries that are kept. @param kept  by ascending entries
  void set_places(const NodeKinematics& kinematics, const Slots& slots, const std::vector<Targets::Target>& kept);
  /// Adds reduced entries (by columns) to the global values.
  void scatter(const double* entries, std::vector<double>& values) const;

 private:
  LocalPattern related_pattern(const Component& component, const Slots& slots) const;
  void add_parts(const NodeKinematics& kinematics, const Unknowns& unknowns, const Slots& slots, int local, bool own);
};

}  // namespace bielle::mechanism

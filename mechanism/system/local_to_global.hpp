// Mapping of one member's local rows and columns to the global ones.
//
// Local entries are first reduced to the independent increments of the member's nodes; if every node is free in all
// directions, or held in all, the reduced rows are the local ones. Reduced entries are then added to their places among
// the values of the tangent.
#pragma once

#include <vector>

#include "mechanism/system/unknowns.hpp"

namespace bielle::mechanism {

/// A node among a member's local unknowns: one of its own, or of a component that it refers to.
struct NodePart {
  int node, local, reduced;  ///< node, first local row, first reduced row
};

/// A contiguous range of scalars of one kind among the local unknowns.
struct ScalarPart {
  Kind kind;
  int local, reduced, count;  ///< first local row, first reduced row, count
  int unknown;                ///< first global unknown
  bool own;
};

/// Places of local entries: triples that are contiguous in both vectors, and single entries.
struct Targets {
  /// A local entry and its place among the global values.
  struct Target {
    int entry, place;
  };
  std::vector<Target> triples, singles;

  Targets() = default;
  /// @param all  all entries, ascending
  explicit Targets(const std::vector<Target>& all);
  /// Adds local entries to the global values.
  void scatter(const double* entries, std::vector<double>& values) const;
  /// Does the same in two steps, with the entries stored elsewhere in between.
  /// @param waiting  buffer for the entries (count)
  void collect(const double* entries, double* waiting) const;
  void scatter_collected(const double* waiting, std::vector<double>& values) const;
  std::size_t count() const { return 3 * triples.size() + singles.size(); }
};

struct LocalToGlobal {
  // Properties that the component declares.
  bool stiffness = false, damping = false, mass = false;  ///< matrices that it contributes to
  bool blocks_only = false;                               ///< it never requests a dense matrix

  bool plain = true;                ///< every node is free in all six directions, or held in all
  bool in_place = false;            ///< its blocks are added directly to their global places
  bool lone_amplitudes = false;     ///< no other member has entries in the rows and columns of its amplitudes
  bool reads_multipliers = false;   ///< whether it reads multipliers of components that it refers to
  int own_size = 0;                 ///< number of its own local rows
  int own_nodes_end = 0;            ///< number of local rows of its own nodes
  std::vector<NodePart> nodes;      ///< own nodes first
  std::vector<ScalarPart> scalars;  ///< own scalars first
  std::vector<int> nonholonomic;    ///< local rows of non-holonomic constraints
  std::vector<int> unknown;         ///< global unknown of each reduced row, -1 if held

  // Places of the reduced entries (by columns) that are kept, unless blocks are added in place: `lone` has those in
  // rows and columns of lone amplitudes, to which no other member adds; `targets` has all others.
  Targets lone, targets;
  SparsePlaces places;  ///< places of local entries whose blocks are added in place

  explicit LocalToGlobal(const Declaration& declaration);
  int reduced_size() const { return static_cast<int>(unknown.size()); }
  bool contributes() const { return stiffness || damping || mass; }
  /// Finds rows and unknowns, after all members are numbered.
  void find_rows(const NodeKinematics& kinematics, const Unknowns& unknowns, const Slots& slots);
  /// Returns the member's own amplitudes, or nullptr.
  const ScalarPart* own_amplitudes() const;
  /// Returns the reduced entries that can differ from zero and belong to equations that the member may add to.
  LocalPattern pattern(const Component& component, const Slots& slots) const;
  /// Sets the places of the entries that are kept. @param kept  ascending by entry
  void set_places(const NodeKinematics& kinematics, const Slots& slots, const std::vector<Targets::Target>& kept);
  /// Adds reduced entries (by columns) to the global values.
  void scatter(const double* entries, std::vector<double>& values) const;

 private:
  void add_parts(const NodeKinematics& kinematics, const Unknowns& unknowns, const Slots& slots, int local, bool own);
};

}  // namespace bielle::mechanism

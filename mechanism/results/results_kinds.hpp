// Recorded entries, sorted by kinds: a kind contains the entries of a section that record the same quantities.
//
// In a row of results, the numbers of a quantity are contiguous for all entries of a kind: (entries, shape of one). The
// layout determines the datasets: one for each quantity of each entry, or one for each quantity of a kind.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mechanism/model/model.hpp"

namespace bielle::mechanism {

/// A quantity of the entries of a kind.
struct ResultsField {
  std::string name;                ///< "position"
  std::vector<std::size_t> shape;  ///< shape of one entry
  std::string units, description;
  bool summed = false;    ///< summed over the members of an entry
  std::size_t size = 1;   ///< number of values of one entry
  std::size_t begin = 0;  ///< index in the row of the first entry's values; the others follow
};

/// Destination of one output of a member.
struct ResultsTarget {
  std::size_t field;   ///< index of a field of the kind
  std::size_t offset;  ///< offset within the numbers of the entry
  std::size_t size;
  bool summed;  ///< added to the values of other members
};
using ResultsPart = std::vector<ResultsTarget>;

struct ResultsKind {
  Section section;
  std::string name;  ///< type of its entries ("hinge"), or "hinge_2" if other entries of it record other quantities
  std::string type;
  std::vector<ResultsField> fields;
  std::vector<ResultsPart> parts;    ///< parts, one for each member of an entry
  std::size_t chain = 0;             ///< number of nodes of an entry's chain, whose positions are the first fields
  std::vector<std::size_t> entries;  ///< numbers of its entries

  const ResultsField* find(const std::string& field) const;
};

/// An entry with recorded results.
struct ResultsEntry {
  Entry entry;
  std::size_t kind = 0, number = 0;  ///< its kind, and its number within the kind
  std::vector<int> nodes;            ///< the node itself, or the nodes of its chain
  std::vector<std::size_t> members;  ///< members, in the order of the kind's parts
};

class ResultsKinds {
 public:
  /// @param all  whether entries that the model excludes are included
  /// @throws std::logic_error if two components claim the same dataset
  ResultsKinds(const Model& model, bool all);

  const std::vector<ResultsKind>& kinds() const { return kinds_; }
  const std::vector<ResultsEntry>& entries() const { return entries_; }  ///< nodes first, then in the order of the file
  std::size_t size() const { return size_; }                             ///< number of values in a row
  std::size_t datasets() const;                                          ///< number of datasets in the layout by names

  const ResultsEntry* find(const Entry& entry) const;
  /// Finds the entry and the number of the field of a dataset "joints/main/coordinate".
  std::optional<std::pair<const ResultsEntry*, std::size_t>> find(const std::string& dataset) const;
  /// Path of a field of an entry, relative to the group of an analysis: "joints/main/coordinate".
  std::string dataset(const ResultsEntry& entry, const ResultsField& field) const;
  /// Attributes of an entry, its type first, each once.
  std::vector<std::pair<std::string, std::string>> attributes(const ResultsEntry& entry) const;

 private:
  struct Draft;
  void add_nodes();
  void add_members();
  void add_stacked(const Entry& entry, const std::vector<std::size_t>& members, Draft& draft) const;
  void add(Draft draft);
  void place();
  bool records(const Entry& entry) const { return all_ || model_.records(entry); }

  const Model& model_;
  bool all_;
  std::vector<ResultsKind> kinds_;
  std::vector<ResultsEntry> entries_;
  std::unordered_map<std::string, std::size_t> kind_of_;        ///< kinds, by the quantities that their entries record
  std::unordered_map<std::string, std::size_t> kinds_of_type_;  ///< number of kinds of each type
  std::vector<std::size_t> entry_of_node_, entry_of_member_;    ///< `none` if nothing is recorded
  std::size_t size_ = 0;
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
};

}  // namespace bielle::mechanism

// What is recorded, sorted by kinds: entries of a section that record the same quantities.
//
// In a row of results the numbers of a quantity stand together for all entries of a kind: (entries, shape of one). How
// the rows become datasets is the layout's: one for each quantity of each entry, or one for each quantity of a kind.
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
  std::vector<std::size_t> shape;  ///< of one entry
  std::string units, description;
  bool summed = false;    ///< added up over the members of an entry
  std::size_t size = 1;   ///< numbers of one entry
  std::size_t begin = 0;  ///< in the row, of those of the first entry; the others follow
};

/// Where the outputs of a member go, one after the other.
struct ResultsTarget {
  std::size_t field;   ///< of the kind
  std::size_t offset;  ///< within the numbers of the entry
  std::size_t size;
  bool summed;  ///< added to what other members put there
};
using ResultsPart = std::vector<ResultsTarget>;

struct ResultsKind {
  Section section;
  std::string name;  ///< the type of its entries ("hinge"), or "hinge_2" where others of the type record other things
  std::string type;
  std::vector<ResultsField> fields;
  std::vector<ResultsPart> parts;    ///< of each member of an entry
  std::size_t chain = 0;             ///< nodes of an entry's chain, whose places are the first fields
  std::vector<std::size_t> entries;  ///< by number

  const ResultsField* find(const std::string& field) const;
};

/// An entry that records.
struct ResultsEntry {
  Entry entry;
  std::size_t kind = 0, number = 0;  ///< among those of the kind
  std::vector<int> nodes;            ///< itself, where it is a node, or its chain
  std::vector<std::size_t> members;  ///< in the order of the kind's parts
};

class ResultsKinds {
 public:
  /// @param all  also what the model leaves out
  /// @throws std::logic_error when two components claim the same dataset
  ResultsKinds(const Model& model, bool all);

  const std::vector<ResultsKind>& kinds() const { return kinds_; }
  const std::vector<ResultsEntry>& entries() const { return entries_; }  ///< nodes, then in the order of the file
  std::size_t size() const { return size_; }                             ///< numbers in a row
  std::size_t datasets() const;                                          ///< of the entries by name

  const ResultsEntry* find(const Entry& entry) const;
  /// The entry and the number of the field that "joints/main/coordinate" names.
  std::optional<std::pair<const ResultsEntry*, std::size_t>> find(const std::string& dataset) const;
  /// Path of a field of an entry below an analysis: "joints/main/coordinate".
  std::string dataset(const ResultsEntry& entry, const ResultsField& field) const;
  /// Facts about an entry, its type first, each once.
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
  std::unordered_map<std::string, std::size_t> kind_of_;        ///< by what their entries record
  std::unordered_map<std::string, std::size_t> kinds_of_type_;  ///< how many
  std::vector<std::size_t> entry_of_node_, entry_of_member_;    ///< `none` where it records nothing
  std::size_t size_ = 0;
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
};

}  // namespace bielle::mechanism

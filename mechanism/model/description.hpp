// The description that `--check` prints of one entry of the mechanism file, gathered from the components that it is
// made of.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "mechanism/model/model.hpp"

namespace bielle::mechanism {

/// Formats a vector: "(0.5, 0, 1)"; rounding residues of a unit vector are printed as zero.
std::string format_vector(const Vector3& v);

/// The components of an entry describe themselves one after the other (Component::describe): the elements of a beam, a
/// joint and what acts in it. The descriptions take time and memory in proportion to the number of components.
class Description {
 public:
  explicit Description(const Model& model) : model_(model) {}

  /// Name of a node in quotes: "'pin'". @param index  of the model's node
  std::string node(int index) const { return "'" + model_.node(index).name + "'"; }

  /// Adds a fact to the entry's first line: "mass 2 kg".
  void add(std::string fact);
  /// Adds to a quantity that is summed over all components of the entry, for the first line: "length 2 m".
  void add_sum(const std::string& name, double value, const std::string& units);
  /// Adds a line below the first.
  void add_line(std::string line);
  /// Adds a text about a single component: it is printed once if all texts are equal, otherwise those of the first and
  /// the last component are printed.
  /// @param subject  "section in the middle of", put before "each element" @param part  "element"
  void add_each(const std::string& subject, const std::string& part, const std::string& text);

  /// Returns the first line, which may be empty, and the lines below it.
  std::vector<std::string> lines() const;

 private:
  struct Fact {
    std::string text;   ///< the fact, or the name of a sum
    std::string units;  ///< units of a sum
    double sum = 0;
    bool is_sum = false;
  };
  /// Texts of the components on one subject.
  struct Each {
    std::string subject, part, first, last;
    std::size_t count = 0;
    bool alike = true;
  };
  const Model& model_;
  std::vector<Fact> facts_;
  std::map<std::string, std::size_t> sums_;  ///< index of each sum in facts_
  std::vector<std::string> lines_;
  std::map<std::string, Each> each_;  ///< texts by subject
};

}  // namespace bielle::mechanism

// What `--check` tells of one entry of the mechanism file, gathered from the components that it is made of.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "mechanism/model/model.hpp"

namespace bielle::mechanism {

/// "(0.5, 0, 1)"; what is rounding residue of a unit vector reads as zero.
std::string format_vector(const Vector3& v);

/// The components of an entry describe themselves one after the other (Component::describe): the elements of a beam,
/// a joint and what acts in it. Takes time and memory in proportion to their number.
class Description {
 public:
  explicit Description(const Model& model) : model_(model) {}

  /// Name of a node in quotes: "'pin'". @param index  of the model's node
  std::string node(int index) const { return "'" + model_.node(index).name + "'"; }

  /// A fact for the entry's first line: "mass 2 kg".
  void add(std::string fact);
  /// A quantity that all components of the entry have together, for the first line: "length 2 m".
  void add_sum(const std::string& name, double value, const std::string& units);
  /// A line of its own below the first.
  void add_line(std::string line);
  /// What each component has of its own: one line where all say the same, otherwise lines of the first and the last.
  /// @param subject  "section in the middle of", put before "each element" @param part  "element"
  void add_each(const std::string& subject, const std::string& part, const std::string& text);

  /// The first line, which may be empty, and those below it.
  std::vector<std::string> lines() const;

 private:
  struct Fact {
    std::string text;   ///< or the name of a sum
    std::string units;  ///< of a sum
    double sum = 0;
    bool is_sum = false;
  };
  /// What the components say of one subject.
  struct Each {
    std::string subject, part, first, last;
    std::size_t count = 0;
    bool alike = true;
  };
  const Model& model_;
  std::vector<Fact> facts_;
  std::map<std::string, std::size_t> sums_;  ///< places among the facts
  std::vector<std::string> lines_;
  std::map<std::string, Each> each_;  ///< by subject
};

}  // namespace bielle::mechanism

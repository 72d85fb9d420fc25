#include "mechanism/language/language_keys.hpp"

#include "mechanism/reading/read_frame.hpp"

namespace bielle::mechanism {

const std::vector<std::string>& sections_of_entries() {
  static const std::vector<std::string> sections = {"nodes", "points", "elements", "joints", "drives",
                                                    "loads", "states", "measures", "inputs", "events"};
  return sections;
}

const KeyTable& repeat_keys() {
  using namespace keys;
  static const KeyTable table{
      "`repeat`",
      "Makes several entries out of one. Formulas use the number, names and texts hold it in braces: `bay_{k}`, "
      "`bay_{k+1}`; words stand in braces as well: `{side}_wheel`.",
      {{"as", text(), required, "Name of the number, or word, of the entry."},
       {"count", integer().at_least(0), optional, "Number of entries."},
       {"over", list_of(text()), optional, "Words, or numbers, in place of `count`: an entry for each of them."},
       {"from", integer(), otherwise("1"), "The number of the first entry."}}};
  return table;
}

std::vector<Key> entry_keys() {
  using namespace keys;
  return {{"if",
           {boolean(), number()},
           optional,
           "Condition of the parameters: the entry is left out if it is false or zero."},
          {"repeat",
           {nested(repeat_keys), list_of(nested(repeat_keys))},
           optional,
           "Makes several entries out of this one; a list repeats in several directions."}};
}

const KeyTable& part_keys() {
  using namespace keys;
  static const KeyTable table{
      "a part", "A sub-assembly that is written once and placed here. Its names are `part.name` outside.",
      joined({{{"part", text(), optional, "Name of the part among the `definitions`, of this file or of `file`."},
               {"file", file("mechanism"), optional,
                "File that contains the definition; without `part` the file itself is the part."},
               {"at", name_of("node"), computed("the inertial axes"), "Node in whose axes the part is placed."},
               {"parameters", entries("parameter", {number("any")}), optional,
                "Values of parameters of the part, in place of those of its definition."},
               {"merge", entries("node of the part", {name_of("node")}), optional,
                "Nodes of the part that are nodes of this model; the two must have the same place and axes."},
               {"mirror", word({"x", "y", "z"}, "an axis (x, y or z)"), optional,
                "Mirrors the part before it is placed, in the plane through its origin that is normal to this axis of "
                "its own."}},
              frame_keys(),
              entry_keys()})};
  return table;
}

const KeyTable& body_point_keys() {
  using namespace keys;
  static const KeyTable table{
      "a point of a body", "A point that moves with a rigid body, in place of a node's name: a node is made there.",
      joined({{{"body", name_of("element"), required, "The rigid body."},
               {"at", vector3("m").as_point(), otherwise("[0, 0, 0]"), "The point in the axes of the body's node."}},
              orientation_keys()})};
  return table;
}

}  // namespace bielle::mechanism

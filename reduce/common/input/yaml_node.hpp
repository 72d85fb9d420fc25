// The tree of a YAML document, as libyaml reads it.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace bielle {

/// A node of a YAML document. Aliases (`*name`) refer to the node of their anchor, so that a node may have several
/// parents; it never contains itself.
struct YamlNode {
  enum class Kind { null, scalar, sequence, map };
  struct Pair {
    std::shared_ptr<const YamlNode> key, value;
  };
  Kind kind = Kind::null;
  int line = 1;                                        ///< line on which it begins, 1-based
  std::shared_ptr<const std::string> file;             ///< file in which it stands; null: the document's own
  std::string scalar;                                  ///< as written, without quotes
  std::vector<std::shared_ptr<const YamlNode>> items;  ///< of a sequence
  std::vector<Pair> pairs;                             ///< of a map, in the order of the file
};

/// Parses the only document of a text. Plain `~`, `null` and nothing are null; everything else is text.
/// @param name  name of the file for messages
/// @throws InputError `name:line: ..` if the text is empty, no valid YAML, holds several documents, is nested more than
///         50 levels deep, has tags (`!include`), repeats a key of a map, merges
///         maps (`<<`), or has aliases that repeat more than 100,000 values
std::shared_ptr<const YamlNode> parse_yaml(const std::string& text, const std::string& name);

}  // namespace bielle

// The lines of the keys in an input file, for messages about them that arise after it was read.
#pragma once

#include <map>
#include <string>

namespace bielle {
class YamlValue;
}

namespace bielle::reduce {

/// A file name and the line of each key path.
class KeyLines {
 public:
  KeyLines() = default;  ///< for requests that come from no file: messages stay as they are
  explicit KeyLines(const YamlValue& root);
  /// `rod.yaml:17: message`, with the line of the subject or else of the nearest key that encloses it. The message
  /// stays as it is if the file contains neither.
  /// @param subject  key path: "interfaces.big_end.surface", "pieces.planes[1]"
  std::string located(const std::string& subject, const std::string& message) const;

 private:
  void add(const YamlValue& value);
  std::string file_;
  std::map<std::string, int> lines_;  ///< by key path
};

}  // namespace bielle::reduce

// Definitions of parts, in the file of a model and in others.
#pragma once

#include <map>
#include <string>

#include "mechanism/language/tree.hpp"

namespace bielle::mechanism {

/// The parts that a file defines.
struct Definitions {
  Tree entries;      ///< the section `definitions`; null if the file has none
  std::string file;  ///< name of the file, for messages
};

/// A part and the definitions that its own parts refer to.
struct Part {
  Tree body;
  Definitions definitions;
};

/// Finds the definitions of parts; reads each file once.
class PartLibrary {
 public:
  explicit PartLibrary(std::string main_file) : main_file_(std::move(main_file)) {}

  /// @param entry  a placed part
  /// @param here   definitions of the file in which it stands
  /// @throws InputError if there is no such part, naming the nearest one
  Part find(const YamlNode& entry, const Definitions& here, const std::string& path);

 private:
  std::string main_file_;
  std::map<std::string, Tree> files_;  ///< by the file that names them and the name
};

}  // namespace bielle::mechanism

// Definitions of parts, in the file of a model and in others.
#pragma once

#include <map>
#include <string>

#include "mechanism/language/tree.hpp"
#include "reduce/common/input/key_table.hpp"

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
  /// @param definition_keys  table of a definition
  PartLibrary(std::string main_file, const KeyTable& definition_keys)
      : main_file_(std::move(main_file)), definition_keys_(definition_keys) {}

  /// Returns the definitions of a file, used or not. @throws InputError at a key that a definition does not have
  Definitions definitions_of(const YamlNode& root, const std::string& file) const;

  /// @param entry  a placed part
  /// @param here   definitions of the file in which it stands
  /// @throws InputError if there is no such part, naming the nearest one
  Part find(const YamlNode& entry, const Definitions& here, const std::string& path);

 private:
  std::string main_file_;
  const KeyTable& definition_keys_;
  std::map<std::string, Part> files_;  ///< by the file that names them and the name
};

}  // namespace bielle::mechanism

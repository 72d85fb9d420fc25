// `include`: a mechanism file that consists of several files.
#pragma once

#include <string>

#include "mechanism/language/tree.hpp"

namespace bielle::mechanism {

/// Returns the tree of a file with everything that it includes, without the key `include`.
///
/// Entries of a section are put together, those of included files first; files are read in their order, each once. A
/// parameter may be given again: the including file, or the file that is included later, has the last word. Any other
/// key or entry must not stand in two files.
/// @param root  tree of the file
/// @param file  its name, relative to which the names of included files are
/// @throws InputError for a file that is missing or includes itself, and for an entry that two files have
Tree with_includes(const Tree& root, const std::string& file);

/// Reads a file that a node names, with what it includes.
/// @param from      file in which the name stands
/// @param what      key that names it, for messages: "include"
Tree load_with_includes(const YamlNode& name, const std::string& from, const std::string& what);

}  // namespace bielle::mechanism

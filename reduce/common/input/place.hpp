// Places in input files, for messages.
#pragma once

#include <string>

namespace bielle {

/// Returns the path of a key in a map: "joints.main"; the key alone in the map of the whole file.
std::string path_of_key(const std::string& path_of_map, const std::string& key);

/// Returns `file:line: path: message`, the form of every message about an input file. @param path  may be empty
std::string located_at(const std::string& file, int line, const std::string& path, const std::string& message);

}  // namespace bielle

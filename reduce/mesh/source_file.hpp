// The file from which a body comes: what gmsh shall open instead of it, and in which unit its numbers are.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "reduce/mesh/foreign_mesh.hpp"

namespace bielle {
class Progress;
}

namespace bielle::reduce {

/// A geometry or mesh, ready for gmsh.
struct SourceFile {
  std::string name;       ///< as the user wrote it, for messages
  std::string path;       ///< what gmsh opens: the file, or the MSH file to which it was converted
  bool geometry = false;  ///< to be meshed, by the ending of its name
  std::string unit_note;  ///< "lengths in the file are in mm": what is known of its unit, for people
  double metres = 1;      ///< per unit of what gmsh then holds (1 for STEP and IGES: gmsh converts these)
  std::unique_ptr<TemporaryFolder> folder;  ///< of the converted file; lives as long as this
};

/// Finds the file, converts it when it is foreign, and settles its unit.
/// @param length_unit  what the user says of a file that carries none; absent: m
/// @throws InputError when the file is missing, no file, empty, or cannot be converted; when the unit is none
SourceFile prepare_source(const std::string& path, const std::optional<std::string>& length_unit,
                          const std::string& length_unit_located, Progress& progress);

}  // namespace bielle::reduce

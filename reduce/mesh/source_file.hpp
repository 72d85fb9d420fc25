// The file from which a body comes: what gmsh shall open instead of it, and in which unit its numbers are.
#pragma once

#include <memory>
#include <string>

#include "reduce/common/process/child_process.hpp"
#include "reduce/mesh/foreign_mesh.hpp"
#include "reduce/mesh/mesh_request.hpp"

namespace bielle {
class Progress;
}

namespace bielle::reduce {

/// A geometry or mesh, ready for gmsh.
struct SourceFile {
  std::string name;           ///< as the user wrote it, for messages
  std::string path;           ///< what gmsh opens: the file, or what it was converted to
  bool geometry = false;      ///< to be meshed, by the ending of its name
  bool carries_unit = false;  ///< STEP and IGES: gmsh converts these to metres
  std::string unit_note;      ///< "read in mm as length_unit says": what is known of its unit, for people
  double metres = 1;          ///< per unit of what gmsh then holds (1 for STEP and IGES: gmsh converts these)
  std::unique_ptr<ScratchFolder> folder;  ///< of the converted file; lives as long as this
};

/// Finds the file, converts it when it is foreign, and settles its unit.
/// @throws InputError when the file is missing, no file, empty, or cannot be converted; when the unit is none
SourceFile prepare_source(const MeshRequest& request, Progress& progress);

/// What to tell the user when gmsh's process ends without an answer: it crashes on the file, or the file ends it or
/// starts another program.
/// @param located  "rod.yaml:3: geometry", put before it
ChildLoss loss_of(const SourceFile& source, const std::string& located = "");

/// A geometry may be a script that runs shell commands: from now on this process cannot start another program.
/// @throws InputError when the system cannot prevent it and the script has words that could
void forbid_system_calls(const SourceFile& source);

}  // namespace bielle::reduce

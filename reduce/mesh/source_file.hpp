// The file of a body: the file that gmsh opens, which may be a converted one, and the unit of its numbers.
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
  std::string name;           ///< the user's name of the file, for messages
  std::string path;           ///< the file that gmsh opens: the original or the converted one
  bool geometry = false;      ///< to be meshed, by the ending of its name
  bool is_iges = false;       ///< by the ending of its name
  bool carries_unit = false;  ///< STEP and IGES: gmsh converts these to metres
  std::string unit_note;      ///< "read in mm as length_unit says": the origin of its unit, for messages
  double metres = 1;          ///< metres per unit of the numbers that gmsh holds (1 for STEP and IGES, which gmsh
                              ///< converts)
  std::unique_ptr<ScratchFolder> folder;  ///< folder of the converted file; lives as long as this object
};

/// Finds the file, converts it if gmsh cannot read it, and determines its unit.
/// @throws InputError if the file is missing, not a regular file, empty, or cannot be converted, or if the unit is
/// unknown
SourceFile prepare_source(const MeshRequest& request, Progress& progress);

/// Messages for the case that gmsh's process ends without an answer: gmsh crashes on the file, or the file ends it or
/// starts another program.
/// @param subject  key by which the user names the file
ChildLoss loss_of(const SourceFile& source, const std::string& subject = "");

/// Prevents this process from starting another program, since a geometry may be a script that runs shell commands.
/// @throws InputError if the system cannot prevent it and the script contains words that could
void forbid_system_calls(const SourceFile& source);

}  // namespace bielle::reduce

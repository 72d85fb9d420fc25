// The work that needs gmsh. It is in a module of its own, which is loaded by the process that needs it: gmsh and
// OpenCASCADE are a hundred shared libraries, whose loading takes a quarter of a second.
#pragma once

#include <map>
#include <string>

#include "reduce/mesh/mesh.hpp"
#include "reduce/mesh/mesh_request.hpp"
#include "reduce/mesh/source_file.hpp"

namespace bielle {
class Progress;
}

namespace bielle::reduce {

/// The functions of the module (mesh/gmsh/module.cpp). gmsh may end the process that calls them.
struct GmshWork {
  Mesh (*import_source)(const MeshRequest& request, const SourceFile& source, Progress& progress);
  std::string (*describe_source)(const std::string& path, const SourceFile& source,
                                 const std::map<std::string, double>& densities);
  std::string (*surface_of_source)(const SourceFile& source);
};

/// Loads the module, once per process. It is sought in the installation of the program, then in the build, then by the
/// system (LD_LIBRARY_PATH).
/// @throws ComputationError when it is missing or cannot be loaded
const GmshWork& gmsh_work();

}  // namespace bielle::reduce

// The work that needs gmsh. It is in a module of its own, which is loaded by the process that needs it: gmsh and
// OpenCASCADE are a hundred shared libraries, whose loading takes a quarter of a second.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>

#include "reduce/mesh/mesh.hpp"
#include "reduce/mesh/mesh_request.hpp"
#include "reduce/mesh/source_file.hpp"

namespace bielle {
class Progress;
}

namespace bielle::reduce {

/// The functions of the module (mesh/gmsh/module.cpp). gmsh may end the process that calls them.
struct GmshWork {
  /// Version of Bielle and sizes of the classes that both sides share: a module of another build may have others.
  struct Build {
    std::string_view version = BIELLE_VERSION;
    std::array<std::size_t, 4> sizes = {sizeof(Mesh), sizeof(MeshRequest), sizeof(SourceFile), sizeof(ChildLoss)};
    bool operator==(const Build&) const = default;
  };
  Build build;
  Mesh (*import_source)(const MeshRequest& request, const SourceFile& source, Progress& progress);
  std::string (*describe_source)(const std::string& path, const SourceFile& source,
                                 const std::map<std::string, double>& densities);
  std::string (*surface_of_source)(const SourceFile& source);
};

/// Loads the module, once per process: the first that can be loaded of those in the prefix of the program (its lib
/// folder), of the build, of the installation or its package, and in LD_LIBRARY_PATH.
/// @throws ComputationError when there is none, or one of another build; std::bad_alloc
const GmshWork& gmsh_work();

}  // namespace bielle::reduce

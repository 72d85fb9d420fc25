// The body file: a YAML file that describes a body and how it is to be reduced (format: reduce/manual/body_file.md).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reduce/body_file/key_lines.hpp"
#include "reduce/common/input/key_table.hpp"
#include "reduce/matrices/foreign_matrices.hpp"
#include "reduce/matrices/matrix_options.hpp"
#include "reduce/mesh/mesh_request.hpp"
#include "reduce/reduction/options.hpp"
#include "reduce/reduction/piece_options.hpp"

namespace bielle::reduce {

/// A body whose matrices are files of another program.
struct MatrixBody {
  ForeignMatrices files;
  MatrixOptions options;
};

/// The contents of a body file: requests for the mesh and for its reduction, or a request for matrices.
struct BodyFile {
  std::optional<MatrixBody> matrices;  ///< in place of `mesh`, `options` and `pieces`
  MeshRequest mesh;
  ReductionOptions options;
  std::optional<PiecesRequest> pieces;  ///< at the planes `mesh.cuts`; absent: the body stays whole
  std::vector<std::string>
      warnings;    ///< sentences about values that are possible but probably not intended, each with its place
  KeyLines lines;  ///< lines of the keys, for messages of import_mesh and of the reduction, whose requests know the
                   ///< keys only
};

/// Returns the keys of a body file, with everything below them.
const KeyTable& body_file_keys();

/// Reads a body file and checks its keys, types and ranges, and the names that the file itself must define. Conditions
/// that depend on the geometry (its groups, whether interfaces overlap) are checked by import_mesh and by the
/// reduction. The subject of each request is its key path, for which `lines` gives the place in the file.
/// @throws InputError `file:line: key: what was expected; did you mean ...`
BodyFile read_body_file(const std::string& path);

/// Reads the same from text; `name` stands for the file, and its folder for the place of the geometry.
BodyFile parse_body_file(const std::string& text, const std::string& name);

/// The geometry of a body file. The other keys of the file need not be complete.
struct GeometryFile {
  std::string path;
  std::optional<std::string> length_unit;
  std::map<std::string, double> densities;  ///< densities of the regions whose material is in the file [kg/m^3]
};

/// @throws InputError when the file is no YAML, names no geometry, or has a wrong material
GeometryFile read_geometry_of(const std::string& body_path);

}  // namespace bielle::reduce

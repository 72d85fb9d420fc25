// The solids of the geometry that gmsh has open, with their numbers and names. All functions call gmsh without
// translating its exceptions: they belong in session.read().
#pragma once

#include <string>
#include <vector>

namespace bielle::reduce {

/// A solid under the number and the names that the file gives it.
struct BodySolid {
  int number = 0;            ///< gmsh's when the file was read; `--list` prints it
  std::string path;          ///< names of the assembly, its parts and the solid: "gripper/finger/tip"; may be empty
  std::vector<int> volumes;  ///< its volumes in gmsh: itself, or its parts after a division

  std::string name() const;   ///< the last one of the path; "volume_7" without a path
  std::string label() const;  ///< for messages: "'tip' (volume 7)", "volume 7"
  /// Tells whether a text is `name()`, the path, or one or several successive names in it.
  bool is_called(const std::string& text) const;
};

/// All solids, by ascending number.
std::vector<BodySolid> solids_of_model();

/// Sum over the volumes of a solid of the OpenCASCADE kernel, in the unit of the model.
double volume_of(const BodySolid& solid);

}  // namespace bielle::reduce

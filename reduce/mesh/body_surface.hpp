// The surface of a body as triangles and quadrilaterals, and the named surfaces of the file to which they belong.
#pragma once

#include <vector>

#include "reduce/mesh/extracted_model.hpp"
#include "reduce/mesh/faces.hpp"

namespace bielle::reduce {

struct BodySurface {
  std::vector<Corners> sides;
  bool outward = true;        ///< whether the sides are oriented out of the body
  std::vector<int> faces;     ///< number of each side's face in the FaceTable; empty if there are no solid cells
                              ///< yet
  std::vector<int> entities;  ///< surface of the geometry or file, one per side; empty unless all have one
  bool geometry = false;      ///< whether these are surfaces of a geometry, which shapes select as a whole
};

/// Returns the boundary faces of a mesh.
BodySurface body_surface(const ExtractedModel& model, const FaceTable& faces, bool geometry);

/// Returns the surfaces of a geometry that is meshed in two dimensions only; the orientation of the sides is arbitrary.
BodySurface body_surface(const std::map<int, std::vector<Corners>>& surfaces);

}  // namespace bielle::reduce

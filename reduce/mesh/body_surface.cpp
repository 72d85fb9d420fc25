#include "reduce/mesh/body_surface.hpp"

#include <algorithm>

namespace bielle::reduce {

BodySurface body_surface(const ExtractedModel& model, const FaceTable& faces, bool geometry) {
  std::vector<int> entity_of(faces.size(), 0);
  for (const auto& [entity, cells] : model.surfaces)
    for (const Corners& cell : cells)
      if (const std::optional<int> face = faces.find(cell)) entity_of[*face] = entity;
  BodySurface surface;
  surface.geometry = geometry;
  surface.faces = faces.boundary();
  for (int face : surface.faces) {
    surface.sides.push_back(faces.corners(face));
    surface.entities.push_back(entity_of[face]);
  }
  if (std::find(surface.entities.begin(), surface.entities.end(), 0) != surface.entities.end()) {
    surface.entities.clear();
    surface.geometry = false;
  }
  return surface;
}

BodySurface body_surface(const std::map<int, std::vector<Corners>>& surfaces) {
  BodySurface surface;
  surface.outward = false;
  surface.geometry = true;
  for (const auto& [entity, cells] : surfaces)
    for (const Corners& cell : cells) {
      surface.sides.push_back(cell);
      surface.entities.push_back(entity);
    }
  return surface;
}

}  // namespace bielle::reduce

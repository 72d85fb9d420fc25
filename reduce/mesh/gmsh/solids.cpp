#include "reduce/mesh/gmsh/solids.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <gmsh.h>

namespace bielle::reduce {

std::string BodySolid::name() const {
  return path.empty() ? fmt::format("volume_{}", number) : path.substr(path.rfind('/') + 1);
}

std::string BodySolid::label() const {
  return path.empty() ? fmt::format("volume {}", number) : fmt::format("'{}' (volume {})", name(), number);
}

bool BodySolid::is_called(const std::string& text) const {
  return name() == text || ("/" + path + "/").find("/" + text + "/") != std::string::npos;
}

std::vector<BodySolid> solids_of_model() {
  gmsh::vectorpair volumes;
  gmsh::model::getEntities(volumes, 3);
  std::sort(volumes.begin(), volumes.end());
  std::vector<BodySolid> solids;
  for (const auto& [dimension, tag] : volumes) {
    std::string path;
    gmsh::model::getEntityName(dimension, tag, path);
    const std::string root = "Shapes/";  // gmsh's own, before the names of the file
    if (path.starts_with(root)) path = path.substr(root.size());
    solids.push_back({tag, path, {tag}});
  }
  return solids;
}

double volume_of(const BodySolid& solid) {
  double sum = 0;
  for (const int volume : solid.volumes) {
    double measure = 0;
    gmsh::model::occ::getMass(3, volume, measure);
    sum += measure;
  }
  return sum;
}

}  // namespace bielle::reduce

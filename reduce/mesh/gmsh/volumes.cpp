#include "reduce/mesh/gmsh/volumes.hpp"

#include <cmath>

#include <fmt/format.h>
#include <gmsh.h>

#include "reduce/common/progress.hpp"
#include "reduce/mesh/gmsh/fragments.hpp"
#include "reduce/mesh/gmsh/model.hpp"
#include "reduce/mesh/gmsh/session.hpp"
#include "reduce/mesh/source_file.hpp"

namespace bielle::reduce {

double volume_of_solids() {
  gmsh::vectorpair volumes;
  gmsh::model::getEntities(volumes, 3);
  double sum = 0;
  for (const auto& [dimension, tag] : volumes) {
    double part = 0;
    gmsh::model::occ::getMass(dimension, tag, part);
    sum += part;
  }
  return sum;
}

double geometry_volume(const std::string& path, const std::optional<std::string>& length_unit) {
  Progress progress(true);
  MeshRequest request;
  request.path = path;
  request.length_unit = length_unit;
  const SourceFile source = prepare_source(request, progress);
  GmshSession session;
  open_model(session, source);
  double volume = 0;
  session.read(fmt::format("'{}' has no volume that OpenCASCADE could measure", path), [&] {
    if (!is_open_cascade()) throw std::string("its volumes are of another kernel");
    volume = volume_of_solids();
  });
  return volume * std::pow(source.metres, 3);
}

}  // namespace bielle::reduce

#include "reduce/mesh/measures.hpp"

#include <cmath>

#include <fmt/format.h>
#include <gmsh.h>

#include "reduce/common/error.hpp"
#include "reduce/common/progress.hpp"
#include "reduce/mesh/gmsh_model.hpp"
#include "reduce/mesh/gmsh_session.hpp"
#include "reduce/mesh/jacobian.hpp"
#include "reduce/mesh/source_file.hpp"

namespace bielle::reduce {

double mesh_volume(const Mesh& mesh) {
  const CellBlock& block = mesh.solids();
  double volume = 0;
  for (Eigen::Index e = 0; e < block.nodes.cols(); ++e) {
    const Eigen::Matrix3Xd x = mesh.points(Eigen::all, block.nodes.col(e));
    volume += cell_volume(block.type, x);
  }
  return volume;
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
    gmsh::vectorpair volumes;
    gmsh::model::occ::getEntities(volumes, 3);
    if (volumes.empty()) throw std::string("its volumes are of another kernel");
    for (const auto& [dimension, tag] : volumes) {
      double part = 0;
      gmsh::model::occ::getMass(dimension, tag, part);
      volume += part;
    }
  });
  return volume * std::pow(source.metres, 3);
}

}  // namespace bielle::reduce

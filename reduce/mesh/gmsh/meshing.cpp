#include "reduce/mesh/gmsh/meshing.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>

#include <fmt/format.h>
#include <gmsh.h>

#include "reduce/common/error.hpp"

namespace bielle::reduce {

namespace {

// Size on an entity of any dimension: the smallest size of the groups whose closure contains it.
std::map<std::pair<int, int>, double> sizes_of_closures(const std::vector<EntitySize>& sizes) {
  std::map<std::pair<int, int>, double> size_of;
  for (const EntitySize& wish : sizes) {
    gmsh::vectorpair closure, boundary;
    for (int entity : wish.entities) closure.emplace_back(wish.dimension, entity);
    for (int dim = wish.dimension; dim >= 0; --dim) {
      for (const auto& [d, tag] : closure) {
        const auto [place, is_new] = size_of.emplace(std::pair(d, std::abs(tag)), wish.size);
        if (!is_new) place->second = std::min(place->second, wish.size);
      }
      if (dim == 0) break;
      gmsh::model::getBoundary(closure, boundary, false, false, false);
      closure = boundary;
    }
  }
  return size_of;
}

// Edge lengths by place, set until the end of a scope, since gmsh would keep them beyond its own finalisation.
struct SizeCallback {
  explicit SizeCallback(std::function<double(int, int, double, double, double)> size) {
    gmsh::model::mesh::setSizeCallback(std::move(size));
  }
  ~SizeCallback() {
    try {
      gmsh::model::mesh::removeSizeCallback();
    } catch (...) {  // this only fails without a session
    }
  }
  SizeCallback(const SizeCallback&) = delete;
  SizeCallback& operator=(const SizeCallback&) = delete;
};

// Volumes and areas of the geometry, if its kernel computes them.
class Measures {
 public:
  Measures() {
    gmsh::model::occ::getEntities(exact_);
    std::sort(exact_.begin(), exact_.end());
  }

  // Volume or area; for gmsh's own kernel a hundredth of the box.
  double of(int dim, int tag) const {
    double measure = 0;
    if (std::binary_search(exact_.begin(), exact_.end(), std::pair(dim, tag))) {
      gmsh::model::occ::getMass(dim, tag, measure);
      return measure;
    }
    double x0, y0, z0, x1, y1, z1;
    gmsh::model::getBoundingBox(dim, tag, x0, y0, z0, x1, y1, z1);
    const double x = x1 - x0, y = y1 - y0, z = z1 - z0;
    return (dim == 3 ? x * y * z : std::max({x * y, y * z, z * x})) / 100;
  }

  double of_all(int dim) const {
    gmsh::vectorpair entities;
    gmsh::model::getEntities(entities, dim);
    double sum = 0;
    for (const auto& [d, tag] : entities) sum += of(d, tag);
    return sum;
  }

 private:
  gmsh::vectorpair exact_;
};

// Tetrahedra per cube of the edge length inside, and per square on a surface with shorter edges than elsewhere; the
// last number is a lower bound per square of any surface, which matters for thin sheets.
constexpr double cells_per_cube = 8, cells_per_fine_square = 10, cells_per_square = 3;

}  // namespace

void check_volumes_meshed(const std::string& name) {
  gmsh::vectorpair volumes;
  gmsh::model::getEntities(volumes, 3);
  for (const auto& [dim, volume] : volumes) {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> elements, nodes;
    gmsh::model::mesh::getElements(types, elements, nodes, dim, volume);
    if (types.empty())
      throw ComputationError(
          fmt::format("'{}': gmsh could not mesh volume {}; another mesh.size may help", name, volume));
  }
}

void with_sizes(const MeshSizes& sizes, const std::function<void()>& work) {
  const std::map<std::pair<int, int>, double> size_of = sizes_of_closures(sizes.on_entities);
  double largest = sizes.largest.value_or(0), least = largest / most_refinement;
  for (const auto& [entity, wish] : size_of) {
    largest = std::max(largest, wish);
    least = std::min(least, wish);
  }
  if (sizes.largest) gmsh::option::setNumber("Mesh.MeshSizeMax", largest);
  if (sizes.per_turn) {
    gmsh::option::setNumber("Mesh.MeshSizeFromCurvature", *sizes.per_turn);
    gmsh::option::setNumber("Mesh.MeshSizeMin", least);
  }
  std::optional<SizeCallback> callback;
  if (!size_of.empty())
    callback.emplace([size_of, size = sizes.largest](int dim, int tag, double, double, double) {
      const auto found = size_of.find({dim, tag});
      return found != size_of.end() ? found->second : size.value_or(1e22);
    });
  // The geometry may request order 2 itself: the order is raised later, when the straight cells are known to be valid.
  gmsh::option::setNumber("Mesh.ElementOrder", 1);
  gmsh::option::setNumber("Mesh.RecombineAll", 0);
  work();
}

double expected_cells(GmshSession& session, const std::string& name, const MeshSizes& sizes) {
  double cells = 0;
  session.read(fmt::format("'{}' cannot be measured", name), [&] {
    const Measures measures;
    if (sizes.largest)
      cells = std::max(cells_per_cube * measures.of_all(3) / std::pow(*sizes.largest, 3),
                       cells_per_square * measures.of_all(2) / std::pow(*sizes.largest, 2));
    for (const EntitySize& wish : sizes.on_entities)
      for (const int entity : wish.entities)
        cells += (wish.dimension == 3 ? cells_per_cube : cells_per_fine_square) * measures.of(wish.dimension, entity) /
                 std::pow(wish.size, wish.dimension);
  });
  return cells;
}

void mesh_surfaces(GmshSession& session, const std::string& name, const MeshSizes& sizes) {
  session.compute(fmt::format("'{}' cannot be meshed", name), [&] {
    gmsh::model::mesh::clear();
    with_sizes(sizes, [] { gmsh::model::mesh::generate(2); });
  });
}

void mesh_volumes(GmshSession& session, const std::string& name, const MeshSizes& sizes) {
  session.compute(fmt::format("'{}' cannot be meshed", name), [&] {
    with_sizes(sizes, [] { gmsh::model::mesh::generate(3); });
    check_volumes_meshed(name);
  });
}

void make_second_order(GmshSession& session, const std::string& name, bool middle_nodes) {
  session.compute(fmt::format("'{}' cannot be meshed with second-order elements", name), [&] {
    // gmsh's own repair of curved elements throws on real parts (4.8); straighten.cpp repairs them later.
    gmsh::option::setNumber("Mesh.HighOrderOptimize", 0);
    gmsh::option::setNumber("Mesh.SecondOrderLinear", 0);
    gmsh::option::setNumber("Mesh.SecondOrderIncomplete", middle_nodes ? 0 : 1);
    gmsh::model::mesh::setOrder(2);
  });
}

}  // namespace bielle::reduce

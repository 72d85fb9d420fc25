#include "reduce/fe/vertex_patches.hpp"

#include "reduce/common/sort_unique.hpp"

namespace bielle::reduce {

Surroundings surroundings(const Solid& solid, int material) {
  Surroundings result;
  result.number.assign(solid.points(), -1);
  for (int e = 0; e < solid.cells.size(); ++e) {
    if (solid.material_of[e] != material) continue;
    for (const int vertex : solid.cells.vertices(e)) {
      int& number = result.number[vertex];
      if (number < 0) {
        number = static_cast<int>(result.vertices.size());
        result.vertices.push_back(vertex);
        result.cells.emplace_back();
      }
      result.cells[number].push_back(e);
    }
  }
  return result;
}

std::vector<int> patch_of(const Solid& solid, const Surroundings& around, std::size_t vertex, std::size_t least) {
  std::vector<int> patch = around.cells[vertex];
  for (std::size_t before = 0; patch.size() < least && patch.size() > before;) {
    before = patch.size();
    std::vector<int> wider;
    for (const int cell : patch)
      for (const int at : solid.cells.vertices(cell)) {
        const std::vector<int>& more = around.cells[around.number[at]];
        wider.insert(wider.end(), more.begin(), more.end());
      }
    sort_unique(wider);
    patch = std::move(wider);
  }
  return patch;
}

}  // namespace bielle::reduce

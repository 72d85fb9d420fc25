#include "mechanism/drawing/reading/drawn_meshes.hpp"

#include <bit>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <unordered_map>

#include <fmt/format.h>

#include "mechanism/contacts/triangle_surface.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

struct HashOfPoint {
  std::size_t operator()(const std::array<float, 3>& p) const {
    std::size_t hash = 0;
    for (const float x : p) hash = (hash ^ std::bit_cast<std::uint32_t>(x)) * 0x9e3779b97f4a7c15ULL;
    return hash;
  }
};

/// A name that can be the name of a group in the results file.
std::string name_of_file(const std::string& path) {
  std::string name = std::filesystem::path(path).stem().string();
  for (char& letter : name)
    if (!std::isalnum(static_cast<unsigned char>(letter)) && letter != '-') letter = '_';
  return name.empty() ? "mesh" : name;
}

}  // namespace

std::shared_ptr<const DrawnMesh> mesh_of_stl(const std::string& path, double scale) {
  auto mesh = std::make_shared<DrawnMesh>();
  mesh->name = name_of_file(path);
  std::unordered_map<std::array<float, 3>, std::int32_t, HashOfPoint> known;
  std::array<std::int32_t, 3> triangle{};
  std::size_t corner = 0;
  for (const Vector3& x : read_stl(path, scale)) {
    std::array<float, 3> point{};
    for (std::size_t k = 0; k < 3; ++k) point[k] = static_cast<float>(x[static_cast<int>(k)]) + 0.0F;  // no -0
    for (const float component : point)
      if (!std::isfinite(component))
        throw InputError(fmt::format("{}: its lengths are too large to be drawn, after `scale`", path));
    const auto [found, is_new] = known.emplace(point, static_cast<std::int32_t>(mesh->points.size()));
    if (is_new) mesh->points.push_back(point);
    triangle[corner++ % 3] = found->second;
    if (corner % 3 == 0) mesh->triangles.push_back(triangle);
  }
  return mesh;
}

std::shared_ptr<const DrawnMesh> mesh_of_ring(double radius, double section) {
  constexpr int around = 48, across = 16;
  auto mesh = std::make_shared<DrawnMesh>();
  mesh->name = "ring";
  const auto index = [](int i, int j) { return static_cast<std::int32_t>((i % around) * across + j % across); };
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double phi = 2 * std::numbers::pi * i / around, psi = 2 * std::numbers::pi * j / across;
      const double r = radius + section * std::cos(psi);
      mesh->points.push_back({static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)),
                              static_cast<float>(section * std::sin(psi))});
      mesh->triangles.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
      mesh->triangles.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
    }
  return mesh;
}

}  // namespace bielle::mechanism

#include "mechanism/drawing/reading/drawn_meshes.hpp"

#include <bit>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>
#include <mutex>
#include <numbers>
#include <unordered_map>

#include <fmt/format.h>

#include "mechanism/contacts/triangle_surface.hpp"
#include "reduce/common/error.hpp"
#include "reduce/common/files/file_checks.hpp"
#include "reduce/common/files/scratch_folder.hpp"
#include "reduce/common/process/other_program.hpp"

namespace bielle::mechanism {
namespace {

struct HashOfPoint {
  std::size_t operator()(const std::array<float, 3>& p) const {
    std::size_t hash = 0;
    for (const float x : p) hash = (hash ^ std::bit_cast<std::uint32_t>(x)) * 0x9e3779b97f4a7c15ULL;
    return hash;
  }
};

/// Returns a name that can be the name of a group in the results file.
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

namespace {

std::shared_ptr<const DrawnMesh> tessellated(const std::string& path) {
  const std::string reduce = find_sibling_program("bielle-reduce");
  if (reduce.empty())
    throw InputError(
        fmt::format("'{}' cannot be read: bielle-reduce, which makes triangles of it, is neither next to this "
                    "program nor on the PATH",
                    path));
  const ScratchFolder folder;
  const std::string surface = (folder.path() / "surface.stl").string(), said = (folder.path() / "said").string();
  if (run_other_program({reduce, "--surface", path, "-o", surface, "--quiet"}, said) != 0) {
    const std::vector<std::string> lines = lines_of_file(said);
    const std::string label = ": error: ", line = lines.empty() ? "" : lines.back();
    const std::size_t at = line.find(label);
    throw InputError(lines.empty() ? fmt::format("'{}' cannot be made into triangles by bielle-reduce", path)
                                   : line.substr(at == std::string::npos ? 0 : at + label.size()));
  }
  auto mesh = std::make_shared<DrawnMesh>(*mesh_of_stl(surface, 1));
  mesh->name = name_of_file(path);
  return mesh;
}

}  // namespace

std::shared_ptr<const DrawnMesh> mesh_of_geometry(const std::string& path) {
  check_input_file(path);
  struct Known {
    std::filesystem::file_time_type time;
    std::uintmax_t size;
    std::shared_ptr<const DrawnMesh> mesh;
  };
  static std::mutex guard;
  static std::map<std::string, Known> known;  // models are read many times in a study of their parameters
  const std::scoped_lock lock(guard);
  const auto time = std::filesystem::last_write_time(path);
  const auto size = std::filesystem::file_size(path);
  const std::string name = std::filesystem::canonical(path).string();
  if (const auto found = known.find(name);
      found != known.end() && found->second.time == time && found->second.size == size)
    return found->second.mesh;
  const auto mesh = tessellated(path);
  known[name] = {time, size, mesh};
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

// STL files: 80 bytes of header, a count, 50 bytes for each triangle; or text, `solid name`, `facet normal ..`, ..
#include <bit>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>

#include <fmt/format.h>

#include "mechanism/contacts/triangle_surface.hpp"
#include "reduce/common/error.hpp"
#include "reduce/common/files/file_checks.hpp"

namespace bielle::mechanism {
namespace {

constexpr std::size_t stl_header = 84, stl_record = 50;
static_assert(std::endian::native == std::endian::little, "binary STL is little-endian");

std::size_t stl_triangles(const std::string& bytes) {
  std::uint32_t count = 0;
  if (bytes.size() >= stl_header) std::memcpy(&count, bytes.data() + 80, 4);
  return count;
}

std::vector<Vector3> read_binary_stl(const std::string& bytes, double unit) {
  std::vector<Vector3> corners;
  corners.reserve(3 * stl_triangles(bytes));
  for (std::size_t k = 0; k < stl_triangles(bytes); ++k)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      std::array<float, 3> x{};
      std::memcpy(x.data(), bytes.data() + stl_header + k * stl_record + 12 * (corner + 1), 12);
      corners.push_back(unit * Eigen::Map<const Eigen::Vector3f>(x.data()).cast<double>());
    }
  return corners;
}

std::vector<Vector3> read_text_stl(const std::string& text, const std::string& path, double unit) {
  std::vector<Vector3> corners;
  std::istringstream lines(text);
  std::string line, word;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::istringstream words(line);
    if (!(words >> word) || word != "vertex") continue;
    Vector3 corner;
    if (!(words >> corner[0] >> corner[1] >> corner[2]))
      throw InputError(fmt::format("{}:{}: expected three numbers after `vertex`", path, number));
    corners.push_back(unit * corner);
  }
  if (corners.size() % 3 != 0)
    throw InputError(
        fmt::format("{}: {} corners are no multiple of three: some triangle is incomplete", path, corners.size()));
  return corners;
}

}  // namespace

std::vector<Vector3> read_stl(const std::string& path, double unit) {
  check_input_file(path);
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(fmt::format("{}: cannot be read", path));
  const std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const bool binary = bytes.size() >= stl_header && bytes.size() == stl_header + stl_record * stl_triangles(bytes);
  if (!binary && bytes.compare(0, 5, "solid") != 0)
    throw InputError(
        fmt::format("{}: is no STL file: neither as long as its count of triangles says, nor text that "
                    "begins with `solid`",
                    path));
  std::vector<Vector3> corners = binary ? read_binary_stl(bytes, unit) : read_text_stl(bytes, path, unit);
  for (const Vector3& corner : corners)
    if (!corner.allFinite()) throw InputError(fmt::format("{}: has corners that are no numbers", path));
  if (corners.empty()) throw InputError(fmt::format("{}: has no triangles", path));
  return corners;
}

}  // namespace bielle::mechanism

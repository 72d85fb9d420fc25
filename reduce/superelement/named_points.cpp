#include "reduce/superelement/named_points.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "reduce/common/files/hdf5_file.hpp"
#include "reduce/superelement/cut_body.hpp"

namespace bielle {

namespace {

void require_shape(const Hdf5File& file, const std::string& dataset, bool right, const std::string& expected) {
  if (!right) throw InputError(fmt::format("{}: {}: expected {}", file.place(), dataset, expected));
}

NamedPoint read_point(const Hdf5File& file, const std::string& group) {
  NamedPoint point;
  const Eigen::VectorXd position = file.read_vector(group + "/position");
  require_shape(file, group + "/position", position.size() == 3, "three numbers");
  point.position = position;
  point.shapes = file.read_matrix(group + "/shapes");
  require_shape(file, group + "/shapes", point.shapes.rows() == 6, "six rows");
  const std::vector<std::int64_t> residual = file.read_integers(group + "/residual");
  const auto is_flag = [](std::int64_t value) { return value == 0 || value == 1; };
  require_shape(file, group + "/residual",
                residual.size() == 6 && std::all_of(residual.begin(), residual.end(), is_flag), "six times 0 or 1");
  std::copy(residual.begin(), residual.end(), point.residual.begin());
  return point;
}

}  // namespace

void write_named_points(const std::map<std::string, NamedPoint>& points, Hdf5File& file) {
  for (const auto& [name, point] : points) {
    const std::string group = "/points/" + link_name(name);
    file.write(group + "/position", Eigen::VectorXd(point.position), "m", "in body axes");
    file.write(group + "/shapes", point.shapes, "m/u_j, rad/u_j", "displacement x y z and rotation, body axes");
    const std::vector<std::int64_t> residual(point.residual.begin(), point.residual.end());
    file.write(group + "/residual", residual, {residual.size()}, "-",
               "1: loads x y z rx ry rz on the point, body axes, that have residual vectors");
  }
}

std::map<std::string, NamedPoint> read_named_points(const Hdf5File& file) {
  std::map<std::string, NamedPoint> points;
  if (!file.has("/points")) return points;
  for (const std::string& link : file.names_in("/points"))
    points[name_of_link(link)] = read_point(file, "/points/" + link);
  return points;
}

std::map<std::string, PointInFile> read_points_of_file(const std::string& path) {
  std::map<std::string, PointInFile> all;
  Hdf5File file = Hdf5File::open(path);
  const auto add = [&](const std::string& group) {
    file.enter(group);
    for (auto& [name, point] : read_named_points(file)) all[name] = {point, group};
    file.enter("/");
  };
  if (!holds_pieces(path)) {
    add("/");
    return all;
  }
  const std::size_t pieces = file.names_in("/pieces").size();
  for (std::size_t k = 0; k < pieces; ++k) add(group_of_piece(k));
  return all;
}

}  // namespace bielle

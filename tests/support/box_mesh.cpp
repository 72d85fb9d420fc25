#include "tests/support/box_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <vector>

namespace bielle::test {

namespace {

using reduce::CellBlock;
using reduce::CellType;
using reduce::Mesh;

/// Makes each mid-side node only once.
class Edges {
 public:
  explicit Edges(std::vector<Eigen::Vector3d>& points) : points_(points) {}
  int middle(int a, int b) {
    const auto [place, is_new] = numbers_.try_emplace(std::minmax(a, b), static_cast<int>(points_.size()));
    if (is_new) {
      const Eigen::Vector3d point = (points_[a] + points_[b]) / 2;
      points_.push_back(point);
    }
    return place->second;
  }

 private:
  std::vector<Eigen::Vector3d>& points_;
  std::map<std::pair<int, int>, int> numbers_;
};

Eigen::MatrixXi columns(const std::vector<std::vector<int>>& cells) {
  Eigen::MatrixXi result(cells.empty() ? 0 : cells.front().size(), cells.size());
  for (std::size_t e = 0; e < cells.size(); ++e) {
    result.col(e) = Eigen::Map<const Eigen::VectorXi>(cells[e].data(), cells[e].size());
  }
  return result;
}

std::vector<int> sorted_nodes(const Eigen::MatrixXi& nodes, const std::vector<int>& cells) {
  std::vector<int> result;
  for (const int cell : cells) {
    result.insert(result.end(), nodes.col(cell).begin(), nodes.col(cell).end());
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

// Vertices of the cells of a brick. @param at  number of a point of the grid by its place in the brick
std::vector<std::vector<int>> cells_of_brick(int vertices, const std::function<int(int, int, int)>& at, int middle) {
  const std::vector<int> v = {at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0),
                              at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)};
  if (vertices == 8) return {v};
  if (vertices == 6) return {{v[0], v[1], v[2], v[4], v[5], v[6]}, {v[0], v[2], v[3], v[4], v[6], v[7]}};
  std::vector<std::vector<int>> pyramids;
  for (const reduce::CellFace& face : reduce::cell_info(CellType::hex8).faces)  // inward: the apex is inside
    pyramids.push_back({v[face.nodes[3]], v[face.nodes[2]], v[face.nodes[1]], v[face.nodes[0]], middle});
  return pyramids;
}

/// Gives a cell its nodes that are no vertices; each is in the middle of some vertices, and made once.
class Middles {
 public:
  explicit Middles(std::vector<Eigen::Vector3d>& points) : points_(points) {}
  void complete(const reduce::CellInfo& info, std::vector<int>& cell) {
    if (info.order == 1) return;
    for (const auto& [a, b] : info.edges) cell.push_back(middle({cell[a], cell[b]}));
    if (info.type != CellType::hex27) return;
    for (const reduce::CellFace& face : info.faces)
      cell.push_back(middle({cell[face.nodes[0]], cell[face.nodes[1]], cell[face.nodes[2]], cell[face.nodes[3]]}));
    cell.push_back(middle({cell.begin(), cell.begin() + 8}));
  }

 private:
  int middle(std::vector<int> vertices) {
    std::sort(vertices.begin(), vertices.end());
    const auto [place, is_new] = numbers_.try_emplace(vertices, static_cast<int>(points_.size()));
    if (is_new) {
      Eigen::Vector3d mean = Eigen::Vector3d::Zero();
      for (const int v : vertices) mean += points_[v] / static_cast<double>(vertices.size());
      points_.push_back(mean);
    }
    return place->second;
  }
  std::vector<Eigen::Vector3d>& points_;
  std::map<std::vector<int>, int> numbers_;
};

Mesh other_cells(const Box& box, CellType type, const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& map) {
  const reduce::CellInfo& info = reduce::cell_info(type);
  const auto [nx, ny, nz] = box.bricks;
  const auto number = [&, nx_ = nx, ny_ = ny](int i, int j, int k) { return i + (nx_ + 1) * (j + (ny_ + 1) * k); };
  const auto place = [&, nx_ = nx, ny_ = ny, nz_ = nz](double i, double j, double k) {
    return Eigen::Vector3d(Eigen::Vector3d(i / nx_, j / ny_, k / nz_).cwiseProduct(box.size));
  };
  std::vector<Eigen::Vector3d> points;
  for (int k = 0; k <= nz; ++k)
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i) points.push_back(place(i, j, k));
  std::vector<std::vector<int>> cells;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        const auto at = [&](int a, int b, int c) { return number(i + a, j + b, k + c); };
        const int middle = static_cast<int>(points.size());
        if (info.vertices == 5) points.push_back(place(i + 0.5, j + 0.5, k + 0.5));
        for (const std::vector<int>& cell : cells_of_brick(info.vertices, at, middle)) cells.push_back(cell);
      }
  Middles middles(points);
  for (std::vector<int>& cell : cells) middles.complete(info, cell);

  std::map<CellType, std::vector<std::vector<int>>> surface;
  std::map<std::string, std::map<CellType, std::vector<int>>> sides;
  for (const std::vector<int>& cell : cells)
    for (const reduce::CellFace& face : info.faces) {
      std::vector<int> nodes;
      for (const int node : face.nodes) nodes.push_back(cell[node]);
      for (int axis = 0; axis < 3; ++axis)
        for (const double end : {0.0, box.size(axis)}) {
          const auto on_side = [&](int v) { return std::abs(points[v](axis) - end) < 1e-12 * box.size(axis); };
          if (!std::all_of(nodes.begin(), nodes.end(), on_side)) continue;
          const std::string name = std::string(1, "xyz"[axis]) + (end == 0 ? '0' : '1');
          sides[name][face.type].push_back(static_cast<int>(surface[face.type].size()));
          surface[face.type].push_back(nodes);
        }
    }

  Mesh mesh;
  mesh.points.resize(3, points.size());
  for (std::size_t p = 0; p < points.size(); ++p) mesh.points.col(p) = map ? map(points[p]) : points[p];
  mesh.blocks.push_back({type, columns(cells)});
  for (const auto& [face, of_type] : surface) mesh.blocks.push_back({face, columns(of_type)});
  std::vector<int> all(cells.size());
  std::iota(all.begin(), all.end(), 0);
  mesh.groups["solid"] = {3, {{type, all}}, sorted_nodes(mesh.blocks[0].nodes, all)};
  for (const auto& [name, of_types] : sides) {
    reduce::Group& group = mesh.groups[name];
    group.dimension = 2;
    for (const auto& [face, of_type] : of_types) {
      group.parts.push_back({face, of_type});
      for (const int node : sorted_nodes(mesh.block(face)->nodes, of_type)) group.nodes.push_back(node);
    }
    std::sort(group.nodes.begin(), group.nodes.end());
    group.nodes.erase(std::unique(group.nodes.begin(), group.nodes.end()), group.nodes.end());
  }
  return mesh;
}

}  // namespace

Mesh box_mesh(const Box& box, const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& map) {
  if (box.type && reduce::vertex_count(*box.type) != 4) return other_cells(box, *box.type, map);
  const auto [nx, ny, nz] = box.bricks;
  const auto number = [&, nx_ = nx, ny_ = ny](int i, int j, int k) { return i + (nx_ + 1) * (j + (ny_ + 1) * k); };
  std::vector<Eigen::Vector3d> points;
  for (int k = 0; k <= nz; ++k) {
    for (int j = 0; j <= ny; ++j) {
      for (int i = 0; i <= nx; ++i) {
        points.push_back(Eigen::Vector3d(double(i) / nx, double(j) / ny, double(k) / nz).cwiseProduct(box.size));
      }
    }
  }
  // Kuhn's division: from corner 000 to 111 along the axes in each of their six orders; it matches between bricks.
  std::vector<std::vector<int>> tets;
  std::array<int, 3> axes{0, 1, 2};
  do {
    const bool even = (axes[0] + 1) % 3 == axes[1];
    for (int k = 0; k < nz; ++k) {
      for (int j = 0; j < ny; ++j) {
        for (int i = 0; i < nx; ++i) {
          std::array<int, 3> corner{i, j, k};
          std::vector<int> tet{number(i, j, k)};
          for (const int axis : axes) {
            ++corner[axis];
            tet.push_back(number(corner[0], corner[1], corner[2]));
          }
          if (!even) {
            std::swap(tet[2], tet[3]);
          }
          tets.push_back(tet);
        }
      }
    }
  } while (std::next_permutation(axes.begin(), axes.end()));

  // Faces on the sides of the box, seen from outside counter-clockwise.
  const std::vector<Eigen::Vector3d> vertices = points;
  std::map<std::string, std::vector<int>> sides;
  std::vector<std::vector<int>> triangles;
  constexpr int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  for (const std::vector<int>& tet : tets) {
    for (const auto& face : faces) {
      const std::vector<int> triangle{tet[face[0]], tet[face[1]], tet[face[2]]};
      for (int axis = 0; axis < 3; ++axis) {
        for (const double end : {0.0, box.size(axis)}) {
          if (std::all_of(triangle.begin(), triangle.end(), [&](int v) { return vertices[v](axis) == end; })) {
            sides[std::string(1, "xyz"[axis]) + (end == 0 ? '0' : '1')].push_back(static_cast<int>(triangles.size()));
            triangles.push_back(triangle);
          }
        }
      }
    }
  }
  if (box.quadratic) {
    Edges edges(points);
    for (std::vector<int>& t : tets) {
      for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {0, 2}, {0, 3}, {2, 3}, {1, 3}}) {
        t.push_back(edges.middle(t[a], t[b]));
      }
    }
    for (std::vector<int>& t : triangles) {
      for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {2, 0}}) {
        t.push_back(edges.middle(t[a], t[b]));
      }
    }
  }

  Mesh mesh;
  mesh.points.resize(3, points.size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    mesh.points.col(p) = map ? map(points[p]) : points[p];
  }
  const CellType solid = box.quadratic ? CellType::tet10 : CellType::tet4;
  const CellType surface = box.quadratic ? CellType::tri6 : CellType::tri3;
  mesh.blocks = {CellBlock{solid, columns(tets)}, CellBlock{surface, columns(triangles)}};
  std::vector<int> all(tets.size());
  for (std::size_t e = 0; e < all.size(); ++e) {
    all[e] = static_cast<int>(e);
  }
  mesh.groups["solid"] = {3, {{solid, all}}, sorted_nodes(mesh.blocks[0].nodes, all)};
  for (const auto& [name, cells] : sides) {
    mesh.groups[name] = {2, {{surface, cells}}, sorted_nodes(mesh.blocks[1].nodes, cells)};
  }
  return mesh;
}

Mesh distorted_box_mesh(const Box& box, double amount) {
  Mesh mesh = box_mesh(box);
  std::mt19937 random(20240117);
  std::uniform_real_distribution<double> shift(-amount, amount);
  const Eigen::Vector3d edge(box.size(0) / box.bricks[0], box.size(1) / box.bricks[1], box.size(2) / box.bricks[2]);
  const int vertices = (box.bricks[0] + 1) * (box.bricks[1] + 1) * (box.bricks[2] + 1);
  for (int v = 0; v < vertices; ++v) {
    auto x = mesh.points.col(v);
    const bool inside = (x.array() > 0).all() && (x.array() < box.size.array()).all();
    const Eigen::Vector3d by(shift(random), shift(random), shift(random));
    if (inside) {
      x += edge.cwiseProduct(by);
    }
  }
  if (box.quadratic) {
    for (const auto& t : mesh.blocks[0].nodes.colwise()) {
      int k = 4;
      for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {0, 2}, {0, 3}, {2, 3}, {1, 3}}) {
        mesh.points.col(t(k++)) = (mesh.points.col(t(a)) + mesh.points.col(t(b))) / 2;
      }
    }
  }
  return mesh;
}

}  // namespace bielle::test

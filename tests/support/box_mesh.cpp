#include "tests/support/box_mesh.hpp"

#include <algorithm>
#include <map>
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

}  // namespace

Mesh box_mesh(const Box& box, const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& map) {
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

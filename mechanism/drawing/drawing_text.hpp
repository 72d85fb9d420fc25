// The drawing of a mechanism as text in the format of the results file, JSON.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mechanism/drawing/drawing.hpp"

namespace bielle::mechanism {

/// A mesh, and the name of its group in the results file.
struct NamedMesh {
  std::string name;
  std::shared_ptr<const DrawnMesh> mesh;
};

/// The meshes of the items without repetitions: meshes with equal numbers are one.
class DrawnMeshes {
 public:
  explicit DrawnMeshes(const Drawing& drawing);
  /// Returns the meshes with their names; equal names of different meshes are numbered: "arm", "arm_2".
  const std::vector<NamedMesh>& all() const { return all_; }
  /// Returns the name of an item's mesh.
  const std::string& name_of(const DrawnMesh& mesh) const { return all_[index_.at(&mesh)].name; }

 private:
  std::vector<NamedMesh> all_;
  std::map<const DrawnMesh*, std::size_t> index_;
};

/// Data of the whole mechanism that a drawing contains.
struct DrawnMechanism {
  std::string name;
  std::array<double, 3> gravity{};  ///< [m/s^2]
  std::vector<std::string> nodes;   ///< names of the model's nodes
  /// Internal nodes of beams, which are recorded with the element: the group of its results, "elements/blade", and the
  /// number of the node from the start of the beam.
  std::map<int, std::pair<std::string, int>> inner;
};

/// Returns the drawing as JSON, see mechanism/io/drawing.md. @param meshes  its meshes
std::string drawing_text(const Drawing& drawing, const DrawnMechanism& mechanism, const DrawnMeshes& meshes);

}  // namespace bielle::mechanism

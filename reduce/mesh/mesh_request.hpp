// The user's request for the mesh of a body: the geometry, the sizes of elements, and the surfaces with their names.
//
// The `subject` of a request is the key by which the user makes it. It stands in messages about the request and is
// empty if there is no key.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>

namespace bielle::reduce {

/// A circular cylinder, infinite along its axis.
struct CylinderSelector {
  Eigen::Vector3d point;  ///< on the axis [m]
  Eigen::Vector3d axis;   ///< any length but zero
  double radius = 0;      ///< [m]
};

struct PlaneSelector {
  Eigen::Vector3d point;   ///< in the plane [m]
  Eigen::Vector3d normal;  ///< any length but zero, either sense
};

/// An axis-parallel box, including its faces.
struct BoxSelector {
  Eigen::Vector3d low, high;  ///< opposite corners [m]
};

/// Position of a surface: on or in all of the given shapes, at least one.
struct ShapeSelector {
  ShapeSelector(const CylinderSelector& shape) : cylinder(shape) {}
  ShapeSelector(const PlaneSelector& shape) : plane(shape) {}
  ShapeSelector(const BoxSelector& shape) : box(shape) {}
  ShapeSelector(const std::optional<CylinderSelector>& on_cylinder, const std::optional<PlaneSelector>& on_plane,
                const std::optional<BoxSelector>& in_box)
      : cylinder(on_cylinder), plane(on_plane), box(in_box) {}

  std::optional<CylinderSelector> cylinder;
  std::optional<PlaneSelector> plane;
  std::optional<BoxSelector> box;
};

/// The name of a physical group of the geometry, or shapes.
using SurfaceSelector = std::variant<std::string, ShapeSelector>;

/// One or more selectors whose surfaces together become a surface group.
struct SurfaceSelection {
  std::string group;                       ///< name of the group in the mesh: the physical group's own, or a new one
  std::vector<SurfaceSelector> selectors;  ///< their union
  std::string subject;                     ///< "interfaces.big_end.surface"
};

/// Nodes of the file that become a group of the mesh.
struct NodeSelection {
  std::string group;              ///< name of the new group
  std::vector<std::size_t> tags;  ///< the (converted) file's numbers of the nodes, each once
  std::vector<double> weights;    ///< one for each node
  std::string subject;            ///< "interfaces.hub.from"
};

/// A volume group that must exist.
struct VolumeSelection {
  std::string group;    ///< physical volume, or "all"
  std::string subject;  ///< "regions.rod"
};

/// One or several solids of a geometry that holds more.
struct SolidSelection {
  std::string name;     ///< number of a volume as `--list` prints it, name of a solid or part, or physical volume
  std::string subject;  ///< "volumes[1]"
};

/// Edge length on one group of a geometry that differs from the general one.
struct GroupSize {
  double size = 0;      ///< [m]
  std::string subject;  ///< "mesh.sizes.bore_big"
};

/// A plane along which the body is cut into pieces.
struct CutPlane {
  std::string name;        ///< name of the cut: "cut_1"
  Eigen::Vector3d point;   ///< in the plane [m]
  Eigen::Vector3d normal;  ///< unit normal, either sense
  std::string subject;     ///< "pieces.planes[1]"
};

/// All data that import_mesh needs. Lengths are in SI except for the geometry's own numbers.
struct MeshRequest {
  std::string path;                        ///< geometry or mesh
  std::string subject;                     ///< "geometry"
  std::optional<std::string> length_unit;  ///< unit of a file that declares none; absent: m
  std::string length_unit_subject;         ///< "length_unit"
  std::optional<double> size;              ///< largest edge of the elements [m]; absent: the geometry's own
  std::optional<int> order;                ///< 1 or 2; absent: 2 for a geometry, as it is for a mesh
  std::map<std::string, GroupSize> sizes;  ///< by physical group or by the `group` of a selection
  std::optional<bool> hexahedra;           ///< whether a geometry is meshed into hexahedra; absent: tetrahedra
  bool heal = false;                       ///< whether tiny edges and faces of a geometry are removed
  std::string heal_subject;                ///< "mesh.heal"
  std::optional<int> curvature;            ///< edges on a full circle of a curved surface, at least
  std::string mesh_subject;                ///< "mesh"
  std::vector<SurfaceSelection> surfaces;
  std::vector<NodeSelection> nodes;
  std::vector<VolumeSelection> volumes;
  std::vector<SolidSelection> solids;  ///< solids of the geometry that make the body; empty: all
  bool glue = false;                   ///< whether solids that touch get common faces
  std::string glue_subject;            ///< "glue"
  bool system_calls = false;           ///< whether a file that is a script (.geo) may run shell commands
  std::vector<CutPlane> cuts;          ///< planes in which faces of the elements shall lie if the geometry can be cut
};

}  // namespace bielle::reduce

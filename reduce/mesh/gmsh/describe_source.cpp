#include "reduce/mesh/gmsh/describe_source.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmsh.h>

#include "reduce/common/error.hpp"
#include "reduce/common/progress.hpp"
#include "reduce/mesh/checks.hpp"
#include "reduce/mesh/gmsh/describe_solids.hpp"
#include "reduce/mesh/gmsh/model.hpp"
#include "reduce/mesh/gmsh/session.hpp"
#include "reduce/mesh/groups.hpp"
#include "reduce/mesh/length_unit.hpp"
#include "reduce/mesh/patches.hpp"
#include "reduce/mesh/place.hpp"
#include "reduce/mesh/shapes.hpp"
#include "reduce/mesh/source_file.hpp"

namespace bielle::reduce {

namespace {

using Eigen::AlignedBox3d;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

// A surface of a geometry or a patch of a mesh.
struct SurfaceEntry {
  std::string name;  // "surface 12", "patch 3"
  Shape shape;
  std::string kind;  // the geometry's name of the shape, if it is not a recognised one
  bool hollow = false;
  std::optional<double> area;      // [m^2]
  std::optional<Vector3d> centre;  // [m]
  AlignedBox3d box;                // [m]
  std::string groups;              // "bore_big, all_bores"
};

std::string numbers(const Vector3d& v) {
  const double noise = std::max(1e-9 * v.cwiseAbs().maxCoeff(), 1e-12);
  const auto shown = [&](double x) { return std::abs(x) <= noise ? 0.0 : x; };
  return fmt::format("[{:.9g}, {:.9g}, {:.9g}]", shown(v.x()), shown(v.y()), shown(v.z()));
}

// The line of a body file that selects this surface. @param in_box  restricts a plane or cylinder to this surface alone
std::string selector_line(const SurfaceEntry& entry, bool in_box, double margin) {
  std::string shape;
  if (const auto* c = std::get_if<CylinderShape>(&entry.shape))
    shape = fmt::format("cylinder: {{point: {}, axis: {}, radius: {:.9g}}}", numbers(c->point), numbers(c->axis),
                        c->radius);
  if (const auto* p = std::get_if<PlaneShape>(&entry.shape))
    shape = fmt::format("plane: {{point: {}, normal: {}}}", numbers(p->normal * p->normal.dot(p->point)),
                        numbers(p->normal));
  if (shape.empty() || in_box)
    shape += fmt::format("{}box: [{}, {}]", shape.empty() ? "" : ", ", numbers(entry.box.min().array() - margin),
                         numbers(entry.box.max().array() + margin));
  return fmt::format("surface: {{{}}}", shape);
}

// Tells whether both lie on the same infinite plane or cylinder, within the tolerance of selection.
bool same_shape(const SurfaceEntry& one, const SurfaceEntry& other, double tolerance) {
  if (const auto* a = std::get_if<PlaneShape>(&one.shape), *b = std::get_if<PlaneShape>(&other.shape); a && b)
    return a->normal.cross(b->normal).norm() < 1e-4 && std::abs(a->normal.dot(b->point - a->point)) < tolerance;
  if (const auto* a = std::get_if<CylinderShape>(&one.shape), *b = std::get_if<CylinderShape>(&other.shape); a && b)
    return a->axis.cross(b->axis).norm() < 1e-4 && a->axis.cross(b->point - a->point).norm() < tolerance &&
           std::abs(a->radius - b->radius) < tolerance;
  return false;
}

std::string surfaces_text(const std::vector<SurfaceEntry>& entries, double body_size) {
  std::string text;
  for (const SurfaceEntry& entry : entries) {
    const auto* plane = std::get_if<PlaneShape>(&entry.shape);
    const std::string shape = plane != nullptr           ? "plane normal to " + direction_name(plane->normal)
                              : entry.shape.index() != 0 ? shape_name(entry.shape)
                                                         : entry.kind;
    std::vector<std::string> others;
    for (const SurfaceEntry& other : entries)
      if (&other != &entry && same_shape(entry, other, 1e-4 * body_size)) others.push_back(other.name);
    text += fmt::format("  {}: {}{}{}{}{}\n    {}\n", entry.name, shape, entry.hollow ? " (a bore)" : "",
                        entry.area ? fmt::format(", area {:.4g} m^2", *entry.area) : "",
                        entry.centre ? fmt::format(", centre {}", place_name(*entry.centre)) : "",
                        entry.groups.empty() ? "" : "; in " + entry.groups,
                        selector_line(entry, !others.empty(), 1e-3 * body_size));
    if (!others.empty()) text += fmt::format("    (without the box also {})\n", fmt::join(others, ", "));
  }
  return text;
}

std::vector<std::pair<int, int>> entities(int dimension) {
  gmsh::vectorpair pairs;
  gmsh::model::getEntities(pairs, dimension);
  return pairs;
}

// Value number i of a parameter, evenly spaced, both ends included.
double spread(double low, double high, int i, int count) { return low + (high - low) * i / (count - 1); }

// Points on a curve of the geometry.
Matrix3Xd curve_points(int tag, double metres) {
  constexpr int count = 65;  // a full circle along the axes has its extreme points among them
  std::vector<double> low, high, parameters, points;
  gmsh::model::getParametrizationBounds(1, tag, low, high);
  for (int i = 0; i < count; ++i) parameters.push_back(spread(low[0], high[0], i, count));
  gmsh::model::getValue(1, tag, parameters, points);
  return metres * Eigen::Map<Matrix3Xd>(points.data(), 3, points.size() / 3);
}

// Points of a surface of the geometry, the normals there, and a flag for points that belong to its trimmed part.
struct SurfacePoints {
  Matrix3Xd x, n;
  std::vector<char> inside;
};

SurfacePoints surface_points(int tag, double metres) {
  constexpr int count = 13;
  std::vector<double> low, high, parameters, points, normals;
  gmsh::model::getParametrizationBounds(2, tag, low, high);
  SurfacePoints result;
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) {
      const std::vector<double> place = {spread(low[0], high[0], i, count), spread(low[1], high[1], j, count)};
      parameters.insert(parameters.end(), place.begin(), place.end());
      result.inside.push_back(gmsh::model::isInside(2, tag, place) > 0);
    }
  gmsh::model::getValue(2, tag, parameters, points);
  gmsh::model::getNormal(tag, parameters, normals);
  result.x = metres * Eigen::Map<Matrix3Xd>(points.data(), 3, points.size() / 3);
  result.n = Eigen::Map<Matrix3Xd>(normals.data(), 3, normals.size() / 3);
  return result;
}

// Measures the shape and the box of a surface. (OpenCASCADE's own boxes of free-form surfaces enclose their control
// points, which lie outside.)
void measure_surface(int tag, double metres, SurfaceEntry& entry) {
  gmsh::vectorpair curves;
  gmsh::model::getBoundary({{2, tag}}, curves, false, false, false);
  for (const auto& [dim, curve] : curves) {
    const Matrix3Xd points = curve_points(curve, metres);
    for (Eigen::Index i = 0; i < points.cols(); ++i) entry.box.extend(Vector3d(points.col(i)));
  }
  const SurfacePoints points = surface_points(tag, metres);
  for (Eigen::Index i = 0; i < points.x.cols(); ++i)
    if (points.inside[i]) entry.box.extend(Vector3d(points.x.col(i)));
  if (points.x.allFinite() && points.n.allFinite())
    entry.shape = recognise_shape(points.x, points.n, 1e-5 * entry.box.diagonal().norm());
}

std::string geometry_text(double metres, const std::map<std::string, double>& densities) {
  const std::vector<PhysicalGroup> groups = physical_groups();
  gmsh::vectorpair exact;  // entities of the OpenCASCADE kernel: these know their size
  gmsh::model::occ::getEntities(exact);
  const auto is_exact = [&](const std::pair<int, int>& e) {
    return std::find(exact.begin(), exact.end(), e) != exact.end();
  };

  std::map<int, SurfaceEntry> surfaces;
  for (const auto& [dim, tag] : entities(2)) {
    SurfaceEntry& entry = surfaces[tag];
    entry.name = fmt::format("surface {}", tag);
    gmsh::model::getType(2, tag, entry.kind);
    measure_surface(tag, metres, entry);
    entry.groups = fmt::format("{}", fmt::join(groups_of(groups, 2, tag), ", "));
    if (!is_exact({dim, tag})) continue;
    double area;
    Vector3d centre;
    gmsh::model::occ::getMass(2, tag, area);
    gmsh::model::occ::getCenterOfMass(2, tag, centre.x(), centre.y(), centre.z());
    entry.area = area * metres * metres;
    entry.centre = metres * centre;
  }

  AlignedBox3d body;
  std::map<int, AlignedBox3d> boxes;
  std::vector<SurfaceEntry> sorted;
  for (const auto& [tag, entry] : surfaces) {
    body.extend(entry.box);
    boxes[tag] = entry.box;
    sorted.push_back(entry);
  }
  std::stable_sort(sorted.begin(), sorted.end(), [](const SurfaceEntry& a, const SurfaceEntry& b) {
    return a.area.value_or(0) > b.area.value_or(0);
  });
  return "volumes\n" + solids_text(boxes, metres, densities) + "surfaces\n" +
         surfaces_text(sorted, body.diagonal().norm());
}

std::string mesh_text(GmshSession& session, const SourceFile& source) {
  std::string text = "cells\n";
  for (const auto& [name, count] : cell_counts()) text += fmt::format("  {} {}\n", count, name);
  Mesh mesh;
  ExtractedModel model;
  try {
    model = extract_model(session, source.name, source.metres);
    mesh.points = std::move(model.points);
    mesh.blocks = std::move(model.solids);
  } catch (const InputError& error) {
    return text + fmt::format("  not usable as it is: {}\n", error.what());
  }
  text += fmt::format("  {}\n", summary(mesh));

  const FaceTable faces(mesh);
  const BodySurface surface = body_surface(model, faces, false);
  std::map<int, std::set<std::string>> groups_of_face;
  for (const PhysicalGroup& group : model.groups)
    if (group.dimension == 2)
      for (int entity : group.entities)
        if (const auto found = model.surfaces.find(entity); found != model.surfaces.end())
          for (const Corners& cell : found->second)
            if (const auto face = faces.find(cell)) groups_of_face[*face].insert(group.name);
  std::vector<SurfaceEntry> entries;
  int number = 0;
  for (const Patch& patch : find_patches(mesh.points, surface)) {
    SurfaceEntry entry{fmt::format("patch {}", ++number),
                       patch.shape,
                       "free form",
                       patch.hollow,
                       patch.area,
                       patch.centre,
                       patch.box,
                       ""};
    std::set<std::string> names;
    for (int side : patch.sides)
      if (const auto found = groups_of_face.find(surface.faces[side]); found != groups_of_face.end())
        names.insert(found->second.begin(), found->second.end());
    for (const std::string& name : names) entry.groups += (entry.groups.empty() ? "" : ", ") + name;
    entries.push_back(entry);
  }
  const double size = (mesh.points.rowwise().maxCoeff() - mesh.points.rowwise().minCoeff()).norm();
  text += surface.entities.empty() ? "surface, divided at edges of more than 40 degrees\n" : "surfaces of the file\n";
  return text + surfaces_text(entries, size);
}

std::string groups_text() {
  std::string text;
  for (int dimension : {3, 2}) {
    text += dimension == 3 ? "physical volumes (for regions):" : "physical surfaces (for interfaces and loads):";
    std::string names;
    for (const PhysicalGroup& group : physical_groups())
      if (group.dimension == dimension) names += (names.empty() ? " " : ", ") + group.name;
    text += names.empty() ? (dimension == 3 ? " none; use all" : " none; select by shape") : names;
    text += "\n";
  }
  return text;
}

}  // namespace

std::string describe_source(const std::string& path, const SourceFile& source,
                            const std::map<std::string, double>& densities) {
  GmshSession session;
  open_model(session, source);
  const double extent = model_extent(session);
  std::string text;
  session.read(fmt::format("'{}' cannot be listed", path), [&] {
    const bool mesh = !source.geometry || model_has_cells(3);
    text = fmt::format("{}: {}; {}\n", path, mesh ? "a mesh" : "a geometry", source.unit_note);
    if (const std::string warning = implausible_length(source.metres * extent); !warning.empty())
      text += warning + "\n";
    text += groups_text();
    text += mesh ? mesh_text(session, source) : geometry_text(source.metres, densities);
  });
  return text;
}

}  // namespace bielle::reduce

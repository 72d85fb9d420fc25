#include "reduce/reduction/piece_options.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reduce/common/error.hpp"
#include "reduce/fe/weighted_nodes.hpp"
#include "reduce/superelement/point_weights.hpp"

namespace bielle::reduce {

namespace {

/// Tells whether the mesh has a surface or nodes of that name.
bool has_surface(const Mesh& mesh, const std::string& group) {
  const auto found = mesh.groups.find(group);
  return found != mesh.groups.end() && found->second.dimension != 3;
}

std::vector<std::size_t> pieces_with(const CutMesh& cut, const std::string& group) {
  std::vector<std::size_t> pieces;
  for (std::size_t k = 0; k < cut.pieces.size(); ++k)
    if (has_surface(cut.pieces[k].mesh, group)) pieces.push_back(k);
  return pieces;
}

void check_unlike_cuts(const CutMesh& cut, const InterfaceRequest& request) {
  for (const MeshCut& surface : cut.cuts)
    if (surface.name == request.name)
      throw InputError(
          request.subject,
          fmt::format("a cut has the name '{}', too: give it or this interface another one", request.name));
}

/// Throws if a cut passes through the surface.
/// @param rule  "an interface belongs to one; move the cut, or divide the interface"
std::size_t piece_of_surface(const Mesh& whole, const CutMesh& cut, const std::string& group,
                             const std::string& subject, const std::string& rule) {
  const std::vector<std::size_t> pieces = pieces_with(cut, group);
  if (pieces.empty()) {
    about(subject, [&] { return integrate_tied(whole, group); });  // throws with the reason, unless the group consists
                                                                   // of nodes
    throw InputError(subject, fmt::format("its nodes lie in several pieces: {}", rule));
  }
  if (pieces.size() == 1) return pieces.front();
  std::vector<std::string> through;
  for (const MeshCut& surface : cut.cuts) {
    const bool between = std::all_of(surface.pieces.begin(), surface.pieces.end(), [&](int piece) {
      return std::find(pieces.begin(), pieces.end(), static_cast<std::size_t>(piece)) != pieces.end();
    });
    if (between) through.push_back("'" + surface.name + "'");
  }
  throw InputError(
      subject,
      fmt::format("its surface lies in {} pieces{}: {}", pieces.size(),
                  through.empty() ? "" : fmt::format(", on both sides of {}", fmt::join(through, ", ")), rule));
}

std::size_t piece_of(const Mesh& whole, const CutMesh& cut, const InterfaceRequest& request) {
  check_unlike_cuts(cut, request);
  return piece_of_surface(whole, cut, request.group, request.subject,
                          "an interface belongs to one; move the cut, or divide the interface");
}

/// Returns the piece nearest to a place, the first of several.
std::size_t piece_at(const CutMesh& cut, const Eigen::Vector3d& place) {
  std::vector<double> distances;
  for (const MeshPart& piece : cut.pieces) distances.push_back(distance_from_mesh(piece.mesh.points, place));
  return static_cast<std::size_t>(std::min_element(distances.begin(), distances.end()) - distances.begin());
}

std::size_t piece_of(const Mesh& whole, const CutMesh& cut, const PointRequest& request) {
  if (!request.group.empty())
    return piece_of_surface(whole, cut, request.group, request.subject,
                            "a point belongs to one; move the cut, or take a part of the surface");
  return piece_at(cut, request.position.value());
}

std::size_t piece_of(const Mesh& whole, const CutMesh& cut, const MassRequest& request) {
  if (request.place) return piece_at(cut, *request.place);
  return piece_of_surface(whole, cut, request.group, request.subject,
                          "a mass belongs to one; move the cut, or divide the mass");
}

InterfaceRequest cut_interface(const MeshCut& cut, const CutPlane& plane, const CutSurface& surface, Tie tie) {
  InterfaceRequest request;
  request.name = cut.name;
  request.group = cut.group;
  request.tie = tie;
  if (tie == Tie::free)
    request.kept = {true, true, true, false, false, false};
  else
    request.position = surface.position;
  request.subject = plane.subject;
  return request;
}

/// Converts loads to force per area, which is the same for all parts of a divided surface.
std::vector<LoadRequest> loads_by_area(const Mesh& whole, const std::vector<LoadRequest>& loads) {
  std::vector<LoadRequest> result = loads;
  for (LoadRequest& load : result) {
    const SurfaceIntegrals surface = about(load.subject, [&] { return integrate_surface(whole, load.group); });
    if (!load.force) continue;
    load.traction = Eigen::Vector3d(*load.force / surface.area);
    load.force.reset();
  }
  return result;
}

ReductionOptions without_parts(const ReductionOptions& options) {
  ReductionOptions result = options;
  result.interfaces.clear();
  result.loads.clear();
  result.points.clear();
  result.masses.clear();
  result.coatings.clear();
  result.regions.clear();
  result.damping_ratios.clear();
  return result;
}

}  // namespace

std::vector<CutSurface> cut_surfaces(const CutMesh& cut) {
  std::vector<CutSurface> result;
  for (const MeshCut& surface : cut.cuts) {
    const SurfaceIntegrals integrals = integrate_surface(cut.pieces[surface.pieces[0]].mesh, surface.group);
    result.push_back({surface.name, surface.pieces, integrals.centroid, integrals.area, surface.distance});
  }
  return result;
}

std::vector<ReductionOptions> piece_options(const Mesh& whole, const CutMesh& cut, const std::vector<CutPlane>& planes,
                                            const std::vector<CutSurface>& surfaces, const ReductionOptions& options,
                                            Tie tie) {
  std::vector<ReductionOptions> result;
  for (std::size_t k = 0; k < cut.pieces.size(); ++k) {
    result.push_back(without_parts(options));
    result.back().name = fmt::format("{}.{}", options.name, k + 1);
    for (const auto& [region, material] : options.regions)
      if (region == "all" || cut.pieces[k].mesh.groups.contains(region)) result.back().regions[region] = material;
  }
  for (const InterfaceRequest& request : options.interfaces)
    result[piece_of(whole, cut, request)].interfaces.push_back(request);
  for (const PointRequest& request : options.points) result[piece_of(whole, cut, request)].points.push_back(request);
  for (const MassRequest& request : options.masses) result[piece_of(whole, cut, request)].masses.push_back(request);
  for (const CoatingRequest& request : options.coatings) {
    about(request.subject, [&] { return integrate_surface(whole, request.group); });
    for (const std::size_t piece : pieces_with(cut, request.group)) result[piece].coatings.push_back(request);
  }
  for (std::size_t c = 0; c < cut.cuts.size(); ++c)
    for (const int piece : cut.cuts[c].pieces)
      result[piece].interfaces.push_back(cut_interface(cut.cuts[c], planes[cut.cuts[c].plane], surfaces[c], tie));
  for (const LoadRequest& load : loads_by_area(whole, options.loads))
    for (const std::size_t piece : pieces_with(cut, load.group)) result[piece].loads.push_back(load);
  return result;
}

}  // namespace bielle::reduce

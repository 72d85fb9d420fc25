#include "reduce/mesh/gmsh/gluing.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmsh.h>

#include "reduce/common/error.hpp"
#include "reduce/common/percent.hpp"
#include "reduce/common/progress.hpp"
#include "reduce/mesh/disjoint_sets.hpp"
#include "reduce/mesh/gmsh/fragments.hpp"

namespace bielle::reduce {

namespace {

constexpr std::size_t most_named = 6;  // solids or pairs of them in a message

// Joins the first names by semicolons and counts the others.
std::string some_of(std::vector<std::string> names) {
  if (names.size() > most_named) {
    const std::string rest = fmt::format("and {} more", names.size() - most_named);
    names.resize(most_named);
    names.push_back(rest);
  }
  return fmt::format("{}", fmt::join(names, "; "));
}

// Divides the solids at each other. A part of two solids, in which they overlap, is left to both.
void divide_solids(std::vector<BodySolid>& solids) {
  const std::vector<NumberedGroup> groups = numbered_groups();
  const Parts parts_of = divide_volumes({});
  for (BodySolid& solid : solids) {
    std::vector<int> parts;
    for (const int volume : solid.volumes)
      for (const auto& [dimension, part] : parts_of.at({3, volume}))
        if (dimension == 3) parts.push_back(part);
    solid.volumes = parts;
  }
  restore_groups(groups, parts_of);
}

// "'arm' (volume 1) and 'pin' (volume 2) by 1e-06 m^3, 12 % of the smaller one" for each pair of divided solids with
// common volumes.
std::vector<std::string> overlaps(const std::vector<BodySolid>& solids, double metres) {
  std::map<int, std::vector<std::size_t>> owners;
  for (std::size_t k = 0; k < solids.size(); ++k)
    for (const int volume : solids[k].volumes) owners[volume].push_back(k);
  std::map<std::pair<std::size_t, std::size_t>, BodySolid> common;  // the common volumes of a pair
  for (const auto& [volume, of_volume] : owners)
    for (std::size_t i = 0; i < of_volume.size(); ++i)
      for (std::size_t j = i + 1; j < of_volume.size(); ++j)
        common[{of_volume[i], of_volume[j]}].volumes.push_back(volume);
  std::vector<std::string> result;
  for (const auto& [pair, shared] : common) {
    const BodySolid &one = solids[pair.first], &other = solids[pair.second];
    const double volume = volume_of(shared), smaller = std::min(volume_of(one), volume_of(other));
    result.push_back(fmt::format("{} and {} by {:.3g} m^3, {} of the smaller one", one.label(), other.label(),
                                 volume * std::pow(metres, 3), percent(volume / smaller)));
  }
  return result;
}

}  // namespace

void glue_solids(const MeshRequest& request, const SourceFile& source, std::vector<BodySolid>& solids,
                 Progress& progress) {
  if (!is_open_cascade())
    throw InputError(request.glue_subject,
                     fmt::format("'{}' is a geometry of gmsh's own kernel, whose solids cannot be glued; let them use "
                                 "common surfaces, or begin it with SetFactory(\"OpenCASCADE\")",
                                 source.name));
  if (solids.size() == 1) {
    progress.note(fmt::format("glue: the body is a single solid, {}: there is nothing to glue", solids[0].label()));
    return;
  }
  divide_solids(solids);
  if (const std::vector<std::string> found = overlaps(solids, source.metres); !found.empty())
    throw InputError(request.glue_subject,
                     fmt::format("solids overlap: {}; solids that are glued may touch only: cut one by the other in "
                                 "the geometry, or select others by volumes",
                                 some_of(found)));
}

void check_one_piece(const MeshRequest& request, const SourceFile& source, const std::vector<BodySolid>& solids) {
  DisjointSets sets(static_cast<int>(solids.size()));
  std::map<int, int> first_solid_at;  // point -> solid
  for (int k = 0; k < static_cast<int>(solids.size()); ++k) {
    gmsh::vectorpair volumes, points;
    for (const int volume : solids[k].volumes) volumes.emplace_back(3, volume);
    gmsh::model::getBoundary(volumes, points, false, false, true);
    for (const auto& [dimension, point] : points) sets.join(first_solid_at.emplace(point, k).first->second, k);
  }
  std::map<int, std::string> pieces;
  for (int k = 0; k < static_cast<int>(solids.size()); ++k) {
    std::string& names = pieces[sets.of(k)];
    names += (names.empty() ? "" : ", ") + solids[k].label();
  }
  if (pieces.size() == 1) return;
  std::vector<std::string> names;
  for (const auto& [set, members] : pieces) names.push_back(members);
  std::string advice = "if they touch, `glue: true` joins them; `volume: <number or name>` selects one";
  if (request.glue) advice = "they do not touch: move them in the geometry, or select those that touch by volumes";
  if (!is_open_cascade()) advice = "let them use common surfaces, or select one by `volume: <number or name>`";
  throw InputError(request.subject, fmt::format("the body is in {} pieces that share no faces, solids of '{}': {}; {}",
                                                pieces.size(), source.name, some_of(names), advice));
}

}  // namespace bielle::reduce

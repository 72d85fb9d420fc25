#include "reduce/mesh/gmsh/solid_selection.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>
#include <variant>

#include <fmt/format.h>
#include <gmsh.h>

#include "reduce/common/error.hpp"
#include "reduce/common/sort_unique.hpp"
#include "reduce/mesh/gmsh/fragments.hpp"
#include "reduce/mesh/groups.hpp"

namespace bielle::reduce {

namespace {

bool is_number(const std::string& text) {
  char* end = nullptr;
  std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0';
}

// @throws InputError that no solid is called so
[[noreturn]] void fail_unknown_solid(const SolidSelection& selection, const std::vector<BodySolid>& solids,
                                     const std::vector<PhysicalGroup>& groups, const std::string& file) {
  std::vector<std::string> names = group_names(groups, 3), numbers;
  for (const BodySolid& solid : solids) {
    names.push_back(solid.name());
    numbers.push_back(std::to_string(solid.number));
  }
  sort_unique(names);
  if (is_number(selection.name))
    throw InputError(selection.subject, fmt::format("there is no volume {} in '{}'{}", selection.name, file,
                                                    did_you_mean(selection.name, numbers)));
  throw InputError(selection.subject, fmt::format("'{}' is no solid, part or physical volume of '{}'{}", selection.name,
                                                  file, did_you_mean(selection.name, names)));
}

// Places in the list of the solids that a selection means.
std::vector<std::size_t> selected_solids(const SolidSelection& selection, const std::vector<BodySolid>& solids,
                                         const std::vector<PhysicalGroup>& groups, const std::string& file) {
  const PhysicalGroup* group = find_group(groups, selection.name);
  std::vector<std::size_t> by_number, by_group, by_name;
  for (std::size_t k = 0; k < solids.size(); ++k) {
    if (std::to_string(solids[k].number) == selection.name) by_number.push_back(k);
    if (group != nullptr && group->dimension == 3 &&
        std::count(group->entities.begin(), group->entities.end(), solids[k].number) > 0)
      by_group.push_back(k);
    if (solids[k].is_called(selection.name)) by_name.push_back(k);
  }
  for (const auto& found : {by_number, by_group, by_name})
    if (!found.empty()) return found;
  fail_unknown_solid(selection, solids, groups, file);
}

// Removes all solids but these, and reduces the physical groups to what is left.
void keep_solids(const std::vector<BodySolid>& kept) {
  std::set<int> numbers;
  for (const BodySolid& solid : kept) numbers.insert(solid.number);
  gmsh::vectorpair removed;
  for (const BodySolid& solid : solids_of_model())
    if (!numbers.contains(solid.number)) removed.emplace_back(3, solid.number);
  if (removed.empty()) return;
  const std::vector<NumberedGroup> groups = numbered_groups();
  if (is_open_cascade()) {
    gmsh::model::occ::remove(removed, true);
    gmsh::model::occ::synchronize();
  } else {
    gmsh::model::removeEntities(removed, true);
  }
  gmsh::vectorpair left;
  gmsh::model::getEntities(left);
  Parts rest;
  for (const Entity& entity : left) rest[entity] = {entity};
  restore_groups(groups, rest);
}

// @throws InputError if the request names a group that the removed solids alone had
void check_groups_left(const MeshRequest& request, const std::vector<PhysicalGroup>& before,
                       const std::vector<PhysicalGroup>& after) {
  const auto check = [&](const std::string& subject, const std::string& name) {
    const PhysicalGroup* group = find_group(before, name);
    if (group != nullptr && find_group(after, name) == nullptr)
      throw InputError(subject, fmt::format("the physical {} '{}' belongs to none of the selected solids",
                                            group->dimension == 3 ? "volume" : "surface", name));
  };
  for (const VolumeSelection& volume : request.volumes) check(volume.subject, volume.group);
  for (const auto& [name, size] : request.sizes) check(size.subject, name);
  for (const SurfaceSelection& selection : request.surfaces)
    for (const SurfaceSelector& selector : selection.selectors)
      if (const auto* name = std::get_if<std::string>(&selector)) check(selection.subject, *name);
}

}  // namespace

std::vector<BodySolid> select_solids(const MeshRequest& request, const SourceFile& source) {
  const std::vector<BodySolid> solids = solids_of_model();
  if (request.solids.empty()) return solids;
  const std::vector<PhysicalGroup> groups = physical_groups();
  std::map<std::size_t, const SolidSelection*> chosen;
  for (const SolidSelection& selection : request.solids)
    for (const std::size_t k : selected_solids(selection, solids, groups, source.name))
      if (const auto [place, is_new] = chosen.emplace(k, &selection); !is_new)
        throw InputError(selection.subject, fmt::format("{} is selected twice, by '{}' and by '{}'", solids[k].label(),
                                                        place->second->name, selection.name));
  std::vector<BodySolid> result;
  for (const auto& [k, selection] : chosen) result.push_back(solids[k]);
  keep_solids(result);
  check_groups_left(request, groups, physical_groups());
  return result;
}

}  // namespace bielle::reduce

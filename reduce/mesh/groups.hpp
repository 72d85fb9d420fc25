// Named groups of a mesh: physical groups of the file, and surfaces that the user selects by shape.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "reduce/mesh/extracted_model.hpp"
#include "reduce/mesh/faces.hpp"
#include "reduce/mesh/mesh.hpp"
#include "reduce/mesh/mesh_request.hpp"

namespace bielle::reduce {

/// Names of the physical groups of one dimension.
std::vector<std::string> group_names(const std::vector<PhysicalGroup>& groups, int dimension);
/// Names of the physical groups that an entity belongs to.
std::vector<std::string> groups_of(const std::vector<PhysicalGroup>& groups, int dimension, int entity);

/// Returns nullptr if there is none of that name.
const PhysicalGroup* find_group(const std::vector<PhysicalGroup>& groups, const std::string& name);

/// Checks that every physical group that the user names exists with the right dimension.
/// @throws InputError about the selection, with the nearest name
void check_groups(const MeshRequest& request, const std::vector<PhysicalGroup>& groups);

/// Adds the volume groups of the model; `all` if it has none.
void add_volume_groups(const ExtractedModel& model, Mesh& mesh);

/// Gives the mesh surface groups: each is made of faces, which may belong to several. Empty groups are left out.
void add_surface_cells(const std::map<std::string, std::vector<int>>& groups, const FaceTable& faces, Mesh& mesh);

/// Adds the groups of nodes that the user selects. @throws InputError about the selection if a node is in no solid cell
void add_node_groups(const MeshRequest& request, const ExtractedModel& model, Mesh& mesh);

/// Adds the surface groups of the model and those that the user selects, and their surface cells.
/// @param geometry  whether the model's surfaces are those of a geometry, which shapes then select as a whole
/// @throws InputError when a group is empty, holds loose surface cells, or no surface lies on a shape
void add_surface_groups(const MeshRequest& request, const ExtractedModel& model, bool geometry, const FaceTable& faces,
                        Mesh& mesh);

}  // namespace bielle::reduce

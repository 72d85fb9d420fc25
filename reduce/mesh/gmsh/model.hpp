// Reads what gmsh has open: its groups, its cells, and the model that it has meshed.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "reduce/mesh/extracted_model.hpp"
#include "reduce/mesh/gmsh/session.hpp"
#include "reduce/mesh/source_file.hpp"

namespace bielle::reduce {

/// Opens a geometry or mesh that gmsh reads. STEP and IGES are read in metres, whatever their unit.
/// @throws InputError "<name>: ..." if gmsh cannot read it, or if it is empty
void open_model(GmshSession& session, const SourceFile& source);

// The following functions call gmsh without translating its exceptions and may be used within session.read() only.

bool model_has_cells(int dimension);  ///< whether there are meshed cells: 2 surface, 3 solid
bool model_has_volumes();

/// Name and number of the cells of each type, solids first.
std::vector<std::pair<std::string, std::size_t>> cell_counts();

/// Physical groups of surfaces and volumes. A surface group with the name of a volume group gets `_surface` appended.
std::vector<PhysicalGroup> physical_groups();

// The following functions translate exceptions.

/// Largest side of the model's box, in its own unit.
double model_extent(GmshSession& session);

/// @param metres  metres per unit of the model
/// @throws InputError for cells of types that are not in the table, for a model without solid cells
ExtractedModel extract_model(GmshSession& session, const std::string& name, double metres);

/// Surface cells of the surfaces of a model meshed in dimension 2, and all their nodes.
std::map<int, std::vector<Corners>> extract_surfaces(GmshSession& session, const std::string& name, double metres,
                                                     Eigen::Matrix3Xd& points);

}  // namespace bielle::reduce

// Universal files (.unv), adapted to gmsh 4.8, which takes the coordinates of nodes as Cartesian ones in metres and
// ignores the newest dataset of groups. Datasets stand between lines of -1 and begin with their number (SDRC I-DEAS,
// Universal Dataset Number 164, 2411, 2412, 2420, 2467).
#pragma once

#include <optional>
#include <string>

namespace bielle::reduce {

/// Metres per unit of length by dataset 164; empty if there is none. @throws InputError naming the line
std::optional<double> universal_length_unit(const std::string& path);

/// Checks the elements of dataset 2412. @returns a sentence about those that are left out, such as springs and masses,
/// with numbers and the first line of each type, or nothing
/// @throws InputError naming the first line and the number of solid cells that gmsh would drop, or an element whose
/// number of nodes is wrong
std::string check_universal_elements(const std::string& path);

/// Writes a copy that gmsh reads correctly. All nodes stand in the global Cartesian system. Elements that are left out
/// are missing, since gmsh fails on some of them. Groups are in a dataset that gmsh reads, under numbers that no
/// physical property of elements has: gmsh would add the elements of the property to the group.
/// @returns false if no change was necessary; the copy is then to be ignored
/// @throws InputError naming the line, ComputationError if the copy cannot be written
bool adapt_universal_file(const std::string& source, const std::string& target);

}  // namespace bielle::reduce

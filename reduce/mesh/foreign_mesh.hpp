// Meshes that gmsh cannot read, or whose groups it loses: tools/convert_mesh.py converts them to MSH files.
#pragma once

#include <string>
#include <vector>

#include "reduce/common/files/scratch_folder.hpp"

namespace bielle {
class Progress;
}

namespace bielle::reduce {

/// Runs a Python tool of Bielle that converts a file. It is sought in the folder that the environment variable
/// BIELLE_TOOLS names, then where Bielle is installed, then in its sources.
/// @param target  file that the tool writes; its messages are kept next to it
/// @param source  file that it reads, for messages
/// @returns its notes @throws InputError with the tool's own sentence; ComputationError when there is no such tool
std::vector<std::string> run_tool(const std::string& tool, const std::vector<std::string>& arguments,
                                  const std::string& target, const std::string& source);

/// Tells by the ending of its name whether gmsh reads this kind of file without loss.
bool gmsh_reads(const std::string& path);

/// Converts a foreign mesh to `target` by tools/convert_mesh.py, whose notes are shown. @throws as run_tool
void convert_mesh(const std::string& source, const std::string& target, Progress& progress);

/// Materials of a foreign file in its own units: JSON with `materials` in the keys of a body file, and `regions`.
/// @param notes  gets the converter's notes @throws as run_tool
std::string materials_of_mesh(const std::string& source, std::vector<std::string>& notes);

/// Ties and point masses of a foreign file in its own units: JSON with `ties` and `masses`, which are empty if the file
/// is no deck. Nodes have their numbers in the converted mesh.
/// @param notes  gets the converter's notes @throws as run_tool
std::string ties_of_mesh(const std::string& source, std::vector<std::string>& notes);

}  // namespace bielle::reduce

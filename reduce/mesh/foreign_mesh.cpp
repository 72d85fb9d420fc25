#include "reduce/mesh/foreign_mesh.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/common/process/other_program.hpp"
#include "reduce/common/progress.hpp"

namespace bielle::reduce {

namespace {

constexpr const char* python = "/usr/bin/python3";  // the Python for which the distribution packages meshio
constexpr const char* converter = "convert_mesh.py";

std::filesystem::path find_tool(const std::string& tool) {
  if (const char* folder = std::getenv("BIELLE_TOOLS"); folder != nullptr && *folder != '\0') {
    const auto path = std::filesystem::path(folder) / tool;
    if (std::filesystem::exists(path)) return path;
    throw ComputationError(fmt::format("BIELLE_TOOLS is '{}', but there is no {} in it", folder, tool));
  }
  std::error_code ignored;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", ignored);
  const std::array<std::filesystem::path, 2> folders = {program.parent_path().parent_path() / "share/bielle/tools",
                                                        BIELLE_TOOLS_FOLDER};
  for (const auto& folder : folders)
    if (std::filesystem::exists(folder / tool)) return folder / tool;
  throw ComputationError(fmt::format("{} is missing from '{}' and '{}'; set BIELLE_TOOLS to the folder where it is",
                                     tool, folders[0].string(), folders[1].string()));
}

// Removes the label of the program that printed the sentence: "convert_mesh.py: ..." or "note: ...".
std::string without_label(const std::string& line, const std::string& tool) {
  for (const std::string& label : {tool + ": ", std::string("note: ")})
    if (line.starts_with(label)) return line.substr(label.size());
  return line;
}

// Runs the converter of meshes; the last argument is the file that it writes. Returns its notes.
std::vector<std::string> converted(const std::vector<std::string>& arguments, const std::string& source) {
  return run_tool(converter, arguments, arguments.back(), source);
}

// The JSON that the converter writes with an option. @param notes  gets its notes
std::string json_of(const std::string& option, const std::string& source, std::vector<std::string>& notes) {
  const ScratchFolder folder;
  const std::string target = (folder.path() / "deck.json").string();
  for (const std::string& note : converted({option, source, target}, source)) notes.push_back(note);
  std::ifstream file(target);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

std::vector<std::string> run_tool(const std::string& tool, const std::vector<std::string>& arguments,
                                  const std::string& target, const std::string& source) {
  std::vector<std::string> command = {python, find_tool(tool).string()};
  command.insert(command.end(), arguments.begin(), arguments.end());
  const std::string said_file = target + ".stderr";
  const int status = run_other_program(command, said_file);
  const std::vector<std::string> said = lines_of_file(said_file);
  if (status == 1 && !said.empty()) throw InputError(without_label(said.back(), tool));
  if (status != 0)
    throw ComputationError(fmt::format("the conversion of '{}' failed with status {}{}", source, status,
                                       said.empty() ? "" : ": " + said.back()));
  std::vector<std::string> notes;
  for (const std::string& line : said) notes.push_back(without_label(line, tool));
  return notes;
}

bool gmsh_reads(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  constexpr std::array<const char*, 9> known = {".geo",  ".geo_unrolled", ".step", ".stp", ".brep",
                                                ".iges", ".igs",          ".msh",  ".unv"};
  return std::find(known.begin(), known.end(), ending) != known.end();
}

void convert_mesh(const std::string& source, const std::string& target, Progress& progress) {
  for (const std::string& note : converted({source, target}, source)) progress.note(note);
}

std::string materials_of_mesh(const std::string& source, std::vector<std::string>& notes) {
  return json_of("--materials", source, notes);
}

std::string ties_of_mesh(const std::string& source, std::vector<std::string>& notes) {
  return json_of("--ties", source, notes);
}

}  // namespace bielle::reduce

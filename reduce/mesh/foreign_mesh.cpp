#include "reduce/mesh/foreign_mesh.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include "reduce/common/error.hpp"
#include "reduce/common/progress.hpp"

extern char** environ;

namespace bielle::reduce {

namespace {

constexpr const char* python = "/usr/bin/python3";  // the one whose meshio is packaged
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

// Runs a program without a shell; its standard output is discarded, its standard error written to a file. Returns its
// exit status.
int run(const std::vector<std::string>& command, const std::string& error_file) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 2, error_file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  pid_t process = 0;
  const int failed = posix_spawn(&process, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) throw ComputationError(fmt::format("'{}' cannot be started: {}", command[0], std::strerror(failed)));
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::vector<std::string> lines_of(const std::string& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);)
    if (!line.empty()) lines.push_back(line);
  return lines;
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

ScratchFolder::ScratchFolder() {
  std::error_code failed;
  const auto base = std::filesystem::temp_directory_path(failed);
  std::string name = ((failed ? std::filesystem::path("/tmp") : base) / "bielle-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr)
    throw ComputationError(fmt::format("no temporary folder '{}' can be made: {}", name, std::strerror(errno)));
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::vector<std::string> run_tool(const std::string& tool, const std::vector<std::string>& arguments,
                                  const std::string& target, const std::string& source) {
  std::vector<std::string> command = {python, find_tool(tool).string()};
  command.insert(command.end(), arguments.begin(), arguments.end());
  const std::string said_file = target + ".stderr";
  const int status = run(command, said_file);
  const std::vector<std::string> said = lines_of(said_file);
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

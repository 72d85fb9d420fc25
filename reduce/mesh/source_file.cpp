#include "reduce/mesh/source_file.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <unistd.h>

#include "reduce/common/error.hpp"
#include "reduce/common/process/closed_process.hpp"
#include "reduce/common/progress.hpp"
#include "reduce/mesh/length_unit.hpp"
#include "reduce/mesh/signature.hpp"
#include "reduce/mesh/universal_file.hpp"

namespace bielle::reduce {

namespace {

namespace fs = std::filesystem;

void check_file(const std::string& path) {
  std::error_code failed;
  if (!fs::exists(path, failed)) {
    std::vector<std::string> neighbours;
    const fs::path folder = fs::path(path).parent_path();
    for (const auto& entry : fs::directory_iterator(folder.empty() ? fs::path(".") : folder, failed))
      neighbours.push_back(entry.path().filename().string());
    const std::string nearest = nearest_name(fs::path(path).filename().string(), neighbours);
    throw InputError(fmt::format("'{}' does not exist{}", path,
                                 nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest)));
  }
  if (!fs::is_regular_file(path, failed)) throw InputError(fmt::format("'{}' is not a file", path));
  if (fs::file_size(path, failed) == 0) throw InputError(fmt::format("'{}' is empty", path));
  if (access(path.c_str(), R_OK) != 0)
    throw InputError(fmt::format("'{}' cannot be read: {}", path, std::strerror(errno)));
}

std::string ending_of(const std::string& path) {
  std::string ending = fs::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

// A universal file may declare its unit, but Salome writes metres whatever the unit of the mesh, so that the user's
// unit has priority.
void settle_universal_unit(const MeshRequest& request, double said, SourceFile& source, Progress& progress) {
  const std::optional<double> told = universal_length_unit(request.path);
  source.metres = request.length_unit ? said : told.value_or(1);
  if (!told) {
    source.unit_note = request.length_unit ? fmt::format("read in {} as length_unit says", *request.length_unit)
                                           : "it carries no unit: read in m (length_unit changes that)";
  } else if (!request.length_unit) {
    source.unit_note = fmt::format("its dataset 164 says that its unit is {}", unit_name(*told));
  } else {
    source.unit_note = fmt::format("read in {} as length_unit says", *request.length_unit);
    if (std::abs(*told - said) > 1e-6 * said)
      progress.warn(request.length_unit_subject,
                    fmt::format("'{}' contradicts the dataset 164 of '{}', by which its unit is {}; read in {}",
                                *request.length_unit, request.path, unit_name(*told), *request.length_unit));
  }
}

// Sets metres per unit for a geometry that declares none; warns if the user's unit differs from a declared one.
void settle_unit(const MeshRequest& request, const std::string& ending, SourceFile& source, Progress& progress) {
  const double said =
      request.length_unit ? about(request.length_unit_subject, [&] { return metres_per(*request.length_unit); }) : 1.0;
  if (ending == ".unv") return settle_universal_unit(request, said, source, progress);
  if (!source.carries_unit) {
    source.metres = said;
    source.unit_note = request.length_unit ? fmt::format("read in {} as length_unit says", *request.length_unit)
                                           : "it carries no unit: read in m (length_unit changes that)";
    return;
  }
  const std::optional<double> carried = ending.starts_with(".st") ? step_length_unit(request.path) : std::nullopt;
  source.unit_note = carried ? fmt::format("it says that its unit is {}", unit_name(*carried)) : "it carries its unit";
  if (!request.length_unit || (carried && std::abs(*carried - said) <= 1e-6 * said)) return;
  progress.warn(request.length_unit_subject,
                fmt::format("'{}' is not used: '{}' carries its own unit{}", *request.length_unit, request.path,
                            carried ? ", which is " + unit_name(*carried) : ""));
}

}  // namespace

SourceFile prepare_source(const MeshRequest& request, Progress& progress) {
  about(request.subject, [&] {
    check_file(request.path);
    check_signature(request.path);
  });
  const std::string ending = ending_of(request.path);
  SourceFile source;
  source.name = source.path = request.path;
  source.geometry = gmsh_reads(request.path) && ending != ".msh" && ending != ".unv";
  source.is_iges = ending == ".iges" || ending == ".igs";
  source.carries_unit = ending == ".step" || ending == ".stp" || source.is_iges;
  settle_unit(request, ending, source, progress);
  if (!gmsh_reads(request.path)) {
    source.folder = std::make_unique<ScratchFolder>();
    source.path = (source.folder->path() / "mesh.msh").string();
    about(request.subject, [&] { convert_mesh(request.path, source.path, progress); });
  }
  if (ending == ".unv") {
    source.folder = std::make_unique<ScratchFolder>();
    const std::string copy = (source.folder->path() / "mesh.unv").string();
    about(request.subject, [&] {
      if (const std::string told = check_universal_elements(request.path); !told.empty())
        progress.note(fmt::format("{}: {}", request.path, told));
      if (adapt_universal_file(request.path, copy)) source.path = copy;
    });
  }
  return source;
}

ChildLoss loss_of(const SourceFile& source, const std::string& subject) {
  const char* reading = "cannot be read: gmsh crashes on it, the file is damaged";
  const char* meshing =
      "cannot be read and meshed: gmsh crashes on it; where the file is sound, another mesh.size may help";
  ChildLoss loss(fmt::format("'{}' {}", source.name, source.geometry ? meshing : reading));
  loss.ended = fmt::format("'{}' ends gmsh before it is read to its end: remove 'Exit;' or 'Abort;'", source.name);
  loss.forbidden = fmt::format(
      "'{}' starts another program (SystemCall), which a geometry may not; --allow-system-calls lets it, for files "
      "that you trust",
      source.name);
  loss.subject = subject;
  return loss;
}

void forbid_system_calls(const SourceFile& source) {
  if (forbid_other_programs() || !ending_of(source.name).starts_with(".geo")) return;
  // This system cannot prevent gmsh from running commands: a script that could is recognised by its words.
  std::ifstream file(source.path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  for (const char* word : {"SystemCall", "OnelabRun", "Include", "Merge"})
    if (text.find(word) != std::string::npos)
      throw InputError(
          fmt::format("'{}' is a script with '{}' that could start other programs, which this system cannot prevent; "
                      "--allow-system-calls reads it all the same",
                      source.name, word));
}

}  // namespace bielle::reduce

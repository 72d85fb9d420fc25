#include "reduce/mesh/source_file.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/common/progress.hpp"
#include "reduce/mesh/length_unit.hpp"
#include "reduce/mesh/mesh_request.hpp"

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
}

std::string ending_of(const std::string& path) {
  std::string ending = fs::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

bool carries_unit(const std::string& ending) {
  return ending == ".step" || ending == ".stp" || ending == ".iges" || ending == ".igs";
}

}  // namespace

SourceFile prepare_source(const std::string& path, const std::optional<std::string>& length_unit,
                          const std::string& length_unit_located, Progress& progress) {
  check_file(path);
  SourceFile source;
  source.name = source.path = path;
  double said = 1;
  try {
    if (length_unit) said = metres_per(*length_unit);
  } catch (const InputError& error) {
    throw InputError(at_place(length_unit_located, error.what()));
  }

  const std::string ending = ending_of(path);
  source.geometry = gmsh_reads(path) && ending != ".msh" && ending != ".unv";
  if (carries_unit(ending)) {
    const std::optional<double> carried = ending.starts_with(".st") ? step_length_unit(path) : std::nullopt;
    source.unit_note =
        carried ? fmt::format("it says that its unit is {}", unit_name(*carried)) : "it carries its unit";
    if (length_unit && carried && std::abs(*carried - said) > 1e-6 * said)
      progress.warn(
          at_place(length_unit_located, fmt::format("'{}' is not the unit of '{}', which carries its own, {}: that one "
                                                    "holds",
                                                    *length_unit, path, unit_name(*carried))));
  } else {
    source.metres = said;
    source.unit_note = length_unit ? fmt::format("read in {} as length_unit says", *length_unit)
                                   : "it carries no unit: read in m (length_unit changes that)";
  }
  if (!gmsh_reads(path)) {
    source.folder = std::make_unique<TemporaryFolder>();
    source.path = (source.folder->path() / "mesh.msh").string();
    convert_mesh(path, source.path, progress);
  }
  return source;
}

}  // namespace bielle::reduce

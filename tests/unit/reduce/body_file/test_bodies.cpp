// The bodies that come with the program: every body file is read, and its geometry contains the groups that the file
// names.
#include <filesystem>
#include <map>
#include <set>

#include <catch2/catch.hpp>

#include "reduce/body_file/body_file.hpp"
#include "reduce/common/progress.hpp"
#include "reduce/mesh/gmsh/volumes.hpp"
#include "reduce/mesh/import.hpp"
#include "reduce/mesh/measures.hpp"
#include "reduce/report/summary.hpp"

using namespace bielle;
using namespace bielle::reduce;

TEST_CASE("every body of meshes/ is read and meshed with its groups") {
  std::set<std::string> names;
  std::map<std::string, double> parts,
      wholes;  // volumes of the solids that bodies select, and of their whole geometry
  for (const auto& entry : std::filesystem::directory_iterator(std::string(BIELLE_SOURCE_DIR) + "/meshes")) {
    if (entry.path().extension() != ".yaml") continue;
    CAPTURE(entry.path().string());
    const BodyFile body = read_body_file(entry.path().string());
    Progress progress(true);
    const Mesh mesh = import_mesh(body.mesh, progress);
    names.insert(entry.path().stem().string());
    const bool deck = std::filesystem::path(body.mesh.path).extension() == ".inp";  // couplings of a deck name nodes
    for (const InterfaceRequest& interface : body.options.interfaces)
      CHECK(mesh.groups.at(interface.group).dimension == (deck ? 0 : 2));
    for (const LoadRequest& load : body.options.loads) CHECK(mesh.groups.at(load.group).dimension == 2);
    for (const auto& [region, material] : body.options.regions) CHECK(mesh.groups.at(region).dimension == 3);
    if (deck) continue;
    const double whole = geometry_volume(body.mesh.path, body.mesh.length_unit);
    if (body.mesh.solids.empty()) {
      // Some fillets are straightened; all other surfaces are exact to the order of the elements.
      CHECK(mesh_volume(mesh) == Approx(whole).epsilon(1e-3));
    } else {
      parts[body.mesh.path] += mesh_volume(mesh);
      wholes[body.mesh.path] = whole;
    }
  }
  CHECK(parts.size() == 1);
  for (const auto& [path, volume] : parts) CHECK(volume == Approx(wholes.at(path)).epsilon(1e-3));
  CHECK(names == std::set<std::string>{"arc", "bar", "bar_in_pieces", "boom", "conrod", "conrod_step", "coupler",
                                       "plate", "robot_forearm", "robot_upper_arm"});
}

TEST_CASE(
    "The summary names the method for modes, and the other one if it would save more than a quarter of the time") {
  ReductionReport report;
  report.method = "ARPACK";
  report.solves = report.sweeps = 445;
  const auto said = [&](double modes) {
    return describe(report, {{"factorisation", 10, 1}, {"fixed-boundary modes", modes, 1}});
  };
  CHECK_THAT(said(24), Catch::Contains("modes by ARPACK: 445 solutions in 445 sweeps\n"));
  CHECK_THAT(said(26), Catch::Contains("445 sweeps; 'method: block_lanczos' would probably take a third less\n"));
  report.method = "block Lanczos";
  CHECK_THAT(said(1000), Catch::Contains("modes by block Lanczos: 445 solutions in 445 sweeps\n"));
}

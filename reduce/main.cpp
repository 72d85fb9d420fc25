// bielle-reduce: a body file in, a superelement out.
#include <filesystem>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "reduce/body_file.hpp"
#include "reduce/common/command_line.hpp"
#include "reduce/common/error.hpp"
#include "reduce/common/progress.hpp"
#include "reduce/mesh/describe.hpp"
#include "reduce/mesh/import.hpp"
#include "reduce/reduction/reduce_body.hpp"
#include "reduce/spectral/blas.hpp"
#include "reduce/summary.hpp"

namespace {

using namespace bielle;
using namespace bielle::reduce;

/// Prints a superelement file with its checks made anew. @returns the exit status: 2 when a check fails
int inspect(const std::string& path) {
  const Superelement body = read_superelement(path);
  const std::vector<Check> checks = check_superelement(body);
  fmt::print("{}: written by {}\n{}", path, body.created_by, format_superelement(body, checks));
  for (const Check& check : checks)
    if (!check.passed()) throw ComputationError(fmt::format("{}: the check {} fails", path, check.name));
  return 0;
}

int reduce(const std::string& body_path, std::string output_path, const CommonOptions& common) {
  const BodyFile file = read_body_file(body_path);
  if (output_path.empty()) output_path = std::filesystem::path(body_path).replace_extension(".h5").string();
  Progress progress(common.quiet);
  if (const std::string warning = blas_warning(); !warning.empty()) progress.note(warning);
  const Mesh mesh = import_mesh(file.mesh, progress);
  ReductionReport report;
  const Superelement body = reduce_body(mesh, file.options, progress, common.threads, &report);
  progress.start("writing");
  write_superelement(body, output_path);
  progress.finish();
  if (!common.quiet)
    fmt::print("{}{}superelement: {}\n", format_superelement(body, report.checks),
               format_cost(report, progress.phases()), output_path);
  return 0;
}

int body(int argc, char** argv) {
  CLI::App app{"Reduces an elastic body to a superelement: mesh, constraint modes, vibration modes.", "bielle-reduce"};
  std::string body_path, output_path, geometry, superelement, length_unit;
  CommonOptions common;
  app.add_option("BODY", body_path, "body file (YAML)");
  app.add_option("-o,--output", output_path, "superelement file (default: BODY with the ending .h5)");
  app.add_option("--list", geometry, "GEOMETRY: list the surfaces, volumes, groups and units that it offers");
  app.add_option("--length-unit", length_unit, "unit of the lengths in a geometry without one (for --list)");
  app.add_option("--inspect", superelement, "BODY.h5: say what is in a superelement and run its checks again");
  add_common_options(app, common);
  if (!parse_command_line(app, argc, argv)) return 0;

  if (!geometry.empty()) {
    Progress progress(true);
    fmt::print("{}",
               describe_geometry(geometry, length_unit.empty() ? std::nullopt : std::optional(length_unit), progress));
    return 0;
  }
  if (!superelement.empty()) return inspect(superelement);
  if (body_path.empty()) throw InputError("give a body file, or --list GEOMETRY, or --inspect BODY.h5");
  return reduce(body_path, output_path, common);
}

}  // namespace

int main(int argc, char** argv) { return bielle::run_program("bielle-reduce", body, argc, argv); }

// bielle-reduce: reads a body file and writes a superelement.
#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fcntl.h>
#include <fmt/format.h>
#include <malloc.h>
#include <sys/prctl.h>

#include "reduce/body_file/body_file.hpp"
#include "reduce/body_file/deck_ties.hpp"
#include "reduce/common/command_line.hpp"
#include "reduce/common/error.hpp"
#include "reduce/common/input/key_schema.hpp"
#include "reduce/common/input/key_words.hpp"
#include "reduce/common/process/library_settings.hpp"
#include "reduce/common/process/run_program.hpp"
#include "reduce/common/progress.hpp"
#include "reduce/dense/blas.hpp"
#include "reduce/distributed/distributed_matrices.hpp"
#include "reduce/distributed/greeting.hpp"
#include "reduce/matrices_command.hpp"
#include "reduce/mesh/checks.hpp"
#include "reduce/mesh/describe.hpp"
#include "reduce/mesh/geometry_surface.hpp"
#include "reduce/mesh/import.hpp"
#include "reduce/output_file.hpp"
#include "reduce/reduction/integration_checks.hpp"
#include "reduce/reduction/reduce_pieces.hpp"
#include "reduce/report/summary.hpp"
#include "reduce/report/summary_of_pieces.hpp"
#include "reduce/report/verdict.hpp"
#include "reduce/verify_command.hpp"

namespace {

using namespace bielle;
using namespace bielle::reduce;

/// The location of the mesh's matrices: in this process, or on the ranks of bielle-reduce-mpi, which started it.
class Workplace {
 public:
  /// @param ranks_at  file descriptor of the open socket to the ranks; negative if there are none
  explicit Workplace(int ranks_at) {
    if (ranks_at < 0) return;
    prctl(PR_SET_PDEATHSIG, SIGKILL);      // ends this process with the ranks
    fcntl(ranks_at, F_SETFD, FD_CLOEXEC);  // no child process keeps the socket to the ranks open
    mallopt(M_MMAP_THRESHOLD, 1 << 20);    // large blocks are returned to the system when they are freed
    ranks_ = std::make_unique<Channel>(ranks_at, "the ranks");
    greeting_ = ranks_->receive_number<Greeting>();
  }
  /// Processors are shared with the other ranks of this machine.
  int threads(int available) const { return std::max(1, available / static_cast<int>(greeting_.ranks_here)); }
  MatrixMaker matrices() const {
    if (!ranks_) return assembled_matrices;
    return [this](const Solid& solid, const InteriorUnknowns&, int threads) {
      return distributed_matrices(*ranks_, static_cast<int>(greeting_.ranks), solid, threads);
    };
  }

 private:
  std::unique_ptr<Channel> ranks_;
  Greeting greeting_;
};

void reduce_whole(const Mesh& mesh, const BodyFile& file, const std::string& output, Progress& progress,
                  const CommonOptions& common, const MatrixMaker& matrices) {
  ReductionReport report;
  const Superelement body = reduce_body(mesh, file.options, progress, common.threads, &report, matrices);
  progress.start("writing");
  write_superelement(body, output);
  progress.finish();
  if (!common.quiet) {
    fmt::print("{}\n{}{}{}{}{}", summary(mesh), describe(body), describe(report.checks),
               describe(report, progress.phases()), verdict(body), written(output));
  }
}

void reduce_in_pieces(const Mesh& mesh, const BodyFile& file, const std::string& output, Progress& progress,
                      const CommonOptions& common, const MatrixMaker& matrices) {
  std::vector<Check> checks;
  const CutBody body =
      reduce_pieces(mesh, file.mesh.cuts, file.options, *file.pieces, progress, common.threads, &checks, matrices);
  progress.start("writing");
  write_cut_body(body, output);
  progress.finish();
  if (!common.quiet) {
    fmt::print("{}\n{}{}{}{}{}", summary(mesh), describe(body), describe(checks), describe({}, progress.phases()),
               verdict(body), written(output));
  }
}

/// Executes the requests of a body file.
void reduce(const BodyFile& file, const std::string& output, const CommonOptions& common, const MatrixMaker& matrices) {
  start_blas(common.threads);
  Progress progress(common.quiet, [&](const std::string& subject, const std::string& message) {
    return file.lines.located(subject, message);
  });
  if (const std::string warning = blas_warning(); !warning.empty()) {
    progress.warn(warning);
  }
  for (const std::string& warning : file.warnings) {
    progress.warn(warning);
  }
  if (file.matrices) {
    reduce_matrices_of(*file.matrices, output, common, progress);
    return;
  }
  const Mesh mesh = import_mesh(file.mesh, progress);
  check_integration(mesh, file.options.integration);
  file.pieces ? reduce_in_pieces(mesh, file, output, progress, common, matrices)
              : reduce_whole(mesh, file, output, progress, common, matrices);
}

/// Reads a body file and executes its requests, whose errors get the line of their key.
void reduce(const std::string& input, std::string output, bool system_calls, const CommonOptions& common,
            const MatrixMaker& matrices) {
  BodyFile file = read_body_file(input);
  file.mesh.system_calls = system_calls;
  if (output.empty()) {
    output = std::filesystem::path(input).replace_extension(".h5").string();
  }
  check_output(output, {input, file.matrices ? file.matrices->files.path : file.mesh.path});
  try {
    reduce(file, output, common, matrices);
  } catch (const InputError& error) {
    throw InputError(file.lines.located(error.subject(), error.what()));
  } catch (const ComputationError& error) {
    throw ComputationError(file.lines.located(error.subject(), error.what()));
  }
}

/// @param title  text before the description
/// @throws ComputationError when a check fails
void inspect(const Superelement& body, const std::string& path, const std::string& title) {
  const std::vector<Check> checks = check_superelement(body);
  std::string stored;
  for (const auto& [name, value] : body.checks) {
    if (std::none_of(checks.begin(), checks.end(),
                     [&, &key = name](const Check& check) { return check.name == key; })) {
      stored += fmt::format("  {:28} {:8.1e}\n", name, value);
    }
  }
  fmt::print("{}{}{}", title, describe(body), describe(checks));
  if (!stored.empty()) {
    fmt::print("stored by the reduction, which alone had the mesh's matrices\n{}", stored);
  }
  for (const Check& check : checks) {
    if (!check.passed()) {
      throw ComputationError(fmt::format("{}: the check {} fails: '{}'", path, check.name, check.meaning));
    }
  }
}

void inspect(const std::string& path) {
  if (!holds_pieces(path)) {
    const Superelement body = read_superelement(path);
    inspect(body, path, fmt::format("{}: {}\n", path, body.created_by));
    fmt::print("{}", verdict(body));
    return;
  }
  const CutBody body = read_cut_body(path);
  fmt::print("{}: {}\n{}", path, body.created_by, describe(body));
  for (std::size_t k = 0; k < body.pieces.size(); ++k) {
    inspect(body.pieces[k], path + ": " + group_of_piece(k), fmt::format("\npiece {}\n", k + 1));
  }
  fmt::print("{}", verdict(body));
}

/// @param path  a geometry, a mesh, or a body file that names one and its unit
void list(const std::string& path, std::optional<std::string> length_unit, bool system_calls) {
  GeometryFile geometry{path, length_unit, {}};
  const std::string ending = std::filesystem::path(path).extension().string();
  if (ending == ".yaml" || ending == ".yml") {
    if (length_unit) {
      throw InputError("--length-unit goes with a geometry; a body file has its own length_unit");
    }
    geometry = read_geometry_of(path);
  }
  Progress progress(true);
  fmt::print("{}", describe_geometry(geometry.path, geometry.length_unit, progress, system_calls, geometry.densities));
  std::vector<std::string> notes;
  fmt::print("{}", describe(read_deck(geometry.path, geometry.length_unit, notes)));
}

/// Writes the surface of a geometry as an STL file, by which it is drawn.
void write_surface(const std::string& path, const std::string& output, const std::optional<std::string>& length_unit,
                   bool system_calls) {
  if (output.empty()) {
    throw InputError("--surface needs -o: the STL file to be written");
  }
  check_output(output, {path});
  Progress progress(true);
  const std::string bytes = surface_of_geometry(path, length_unit, progress, system_calls);
  std::ofstream file(output, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file.flush()) {
    throw ComputationError(fmt::format("{}: cannot be written; is the disk full?", output));
  }
}

int body(int argc, char** argv) {
  CLI::App app{"Reduces a solid body to the motions of its interfaces and its lowest modes.", "bielle-reduce"};
  std::string input, output, geometry, surface, superelement, keys_of, foreign, units;
  std::optional<std::string> length_unit;
  bool system_calls = false;
  int ranks_at = -1;
  CommonOptions common;
  const auto* input_option = app.add_option("BODY", input, "body file (YAML)");
  const auto* output_option =
      app.add_option("-o,--output", output, "superelement file (default: BODY with the ending .h5)");
  const auto* list_option =
      app.add_option("--list", geometry,
                     "show what a geometry or mesh (or that of a body file) offers: volumes, surfaces, groups, units");
  const auto* surface_option = app.add_option(
      "--surface", surface, "write the surface of a geometry to an STL file (-o), in metres, for drawings");
  const auto* unit =
      app.add_option("--length-unit", length_unit,
                     "with --list and --surface: unit of a geometry that carries none: m mm cm um km in ft");
  const auto* from_option =
      app.add_option("--from", foreign, "make a superelement of another program's matrices (DMIG, OUTPUT4, .mtx ...)");
  const auto* units_option = app.add_option(
      "--units", units, "with --from and --verify: units of a file that declares none, as mm-t-s (default: SI)");
  const auto* inspect_option =
      app.add_option("--inspect", superelement, "show what is in a superelement file, check it again");
  VerifyRequest verified;
  const auto* verify_option = app.add_option("--verify", verified.path,
                                             "prove a superelement or matrices: rigid motions, mass, positions, modes");
  const auto* against =
      app.add_option("--against", verified.against, "with --verify: compare with another file of the same body");
  const auto* keys_option =
      app.add_option("--keys", keys_of, "explain the keys of a part of the body file (`mesh`), or `all`");
  bool schema = false;
  app.add_flag("--schema", schema, "print the JSON schema of body files, for editors");
  app.add_flag("--allow-system-calls", system_calls,
               "let a .geo run shell commands (SystemCall): for files that you trust");
  app.add_option("--ranks-at", ranks_at)->group("");  // from bielle-reduce-mpi, not from users
  add_common_options(app, common);
  app.footer(
      "\nThe manual is in reduce/manual of the sources, or of share/doc/bielle if installed: it begins with "
      "body_file.md.\n"
      "--keys NAME and --explain MESSAGE show parts of it.");
  if (!parse_command_line(app, argc, argv)) {
    return 0;
  }
  if (keys_option->count() > 0 || schema) {
    fmt::print("{}", keys_option->count() > 0 ? keys_of_named(body_file_keys(), keys_of)
                                              : write_key_schema(body_file_keys(), "body file of bielle-reduce"));
    return 0;
  }
  if (input_option->count() + list_option->count() + inspect_option->count() + from_option->count() +
          verify_option->count() + surface_option->count() !=
      1) {
    throw InputError(
        "expected one of: a body file, --from MATRICES, --list GEOMETRY, --surface GEOMETRY, --inspect SUPERELEMENT, "
        "--verify FILE; see --help");
  }
  if (output_option->count() > 0 && input_option->count() + from_option->count() + surface_option->count() == 0) {
    throw InputError("-o goes with a body file, --from or --surface: --list, --inspect and --verify write nothing");
  }
  if (units_option->count() > 0 && from_option->count() + verify_option->count() == 0) {
    throw InputError("--units goes with --from and --verify; a body file has 'matrices: {file: .., units: ..}'");
  }
  if (against->count() > 0 && verify_option->count() == 0) {
    throw InputError("--against goes with --verify FILE");
  }
  if (unit->count() > 0 && list_option->count() + surface_option->count() == 0) {
    throw InputError("--length-unit goes with --list and --surface; a body file has its own length_unit");
  }
  if (system_calls && inspect_option->count() + verify_option->count() > 0) {
    throw InputError(fmt::format("--allow-system-calls goes with a body file or --list: {} reads no geometry",
                                 inspect_option->count() > 0 ? "--inspect" : "--verify"));
  }
  if (surface_option->count() > 0) {
    write_surface(surface, output, length_unit, system_calls);
    return 0;
  }
  if (list_option->count() > 0) {
    list(geometry, length_unit, system_calls);
    return 0;
  }
  if (inspect_option->count() > 0) {
    inspect(superelement);
    return 0;
  }
  if (from_option->count() > 0) {
    reduce_from(foreign, output, units, common);
    return 0;
  }
  if (verify_option->count() > 0) {
    verified.units = units;
    return verify_file(verified, common) ? 0 : 1;
  }
  const Workplace workplace(ranks_at);
  if (app.count("--threads") == 0) common.threads = workplace.threads(common.threads);
  reduce(input, output, system_calls, common, workplace.matrices());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  bielle::apply_library_settings(argv);
  return bielle::run_program("bielle-reduce", body, argc, argv);
}

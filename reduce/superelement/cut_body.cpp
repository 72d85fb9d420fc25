#include "reduce/superelement/cut_body.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/common/files/atomic_output.hpp"
#include "reduce/common/files/byte_sum.hpp"
#include "reduce/common/files/hdf5_file.hpp"
#include "reduce/superelement/modal_damping.hpp"
#include "reduce/superelement/superelement_file.hpp"

namespace bielle {

namespace {

constexpr const char* cut_body_format = "bielle cut body";

void write_cuts(Hdf5File& file, const std::vector<CutSurface>& cuts) {
  std::vector<std::string> names;
  std::vector<std::int64_t> pieces;
  std::vector<double> positions, areas, distances;
  for (const CutSurface& cut : cuts) {
    names.push_back(cut.name);
    for (const int piece : cut.pieces) pieces.push_back(piece + 1);
    positions.insert(positions.end(), cut.position.begin(), cut.position.end());
    areas.push_back(cut.area);
    distances.push_back(cut.distance);
  }
  file.write_names("/cuts/names", names);
  file.write("/cuts/pieces", pieces, {cuts.size(), 2}, "-", "that meet there, counted from 1");
  file.write("/cuts/positions", positions, {cuts.size(), 3}, "m", "centroids, in body axes");
  file.write("/cuts/areas", areas, {cuts.size()}, "m^2");
  file.write("/cuts/distances", distances, {cuts.size()}, "m", "farthest point from the plane that was asked for");
}

std::vector<CutSurface> read_cuts(const Hdf5File& file, std::size_t pieces) {
  std::vector<CutSurface> cuts;
  const std::vector<std::string> names = file.read_names("/cuts/names");
  const std::vector<std::int64_t> numbers = file.read_integers("/cuts/pieces");
  const std::vector<double> positions = file.read("/cuts/positions"), areas = file.read("/cuts/areas"),
                            distances = file.read("/cuts/distances");
  if (numbers.size() != 2 * names.size() || positions.size() != 3 * names.size() || areas.size() != names.size() ||
      distances.size() != names.size())
    throw InputError(fmt::format("{}: /cuts: expected as many rows everywhere as /cuts/names has", file.path()));
  for (std::size_t k = 0; k < names.size(); ++k) {
    CutSurface cut;
    cut.name = names[k];
    for (std::size_t side = 0; side < 2; ++side) {
      const std::int64_t number = numbers[2 * k + side];
      if (number < 1 || number > static_cast<std::int64_t>(pieces))
        throw InputError(fmt::format("{}: /cuts/pieces: there is no piece {}", file.path(), number));
      cut.pieces[side] = static_cast<int>(number - 1);
    }
    cut.position = Eigen::Vector3d(&positions[3 * k]);
    cut.area = areas[k];
    cut.distance = distances[k];
    cuts.push_back(cut);
  }
  return cuts;
}

/// Checks that shared interfaces coincide: otherwise their common node would strain the pieces.
void check_shared(const std::vector<Superelement>& pieces, const std::string& path) {
  std::map<std::string, const Interface*> known;
  for (const Superelement& piece : pieces)
    for (const Interface& interface : piece.interfaces) {
      const auto [place, is_new] = known.emplace(interface.name, &interface);
      const Interface& first = *place->second;
      if (!is_new && (first.position != interface.position || first.rotation != interface.rotation ||
                      first.kept != interface.kept))
        throw InputError(
            fmt::format("{}: the interface '{}' of '{}' differs from that of the piece before it; run "
                        "bielle-reduce again",
                        path, interface.name, piece.name));
    }
}

void check_head(const Hdf5File& file) {
  const std::int64_t version = file.read_integer_attribute("/", "version");
  if (version != cut_body_version)
    throw InputError(
        fmt::format("{}: has version {} of the layout of cut bodies, but this program reads version {}; "
                    "run bielle-reduce again",
                    file.path(), version, cut_body_version));
  if (file.read_integer_attribute("/", "complete") != 1)
    throw InputError(fmt::format("{}: was never completed; run bielle-reduce again", file.path()));
}

bool has_format(const Hdf5File& file) {
  return file.has_attribute("/", "format") && file.read_text_attribute("/", "format") == cut_body_format;
}

}  // namespace

std::vector<std::string> shared_interfaces(const std::vector<Superelement>& pieces) {
  std::map<std::string, int> count;
  std::vector<std::string> shared;
  for (const Superelement& piece : pieces)
    for (const Interface& interface : piece.interfaces)
      if (++count[interface.name] == 2) shared.push_back(interface.name);
  return shared;
}

std::string group_of_piece(std::size_t piece) { return fmt::format("/pieces/{}", piece + 1); }

void write_cut_body(const CutBody& body, const std::string& path) {
  for (const Superelement& piece : body.pieces) check_writable(piece, path);
  AtomicOutput output(path);
  Hdf5File file = Hdf5File::create(output.temporary_path());
  file.write_attribute("/", "format", std::string(cut_body_format));
  file.write_attribute("/", "version", std::int64_t{cut_body_version});
  file.write_attribute("/", "name", body.name);
  file.write_attribute("/", "created_by", body.created_by);
  file.write_attribute("/", "complete", std::int64_t{0});
  file.write_text("/input", body.input);
  for (std::size_t k = 0; k < body.pieces.size(); ++k) {
    file.make_group(group_of_piece(k));
    file.enter(group_of_piece(k));
    write_superelement(body.pieces[k], file);
    file.enter("/");
  }
  write_cuts(file, body.cuts);
  file.write("/assembled/free_frequencies", body.free_frequencies, "Hz", "of all pieces together, free");
  if (body.effect.uncut_frequencies.size() > 0)
    file.write("/uncut/free_frequencies", body.effect.uncut_frequencies, "Hz", "of the body in one piece, free");
  if (!body.effect.stiffness_ratios.empty())
    file.write("/assembled/stiffness_ratios", body.effect.stiffness_ratios, {body.effect.stiffness_ratios.size()}, "-",
               "least and largest stiffness between the interfaces over that of the uncut body");
  file.write_attribute("/", "complete", std::int64_t{1});
  file.close();
  append_byte_sum(output.temporary_path());
  output.commit();
}

bool holds_pieces(const std::string& path) {
  try {
    return has_format(Hdf5File::open(path));
  } catch (const InputError&) {
    return false;  // the reader of the file reports the fault
  }
}

std::optional<Superelement> read_whole_for_motion(const std::string& path) {
  const Hdf5File file = Hdf5File::open(path);
  if (has_format(file)) return {};
  return read_parts_of_motion(file);
}

CutBody read_cut_body(const std::string& path) {
  Hdf5File file = Hdf5File::open(path);
  if (!has_format(file)) throw InputError(fmt::format("{}: is no cut body of bielle-reduce", path));
  check_head(file);
  CutBody body;
  body.name = file.read_text_attribute("/", "name");
  body.created_by = file.read_text_attribute("/", "created_by");
  body.input = file.read_text("/input");
  const std::size_t count = file.names_in("/pieces").size();
  for (std::size_t k = 0; k < count; ++k) {
    file.enter(group_of_piece(k));
    body.pieces.push_back(read_superelement(file));
    file.enter("/");
  }
  check_shared(body.pieces, path);
  body.cuts = read_cuts(file, count);
  body.free_frequencies = file.read_vector("/assembled/free_frequencies");
  if (file.has("/uncut/free_frequencies")) body.effect.uncut_frequencies = file.read_vector("/uncut/free_frequencies");
  if (file.has("/assembled/stiffness_ratios")) body.effect.stiffness_ratios = file.read("/assembled/stiffness_ratios");
  return body;
}

Eigen::MatrixXd damping_of_piece(const Superelement& piece, double ratio, double frequency) {
  return rayleigh_damping(piece, 0, ratio / (std::numbers::pi * frequency));  // 2 zeta / omega
}

}  // namespace bielle

// Bodies that bend too much for one superelement: their pieces (`pieces` in the body file) are placed by one entry.
//
//   blade: {type: superelement, file: blade.h5, nodes: {root: hub, tip: tip}}
//
// creates a superelement `blade.1`, `blade.2` ... for each piece, all from the entry `blade`. Pieces share the nodes of
// the cuts, `blade.cut_1` ..., unless `nodes` names others.
#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "mechanism/elements/superelement/shared_matrices.hpp"
#include "mechanism/elements/superelement/superelement_reading.hpp"
#include "mechanism/reading/read_frame.hpp"
#include "reduce/superelement/assembled_pieces.hpp"
#include "reduce/superelement/cut_body.hpp"

namespace bielle::mechanism {
namespace {

CutBody read_file(const YamlValue& entry, const std::string& path) {
  try {
    return read_cut_body(path);
  } catch (const InputError& error) {
    entry.at("file").fail(error.what());
  }
}

/// Reads damping. A ratio is that of the first mode of the whole body.
MatrixX read_damping(const YamlValue& damping, const Superelement& piece, const CutBody& body) {
  const auto ratio = damping.find("ratio");
  if (!ratio || damping.has("rayleigh")) return read_superelement_damping(damping, piece);
  if (ratio->is_sequence())
    ratio->fail("a body in pieces has one ratio, that of its first free mode: expected a number");
  if (body.free_frequencies.size() == 0) ratio->fail("the body has no elastic mode that could be damped");
  return damping_of_piece(piece, ratio->number(), body.free_frequencies[0]);
}

/// Returns one superelement for the readers, with the interfaces of the whole body, the load patterns of all pieces,
/// and the mass properties.
Superelement whole_of(const CutBody& body) {
  Superelement whole = assembled(body.pieces);
  whole.name = body.name;
  for (const Superelement& piece : body.pieces)
    for (const auto& [pattern, force] : piece.loads) whole.loads[pattern];
  return whole;
}

/// Returns the nodes of a piece, selected from those of the whole.
std::vector<int> nodes_of(const Superelement& piece, const Superelement& whole, const std::vector<int>& nodes) {
  std::vector<int> result;
  for (const Interface& interface : piece.interfaces) {
    const auto place = std::find_if(whole.interfaces.begin(), whole.interfaces.end(),
                                    [&](const Interface& other) { return other.name == interface.name; });
    result.push_back(nodes[static_cast<std::size_t>(place - whole.interfaces.begin())]);
  }
  return result;
}

/// Checks that no other entry has the name of a piece, because results of pieces are stored under their names.
void check_name_later(const Entry& piece, const YamlValue& entry, Model& model) {
  model.when_read(Model::Stage::connections, [piece, entry, &model] {
    if (model.members_of(piece).size() > 1)
      entry.fail(
          fmt::format("a piece of this body is called '{}', as another element is: rename that one", piece.name));
  });
}

}  // namespace

void read_superelement_pieces(const std::string& name, const YamlValue& entry, const std::string& path, Model& model) {
  const CutBody body = read_file(entry, path);
  const Superelement whole = whole_of(body);
  const Frame placement = read_frame(entry);
  const std::vector<int> nodes = read_interface_nodes(name, entry, whole, placement, model);
  std::vector<SuperelementPlacement::Load> loads;
  if (const auto given = entry.find("loads")) loads = read_superelement_loads(*given, whole);
  const std::string file = std::filesystem::absolute(path).lexically_normal().string();
  for (std::size_t k = 0; k < body.pieces.size(); ++k) {
    const Superelement& piece = body.pieces[k];
    SuperelementPlacement setup = place_superelement(nodes_of(piece, whole, nodes), placement, model);
    setup.file = {file, group_of_piece(k)};
    if (const auto most = entry.find("largest_error")) setup.largest_error = most->number();
    if (const auto damping = entry.find("damping")) setup.damping = read_damping(*damping, piece, body);
    const YamlValue frame = entry.at("frame");
    if (frame.is_map()) frame.fail("no interface is that of all pieces: expected mean or mean_axes");
    read_body_frame(frame, piece, setup);
    for (const SuperelementPlacement::Load& load : loads)
      if (piece.loads.contains(load.pattern)) setup.loads.push_back(load);
    const Entry own{Section::elements, fmt::format("{}.{}", name, k + 1)};
    try {
      setup.matrices = shared_matrices(setup.file, piece);
      model.add_within(std::make_unique<SuperelementBody>(own.name, piece, std::move(setup)),
                       Entry{Section::elements, name}, own);
    } catch (const InputError& error) {
      entry.fail(error.what());
    }
    check_name_later(own, entry, model);
  }
}

}  // namespace bielle::mechanism

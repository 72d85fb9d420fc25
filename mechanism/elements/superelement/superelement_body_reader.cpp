// Reader of superelements in the mechanism file.
//
//   rod: {type: superelement, file: conrod.h5, nodes: {big_end: pin, small_end: wrist},
//         position: [..], rotation_vector: [..],     # of the mesh's origin and axes; default: as in the mesh
//         frame: mean,                               # of the interfaces; or mean_axes, {interface: big_end}
//         largest_error: 0.02,                       # of its deformation: the run fails beyond
//         damping: {ratio: 0.01},                    # or {ratio: [..]}, {rayleigh: [alpha, beta]}: instead of the
//                                                    # file's
//         loads: {pressure: "1e5*t", wind: {factor: 2, follower: false}}}
#include <filesystem>
#include <optional>

#include "mechanism/elements/superelement/shared_matrices.hpp"
#include "mechanism/elements/superelement/superelement_reading.hpp"
#include "mechanism/reading/read_frame.hpp"
#include "reduce/superelement/cut_body.hpp"

namespace bielle::mechanism {

void read_superelement_body(const std::string& name, const YamlValue& entry, Model& model) {
  const std::string path = entry.at("file").file_path();
  std::optional<Superelement> whole;
  try {
    whole = read_whole_for_motion(path);
  } catch (const InputError& error) {
    entry.at("file").fail(error.what());
  }
  if (!whole) return read_superelement_pieces(name, entry, path, model);
  const Superelement& body = *whole;
  const Frame placement = read_frame(entry);
  SuperelementPlacement setup =
      place_superelement(read_interface_nodes(name, entry, body, placement, model), placement, model);
  setup.file = std::filesystem::absolute(path).lexically_normal().string();
  read_body_frame(entry.at("frame"), body, setup);
  if (const auto most = entry.find("largest_error")) setup.largest_error = most->number();
  if (const auto damping = entry.find("damping")) setup.damping = read_superelement_damping(*damping, body);
  if (const auto loads = entry.find("loads")) setup.loads = read_superelement_loads(*loads, body);
  try {
    setup.matrices = shared_matrices(setup.file, body);
    model.add(std::make_unique<SuperelementBody>(name, body, std::move(setup)), Entry{Section::elements, name});
  } catch (const InputError& error) {
    entry.fail(error.what());
  }
}

}  // namespace bielle::mechanism

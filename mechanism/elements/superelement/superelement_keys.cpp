// Keys of superelements in the mechanism file.
#include "mechanism/elements/superelement/superelement_body.hpp"
#include "mechanism/reading/names.hpp"
#include "mechanism/reading/read_frame.hpp"

namespace bielle::mechanism {
namespace {

const KeyTable& damping_keys() {
  using namespace keys;
  const KeyForm ratio = number().non_negative();
  static const KeyTable table{
      "the damping",
      "Damping of the elastic motion.",
      {{"ratio",
        {ratio, list_of(ratio)},
        optional,
        "Damping ratio of all free modes, or a list with one for each; of a body in pieces, that of its first mode."},
       {"rayleigh", tuple({{number("1/s").non_negative()}, {number("s").non_negative()}}), optional,
        "Factors of the mass and of the stiffness, in place of `ratio`."}}};
  return table;
}

const KeyTable& pattern_keys() {
  using namespace keys;
  static const KeyTable table{
      "a load of a superelement",
      "A load pattern of the body.",
      {{"factor", formula("", {"t"}), required, "Factor of the pattern as a formula of the time t."},
       {"follower", boolean(), otherwise("true"),
        "Whether the forces turn with the body; otherwise their directions are fixed in space."}}};
  return table;
}

const KeyTable& frame_of_interface_keys() {
  using namespace keys;
  static const KeyTable table{"the frame of a superelement",
                              "A frame of the body that moves with an interface.",
                              {{"interface", text(), required, "Name of the interface."}}};
  return table;
}

}  // namespace

const KeyTable& superelement_keys() {
  using namespace keys;
  static const KeyTable table{
      "a superelement", "An elastic body that `bielle-reduce` has reduced to its interfaces.",
      joined({{type_key(),
               {"file", file("body of bielle-reduce"), required, "File of the reduced body."},
               {"nodes", entries("interface", {name_of("node")}), optional,
                "Nodes of the interfaces; those that are not named become nodes `<element>.<interface>`."}},
              frame_keys(),
              {{"frame",
                {word({"mean", "mean_axes"}, "a frame of a superelement"), nested(frame_of_interface_keys)},
                otherwise("mean"),
                "Frame of the body: the mean of the interfaces, mean axes of the mass, or that of an interface."},
               {"largest_error", number().positive(), optional,
                "Relative error of the deformation, as estimated, beyond which the run ends."},
               {"damping", nested(damping_keys), computed("as in the file"), "Damping in place of the file's."},
               {"loads", entries("load pattern", {formula("", {"t"}), nested(pattern_keys)}), optional,
                "Factors of the body's load patterns, as formulas of the time t."}}})};
  return table;
}

}  // namespace bielle::mechanism

#include "reduce/body_file/requested_modes.hpp"

#include <string>

#include "reduce/common/input/plausible.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::reduce {

const KeyTable& modes_keys() {
  using namespace keys;
  static const KeyTable table{
      "the modes",
      "Fixed-boundary modes to keep: a number, all below a frequency, or the lowest of these.",
      {{"count", integer().non_negative(), optional, "Number of modes, the lowest."},
       {"below", number("Hz").positive(), optional,
        "Frequency below which modes are kept; without `count`, up to 1000 of them."},
       {"method", word({"auto", "arpack", "block_lanczos"}, "a method for modes"), otherwise("auto"),
        "Method that computes the modes."},
       {"proof", boolean(), otherwise("false"), "The modes are counted, which proves that none was missed."}}};
  return table;
}

const KeyTable& damping_keys() {
  using namespace keys;
  static const KeyTable table{
      "the damping",
      "Damping of the reduced body, by ratios or by Rayleigh's two numbers.",
      {{"ratio",
        {number().non_negative(), list_of(number().non_negative()).items_at_least(1)},
        optional,
        "Damping ratio of the eigenmodes of the reduced body; in a list, the last ratio holds for all further modes. A "
        "body in pieces has one ratio, that of the first free mode of all pieces together."},
       {"rayleigh", tuple({{number("1/s").non_negative()}, {number("s").non_negative()}}), optional,
        "Rayleigh damping: `[alpha, beta]`, factors of the mass and of the stiffness."}}};
  return table;
}

RequestedModes read_modes(const YamlValue& value) {
  RequestedModes options;
  if (const auto count = value.find("count")) options.request.count = count->integer();
  if (const auto below = value.find("below")) options.request.below = below->number();
  const std::string method = value.at("method").word();
  options.request.method = method == "arpack"          ? EigenMethod::arpack
                           : method == "block_lanczos" ? EigenMethod::block_lanczos
                                                       : EigenMethod::automatic;
  options.proven = value.at("proof").boolean();
  if (!options.request.any()) value.fail("expected how many modes: count, or below [Hz], or both");
  return options;
}

RequestedDamping read_damping(const YamlValue& value) {
  RequestedDamping options;
  if (value.has("ratio") + value.has("rayleigh") != 1) value.fail("expected either ratio or rayleigh");
  if (const auto ratio = value.find("ratio")) {
    if (ratio->is_sequence())
      for (const YamlValue& item : ratio->items()) options.ratios.push_back(item.number());
    else
      options.ratios.push_back(ratio->number());
    if (options.ratios.empty()) ratio->fail("expected a number or a list of numbers");
    for (const double each : options.ratios) warn_outside(*ratio, each, plausible_damping_ratio);
    return options;
  }
  const YamlValue rayleigh = value.at("rayleigh");
  if (rayleigh.size() != 2) rayleigh.fail("expected [alpha, beta]: alpha [1/s] of the mass, beta [s] of the stiffness");
  options.rayleigh = {rayleigh.at(0).number(), rayleigh.at(1).number()};
  return options;
}

}  // namespace bielle::reduce

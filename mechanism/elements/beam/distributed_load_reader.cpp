// Reader of `distributed` of a beam.
#include <memory>
#include <utility>

#include "mechanism/elements/beam/distributed_load.hpp"
#include "mechanism/elements/beam/load_pieces.hpp"
#include "mechanism/measures/read_measure.hpp"
#include "mechanism/reading/read_numbers.hpp"

namespace bielle::mechanism {
namespace {

void read_line_components(const YamlValue& value, std::size_t first, Model& model, LineLoad& load) {
  if (!value.is_sequence() || value.size() != 3)
    value.fail(
        "expected three components per length, numbers or formulas of s (0 to 1 along the beam), t and the state");
  for (std::size_t k = 0; k < 3; ++k)
    load.components[first + k] = read_state_formula(value.at(k), span_variables(), model, load.references);
}

/// Reads all but the formulas.
LineLoad read_line_load(const YamlValue& value) {
  const auto force = value.find("force"), at = value.find("at");
  LineLoad load;
  load.has_force = force.has_value();
  load.has_moment = value.has("moment");
  if (!load.has_force && !load.has_moment) value.fail("a distributed load needs `force` or `moment`, per length");
  if (at) {
    if (!force) at->fail("`at` is the point of the section where a `force` acts, and there is none");
    const Vector2 point = read_numbers(*at, 2, "the point [y, z] of the section, from the node line");
    load.at = {0, point[0], point[1]};
  }
  load.follower = value.at("follower").boolean();
  return load;
}

void check_load_integrals(const YamlValue& components, std::size_t first, const LineLoad& load, int elements) {
  for (std::size_t k = 0; k < 3; ++k)
    check_load_integral(components.at(k), load.components[first + k], load.components, elements);
}

}  // namespace

const KeyTable& line_load_keys() {
  using namespace keys;
  static const KeyTable table{
      "a distributed load",
      "A force and a moment per length of a beam, as formulas of s, from 0 at its start to 1 at its end, the time t, "
      "the velocity of the line there, in inertial components vx, vy, vz and in components section_vx, section_vy, "
      "section_vz along the axes of the section, and measures.",
      {{"force", list_of(3, state_formula("N/m", span_variables())).as_vector().in_inertial_axes(), optional,
        "Components of the force per length."},
       {"moment", list_of(3, state_formula("N m/m", span_variables())).as_axial().in_inertial_axes(), optional,
        "Components of the moment per length."},
       {"at", list_of(2, number("m")), otherwise("[0, 0]"),
        "Point of the section at which the force acts, from the node line along y and z."},
       {"follower", boolean(), otherwise("false"),
        "Whether the components are along the axes of the section and turn with it; otherwise they are inertial."}}};
  return table;
}

void add_line_loads(const std::string& beam, const YamlValue& value, const std::vector<BeamSpan>& spans,
                    const Entry& own, Model& model) {
  const std::vector<YamlValue> items = value.is_sequence() ? value.items() : std::vector<YamlValue>{value};
  if (items.empty()) value.fail("expected at least one load");
  for (const YamlValue& item : items) {
    LineLoad load = read_line_load(item);
    std::vector<DistributedLoad*> parts;
    for (const BeamSpan& span : spans) {
      auto part = std::make_unique<DistributedLoad>(beam, span);
      parts.push_back(part.get());
      model.add(std::move(part), own);
    }
    model.when_read(Model::Stage::formulas, [item, load = std::move(load), parts, &model]() mutable {
      if (load.has_force) read_line_components(item.at("force"), 0, model, load);
      if (load.has_moment) read_line_components(item.at("moment"), 3, model, load);
      const int elements = static_cast<int>(parts.size());
      if (load.has_force) check_load_integrals(item.at("force"), 0, load, elements);
      if (load.has_moment) check_load_integrals(item.at("moment"), 3, load, elements);
      for (DistributedLoad* part : parts) part->set(load);
    });
  }
}

}  // namespace bielle::mechanism

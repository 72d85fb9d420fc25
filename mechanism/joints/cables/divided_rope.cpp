#include "mechanism/joints/cables/divided_rope.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>

#include "mechanism/joints/cables/rope_friction.hpp"
#include "mechanism/joints/cables/rope_grip.hpp"

namespace bielle::mechanism {

DividedRope::DividedRope(const char* type, const std::string& name, const RopePath& path, const RopeMaterial& material,
                         const RopeFrictions& frictions, const YamlValue& entry, Model& model)
    : type_(type),
      name_(name),
      path_(path),
      material_(material),
      frictions_(frictions),
      entry_(entry),
      model_(model),
      slips_(path.nodes.size(), nullptr) {
  const auto has_friction = [](const std::optional<double>& each) { return each.has_value(); };
  count_ = static_cast<std::size_t>(std::count_if(frictions.begin(), frictions.end(), has_friction));
}

void DividedRope::add(const std::vector<std::vector<std::size_t>>& sections, bool closed) {
  for (std::size_t k = 0; k < path_.nodes.size(); ++k)
    if (frictions_[k]) add_slip(k);
  const Recorded recorded = sections.size() > 1 ? Recorded::stacked : Recorded::alone;
  std::vector<const RopeSection*> added;
  for (const std::vector<std::size_t>& places : sections) added.push_back(&add_section(places, recorded));
  for (std::size_t k = closed ? 0 : 1; k < added.size(); ++k)
    add_between(*added[(k + added.size() - 1) % added.size()], *added[k], sections[k].front(), closed);
}

void DividedRope::add_slip(std::size_t place) {
  double length = 0;  // sum of the distances to the adjacent places
  const std::size_t count = path_.nodes.size();
  const auto centre = [&](std::size_t k) -> Vector3 { return (path_.drawn[k] * path_.pulleys[k].on_node).x; };
  for (const std::size_t other : {(place + count - 1) % count, (place + 1) % count})
    length += (centre(other) - centre(place)).norm();
  auto slip = std::make_unique<RopeSlip>(type_, name_, path_.names[place], length, material_.damping);
  slips_[place] = slip.get();
  model_.add(std::move(slip), own(), Recorded::no);
}

const RopeSection& DividedRope::add_section(const std::vector<std::size_t>& places, Recorded recorded) {
  RopePath part;
  for (const std::size_t k : places) {
    part.nodes.push_back(path_.nodes[k]);
    part.names.push_back(path_.names[k]);
    part.pulleys.push_back(path_.pulleys[k]);
    part.drawn.push_back(path_.drawn[k]);
    // Turns at an end of the part are counted by the wrap of its pulley.
    part.turns.push_back(k == places.front() || k == places.back() ? 0 : path_.turns[k]);
  }
  const RopeSection::EndSlips slips = {slips_[places.front()], slips_[places.back()]};
  try {
    auto section = std::make_unique<RopeSection>(type_, name_, std::move(part), material_, slips);
    const RopeSection& added = *section;
    model_.add(std::move(section), own(), recorded);
    return added;
  } catch (const std::domain_error& error) {
    entry_.at("radii").fail(error.what());
  }
}

/// Adds a monitor of the wrap on the place between two sections, and friction.
void DividedRope::add_between(const RopeSection& before, const RopeSection& after, std::size_t place, bool closed) {
  if (path_.pulleys[place].radius == 0) return;
  const RopeWrap wrap(before, after, path_.turns[place]);
  const std::optional<double>& coefficient = frictions_[place];
  model_.add(std::make_unique<RopeGrip>(before, after, wrap, coefficient.has_value()), own(), Recorded::no);
  if (!coefficient) return;
  model_.add(std::make_unique<RopeFriction>(before, after, wrap, *coefficient, frictions_added_++, count_, closed),
             own());
}

}  // namespace bielle::mechanism

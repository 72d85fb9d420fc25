#include "mechanism/system/local_to_global.hpp"

#include <algorithm>

namespace bielle::mechanism {
namespace {

/// Returns whether every node of a component and of its references is free in all directions or held in all.
bool is_plain(const NodeKinematics& kinematics, const Slots& slots) {
  const auto plain_node = [&](int node) {
    return !kinematics.carry(node) && (kinematics.freedom(node).all_free || kinematics.freedom(node).count == 0);
  };
  return std::all_of(slots.nodes.begin(), slots.nodes.end(), plain_node) &&
         std::all_of(slots.references.begin(), slots.references.end(),
                     [&](const Slots* other) { return is_plain(kinematics, *other); });
}

}  // namespace

Targets::Targets(const std::vector<Target>& all) {
  const auto follows = [&](std::size_t k, std::size_t distance) {
    const auto step = static_cast<int>(distance);
    return k < all.size() && all[k].entry == all[k - distance].entry + step &&
           all[k].place == all[k - distance].place + step;
  };
  for (std::size_t k = 0; k < all.size();) {
    const bool triple = follows(k + 1, 1) && follows(k + 2, 2);
    (triple ? triples : singles).push_back(all[k]);
    k += triple ? 3 : 1;
  }
  triples.shrink_to_fit();
  singles.shrink_to_fit();
}

void Targets::scatter(const double* entries, std::vector<double>& values) const {
  for (const auto [first, place] : triples) {
    const double* entry = entries + first;
    double* value = values.data() + place;
    value[0] += entry[0];
    value[1] += entry[1];
    value[2] += entry[2];
  }
  for (const auto [entry, place] : singles) values[static_cast<std::size_t>(place)] += entries[entry];
}

void Targets::collect(const double* entries, double* waiting) const {
  for (const auto [first, place] : triples) waiting = std::copy_n(entries + first, 3, waiting);
  for (const auto [entry, place] : singles) *waiting++ = entries[entry];
}

void Targets::scatter_collected(const double* waiting, std::vector<double>& values) const {
  for (const auto [first, place] : triples)
    for (int k = 0; k < 3; ++k) values[static_cast<std::size_t>(place + k)] += *waiting++;
  for (const auto [entry, place] : singles) values[static_cast<std::size_t>(place)] += *waiting++;
}

LocalToGlobal::LocalToGlobal(const Declaration& declaration)
    : stiffness(!declaration.passive && (declaration.stiffness || !declaration.multipliers.empty())),
      damping(!declaration.passive && declaration.damping),
      mass(!declaration.passive && declaration.mass),
      blocks_only(declaration.in_blocks) {}

void LocalToGlobal::find_rows(const NodeKinematics& kinematics, const Unknowns& unknowns, const Slots& slots) {
  for (int k = 0; k < slots.multipliers; ++k)
    if (unknowns.constraint_kind(slots.multiplier_begin + k) == ConstraintKind::nonholonomic)
      nonholonomic.push_back(slots.multiplier_row() + k);
  plain = is_plain(kinematics, slots);
  own_size = slots.own_size();
  own_nodes_end = slots.amplitude_row();
  in_place = blocks_only && plain && nonholonomic.empty() && slots.first_orders == 0 && slots.references.empty();
  nodes.reserve(slots.nodes.size());
  unknown.reserve(static_cast<std::size_t>(slots.size()));
  add_parts(kinematics, unknowns, slots, 0, true);
  reads_multipliers = std::any_of(scalars.begin(), scalars.end(),
                                  [](const ScalarPart& part) { return part.kind == Kind::multiplier && !part.own; });
}

void LocalToGlobal::add_parts(const NodeKinematics& kinematics, const Unknowns& unknowns, const Slots& slots, int local,
                              bool own) {
  for (std::size_t k = 0; k < slots.nodes.size(); ++k) {
    const int node = slots.nodes[k];
    const Carry* carry = kinematics.carry(node);
    const NodeFreedom& f = kinematics.freedom(carry ? carry->carrier : node);
    nodes.push_back({node, local + 6 * static_cast<int>(k), reduced_size()});
    for (int c = 0; c < f.count; ++c) unknown.push_back(f.begin + c);
    if (plain && f.count == 0) unknown.insert(unknown.end(), 6, -1);
  }
  const auto add_scalars = [&](Kind kind, int row, int begin, int count) {
    if (count > 0) scalars.push_back({kind, local + row, reduced_size(), count, begin, own});
    for (int k = 0; k < count; ++k) unknown.push_back(begin + k);
  };
  add_scalars(Kind::amplitude, slots.amplitude_row(), unknowns.first_amplitude() + slots.amplitude_begin,
              slots.amplitudes);
  add_scalars(Kind::first_order, slots.first_order_row(), unknowns.first_first_order() + slots.first_order_begin,
              slots.first_orders);
  add_scalars(Kind::multiplier, slots.multiplier_row(), unknowns.first_multiplier() + slots.multiplier_begin,
              slots.multipliers);
  for (std::size_t k = 0; k < slots.references.size(); ++k)
    add_parts(kinematics, unknowns, *slots.references[k], local + slots.reference_rows[k], false);
}

const ScalarPart* LocalToGlobal::own_amplitudes() const {
  for (const ScalarPart& part : scalars)
    if (part.own && part.kind == Kind::amplitude) return &part;
  return nullptr;
}

/// Returns the pattern of a component. Nodes that are held in some directions or carried by others mix the directions
/// of forces, so that all entries are then kept.
LocalPattern LocalToGlobal::pattern(const Component& component, const Slots& slots) const {
  LocalPattern pattern(reduced_size());
  if (!plain) {
    pattern.add_all();
    return pattern;
  }
  component.add_pattern(slots, pattern);
  // T(Dq) mixes the three columns of a rotation.
  for (const NodePart& part : nodes)
    for (int row = 0, first = part.local + 3; row < reduced_size(); ++row)
      if (pattern.has(row, first) || pattern.has(row, first + 1) || pattern.has(row, first + 2))
        pattern.add_block(row, first, 1, 3);
  return pattern;
}

void LocalToGlobal::set_places(const NodeKinematics& kinematics, const Slots& slots,
                               const std::vector<Targets::Target>& kept) {
  if (!in_place) {
    const ScalarPart* amplitudes = lone_amplitudes ? own_amplitudes() : nullptr;
    const auto is_lone = [&](const Targets::Target& target) {
      const int row = target.entry % reduced_size() - amplitudes->reduced,
                column = target.entry / reduced_size() - amplitudes->reduced;
      return (row >= 0 && row < amplitudes->count) || (column >= 0 && column < amplitudes->count);
    };
    std::vector<Targets::Target> own, others;
    for (const Targets::Target& target : kept) (amplitudes && is_lone(target) ? own : others).push_back(target);
    lone = Targets(own);
    targets = Targets(others);
    return;
  }
  places.size = slots.size();
  places.multiplier_row = slots.multiplier_row();
  const auto size = static_cast<std::size_t>(places.size);
  places.place.assign(size * size, -1);
  for (const auto [entry, place] : kept) places.place[static_cast<std::size_t>(entry)] = place;
  places.turned_node.assign(size, -1);
  for (std::size_t k = 0; k < slots.nodes.size(); ++k)
    if (kinematics.freedom(slots.nodes[k]).all_free) places.turned_node[6 * k + 3] = slots.nodes[k];
}

void LocalToGlobal::scatter(const double* entries, std::vector<double>& values) const {
  if (!in_place) {
    lone.scatter(entries, values);
    targets.scatter(entries, values);
    return;
  }
  for (std::size_t k = 0; k < places.place.size(); ++k)
    if (const int place = places.place[k]; place >= 0) values[static_cast<std::size_t>(place)] += entries[k];
}

}  // namespace bielle::mechanism

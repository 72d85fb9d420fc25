#include "mechanism/system/system.hpp"

#include <algorithm>
#include <functional>
#include <stdexcept>

#include <fmt/format.h>

namespace bielle::mechanism {
namespace {

constexpr const char* axis_names[] = {"x", "y", "z"};

/// "joint 'main'", "element 'rod'": how a message names a member.
std::string describe(const Member& member) {
  const std::string& type = member.component->type();
  // Drives are recorded with the joint that they drive, and loads not at all: they go by their type.
  const bool element = member.group.rfind("elements/", 0) == 0;
  const bool joint = member.group.rfind("joints/", 0) == 0 && type != "drive";
  return fmt::format("{} '{}'", element ? "element" : joint ? "joint" : type, member.component->name());
}

}  // namespace

System::System(const Model& model) : model_(model), kinematics_(model) {
  std::vector<Declaration> declarations;
  std::vector<double> amplitude, first_order, multiplier, memory;
  std::vector<std::string> amplitude_names, first_order_names, multiplier_names;
  const auto append = [](const std::vector<Declaration::Scalar>& scalars, const Member& member,
                         std::vector<double>& values, std::vector<std::string>& names) {
    for (const Declaration::Scalar& scalar : scalars) {
      values.push_back(scalar.start);
      names.push_back(fmt::format("{} of {}", scalar.name, describe(member)));
    }
  };
  slots_.reserve(model.members().size());  // references point to them
  for (const Member& member : model.members()) {
    const std::size_t index = slots_.size();
    member_index_[member.component.get()] = index;
    Declaration declaration;
    member.component->declare(declaration);
    Slots slots;
    slots.nodes = declaration.nodes;
    slots.amplitude_begin = static_cast<int>(amplitude.size());
    slots.amplitudes = static_cast<int>(declaration.amplitudes.size());
    slots.first_order_begin = static_cast<int>(first_order.size());
    slots.first_orders = static_cast<int>(declaration.first_order.size());
    slots.multiplier_begin = static_cast<int>(multiplier.size());
    slots.multipliers = static_cast<int>(declaration.multipliers.size());
    slots.memory_begin = static_cast<int>(memory.size());
    slots.memories = static_cast<int>(declaration.memory.size());
    append(declaration.amplitudes, member, amplitude, amplitude_names);
    append(declaration.first_order, member, first_order, first_order_names);
    append(declaration.multipliers, member, multiplier, multiplier_names);
    for (const Declaration::Scalar& scalar : declaration.multipliers) constraint_kinds_.push_back(scalar.kind);
    memory.insert(memory.end(), declaration.memory.begin(), declaration.memory.end());
    for (int k = 0; k < slots.multipliers; ++k)
      if (declaration.multipliers[static_cast<std::size_t>(k)].switched)
        switched_.push_back({index, k, slots.multiplier_begin + k});
    for (int k = 0; k < static_cast<int>(declaration.crossings.size()); ++k) {
      const Crossing& crossing = declaration.crossings[static_cast<std::size_t>(k)];
      crossings_.push_back({index, k, crossing, describe(member) + (crossing.name.empty() ? "" : ": " + crossing.name)});
    }
    if (!declaration.passive) {  // measures are read by what acts
      acting_.push_back(index);
      reads_reactions_ = reads_reactions_ || declaration.reads_reactions;
      kinks_ = kinks_ || declaration.kinks || declaration.reads_reactions;
    }
    slots_.push_back(slots);
    declarations.push_back(std::move(declaration));
  }
  resolve_references(declarations);
  const auto as_vector = [](const std::vector<double>& values) {
    return VectorX(Eigen::Map<const VectorX>(values.data(), static_cast<Eigen::Index>(values.size())));
  };
  amplitudes_ = static_cast<int>(amplitude.size());
  first_orders_ = static_cast<int>(first_order.size());
  multipliers_ = static_cast<int>(multiplier.size());
  start_amplitude_ = as_vector(amplitude);
  start_first_order_ = as_vector(first_order);
  start_multiplier_ = as_vector(multiplier);
  start_memory_ = as_vector(memory);
  for (auto* names : {&amplitude_names, &first_order_names, &multiplier_names})
    scalar_names_.insert(scalar_names_.end(), names->begin(), names->end());

  kinds_.assign(static_cast<std::size_t>(size()), Kind::multiplier);
  for (int i = 0; i < static_cast<int>(model.nodes().size()); ++i) {
    const NodeFreedom& f = kinematics_.freedom(i);
    for (int c = 0; c < f.count; ++c)
      kinds_[static_cast<std::size_t>(f.begin + c)] =
          f.G.col(c).head<3>().squaredNorm() > 0 ? Kind::translation : Kind::rotation;
  }
  const auto fill = [&](int begin, int count, Kind kind) { std::fill_n(kinds_.begin() + begin, count, kind); };
  fill(kinematics_.unknowns(), amplitudes_, Kind::amplitude);
  fill(dofs(), first_orders_, Kind::first_order);
  take_units(declarations);
  place(declarations);
}

void System::resolve_references(const std::vector<Declaration>& declarations) {
  enum class Progress : char { untouched, under_way, done };
  std::vector<Progress> progress(slots_.size(), Progress::untouched);
  const std::function<void(std::size_t)> resolve = [&](std::size_t m) {
    progress[m] = Progress::under_way;
    for (const Component* component : declarations[m].references) {
      const auto found = member_index_.find(component);
      if (found == member_index_.end())
        throw std::logic_error("component '" + component->name() + "' is referred to but not part of the model");
      const std::size_t other = found->second;
      if (progress[other] == Progress::under_way) {
        const std::string name = describe(model_.members()[m]), to = describe(model_.members()[other]);
        throw InputError(other == m ? fmt::format("{} refers to itself", name)
                                    : fmt::format("{} refers to {}, which refers back to it", name, to));
      }
      if (progress[other] == Progress::untouched) resolve(other);
      slots_[m].refer_to(slots_[other]);
    }
    progress[m] = Progress::done;
  };
  for (std::size_t m = 0; m < slots_.size(); ++m)
    if (progress[m] == Progress::untouched) resolve(m);
}

void System::add_parts(Placement& placement, const Slots& slots, int local, bool own) const {
  const auto reduced = [&] { return static_cast<int>(placement.unknown.size()); };
  for (std::size_t k = 0; k < slots.nodes.size(); ++k) {
    const int node = slots.nodes[k];
    const Carry* carry = kinematics_.carry(node);
    const NodeFreedom& f = kinematics_.freedom(carry ? carry->carrier : node);
    placement.nodes.push_back({node, local + 6 * static_cast<int>(k), reduced()});
    for (int c = 0; c < f.count; ++c) placement.unknown.push_back(f.begin + c);
    if (placement.plain && f.count == 0) placement.unknown.insert(placement.unknown.end(), 6, -1);
  }
  const auto add_scalars = [&](Kind kind, int row, int begin, int count) {
    if (count > 0) placement.scalars.push_back({kind, local + row, reduced(), count, begin, own});
    for (int k = 0; k < count; ++k) placement.unknown.push_back(begin + k);
  };
  add_scalars(Kind::amplitude, slots.amplitude_row(), kinematics_.unknowns() + slots.amplitude_begin, slots.amplitudes);
  add_scalars(Kind::first_order, slots.first_order_row(), dofs() + slots.first_order_begin, slots.first_orders);
  add_scalars(Kind::multiplier, slots.multiplier_row(), dofs() + first_orders_ + slots.multiplier_begin,
              slots.multipliers);
  for (std::size_t k = 0; k < slots.references.size(); ++k)
    add_parts(placement, *slots.references[k], local + slots.reference_rows[k], false);
}

namespace {

/// Units of a scalar's equation where its component says none.
std::string usual_equation_units(Kind kind, const Declaration::Scalar& scalar) {
  if (kind == Kind::amplitude) return scalar.units == "m" ? "N" : scalar.units == "rad" ? "N m" : "N/sqrt(kg)";
  if (kind == Kind::first_order) return scalar.algebraic ? scalar.units : scalar.units + "/s";
  const std::string length = scalar.units == "N" ? "m" : "rad";
  return scalar.kind == ConstraintKind::holonomic ? length : length + "/s";
}

}  // namespace

/// Sizes and units of scalars, in global order.
void System::take_units(const std::vector<Declaration>& declarations) {
  const auto append = [&](Kind kind, std::vector<Declaration::Scalar> Declaration::*scalars) {
    for (const Declaration& declaration : declarations)
      for (const Declaration::Scalar& scalar : declaration.*scalars) {
        scalar_scales_.push_back(scalar.scale);
        scalar_equation_units_.push_back(scalar.equation_units.empty() ? usual_equation_units(kind, scalar)
                                                                       : scalar.equation_units);
        if (kind == Kind::first_order && scalar.algebraic)
          algebraic_.push_back(static_cast<int>(scalar_scales_.size()) - 1 - amplitudes_);
      }
  };
  append(Kind::amplitude, &Declaration::amplitudes);
  append(Kind::first_order, &Declaration::first_order);
  append(Kind::multiplier, &Declaration::multipliers);
}

void System::place(const std::vector<Declaration>& declarations) {
  const std::function<bool(const Slots&)> plain = [&](const Slots& slots) {
    const auto is_plain = [&](int node) {
      return !kinematics_.carry(node) && (kinematics_.freedom(node).all_free || kinematics_.freedom(node).count == 0);
    };
    return std::all_of(slots.nodes.begin(), slots.nodes.end(), is_plain) &&
           std::all_of(slots.references.begin(), slots.references.end(), [&](const Slots* other) { return plain(*other); });
  };
  for (std::size_t m = 0; m < slots_.size(); ++m) {
    const Slots& slots = slots_[m];
    Placement placement;
    placement.stiffness = declarations[m].stiffness || slots.multipliers > 0;
    placement.damping = declarations[m].damping;
    placement.mass = declarations[m].mass;
    for (std::size_t k = 0; k < declarations[m].multipliers.size(); ++k)
      if (declarations[m].multipliers[k].kind == ConstraintKind::nonholonomic)
        placement.nonholonomic.push_back(slots.multiplier_row() + static_cast<int>(k));
    placement.plain = plain(slots);
    placement.own_size = slots.own_size();
    placement.own_nodes_end = slots.amplitude_row();
    placement.in_blocks = declarations[m].in_blocks && placement.plain && placement.nonholonomic.empty() &&
                          slots.first_orders == 0 && slots.references.empty();
    add_parts(placement, slots, 0, true);
    placement.reads_multipliers =
        std::any_of(placement.scalars.begin(), placement.scalars.end(),
                    [](const ScalarPart& part) { return part.kind == Kind::multiplier && !part.own; });
    if (declarations[m].passive) placement.stiffness = placement.damping = placement.mass = false;
    if (!declarations[m].passive)
      for (const int node : slots.nodes) force_rows_.push_back(kinematics_.force_row(node));
    largest_local_ = std::max(largest_local_, slots.size());
    placements_.push_back(std::move(placement));
  }
  build_pattern();
}

LocalPattern System::reduced_pattern(std::size_t member) const {
  const Placement& placement = placements_[member];
  const Slots& slots = slots_[member];
  const auto size = static_cast<int>(placement.unknown.size());
  LocalPattern pattern(size);
  if (!placement.plain) {  // what a carrier takes over mixes directions
    pattern.add_all();
    return pattern;
  }
  model_.members()[member].component->add_pattern(slots, pattern);
  // T(Dq) mixes the three columns of a rotation.
  for (const NodePart& part : placement.nodes)
    for (int row = 0, first = part.local + 3; row < size; ++row)
      if (pattern.has(row, first) || pattern.has(row, first + 1) || pattern.has(row, first + 2))
        pattern.add_block(row, first, 1, 3);
  return pattern;
}

BlockPlaces System::block_places(const Slots& slots, const std::vector<Target>& targets) const {
  BlockPlaces places;
  places.size = slots.size();
  places.multiplier_row = slots.multiplier_row();
  const auto size = static_cast<std::size_t>(places.size);
  places.place.assign(size * size, -1);
  for (const auto [entry, place] : targets) places.place[static_cast<std::size_t>(entry)] = place;
  places.turned_node.assign(size, -1);
  for (std::size_t k = 0; k < slots.nodes.size(); ++k)
    if (kinematics_.freedom(slots.nodes[k]).all_free) places.turned_node[6 * k + 3] = slots.nodes[k];
  return places;
}

void System::build_pattern() {
  // A constraint does not depend on multipliers: that block stays out of the pattern, but for those that may be out of
  // the equations. Nobody adds to the constraints of others.
  const int first_multiplier = dofs() + first_orders_;
  std::vector<std::pair<int, int>> entries;
  const auto for_each_kept = [&](std::size_t member, const auto& act) {
    const Placement& placement = placements_[member];
    if (!placement.stiffness && !placement.damping && !placement.mass) return;
    const LocalPattern pattern = reduced_pattern(member);
    const auto n = static_cast<int>(placement.unknown.size());
    std::vector<bool> of_others(static_cast<std::size_t>(n), false);
    for (const ScalarPart& part : placement.scalars)
      if (part.kind == Kind::multiplier && !part.own)
        std::fill_n(of_others.begin() + part.reduced, part.count, true);
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const int row = placement.unknown[static_cast<std::size_t>(i)],
                  column = placement.unknown[static_cast<std::size_t>(j)];
        if (row >= 0 && column >= 0 && !(row >= first_multiplier && column >= first_multiplier) &&
            !of_others[static_cast<std::size_t>(i)] && pattern.has(i, j))
          act(j * n + i, row, column);
      }
  };
  for (std::size_t member = 0; member < placements_.size(); ++member)
    for_each_kept(member, [&](int, int row, int column) { entries.emplace_back(row, column); });
  for (int i = 0; i < dofs(); ++i) entries.emplace_back(i, i);  // solvers add to it
  for (const int multiplier : set_aside_)
    entries.emplace_back(first_multiplier + multiplier, first_multiplier + multiplier);
  // Which constraints are redundant may change with those that are switched.
  if (switches())
    for (int row = first_multiplier; row < size(); ++row) entries.emplace_back(row, row);
  pattern_ = SparsePattern(size(), std::move(entries));
  for (std::size_t member = 0; member < placements_.size(); ++member) {
    std::vector<Target> targets;
    for_each_kept(member, [&](int entry, int row, int column) {
      targets.push_back({entry, pattern_.find(row, column)});
    });
    placements_[member].targets = in_triples(targets);
    if (placements_[member].in_blocks) placements_[member].places = block_places(slots_[member], targets);
  }
  find_idle_places();
}

void System::find_idle_places() {
  idle_places_.assign(static_cast<std::size_t>(multipliers_), {});
  const int first = dofs() + first_orders_;
  std::vector<bool> wanted(static_cast<std::size_t>(multipliers_), switches());
  for (const int multiplier : set_aside_) wanted[static_cast<std::size_t>(multiplier)] = true;
  const auto places_of = [&](int unknown) -> IdlePlaces* {
    const auto k = static_cast<std::size_t>(unknown - first);
    return unknown >= first && wanted[k] ? &idle_places_[k] : nullptr;
  };
  for (int column = 0; column < size(); ++column)
    for (int k = pattern_.column_start()[static_cast<std::size_t>(column)];
         k < pattern_.column_start()[static_cast<std::size_t>(column) + 1]; ++k) {
      const int row = pattern_.row()[static_cast<std::size_t>(k)];
      if (row == column) {
        if (IdlePlaces* const places = places_of(row)) places->diagonal = k;
        continue;
      }
      for (const int unknown : {row, column})
        if (IdlePlaces* const places = places_of(unknown)) places->entries.push_back(k);
    }
}

System::Targets System::in_triples(const std::vector<Target>& targets) {
  Targets result;
  const auto follows = [&](std::size_t k, int distance) {
    return k < targets.size() && targets[k].entry == targets[k - static_cast<std::size_t>(distance)].entry + distance &&
           targets[k].place == targets[k - static_cast<std::size_t>(distance)].place + distance;
  };
  for (std::size_t k = 0; k < targets.size();) {
    const bool triple = follows(k + 1, 1) && follows(k + 2, 2);
    (triple ? result.triples : result.singles).push_back(targets[k]);
    k += triple ? 3 : 1;
  }
  return result;
}

void System::set_aside(const std::vector<int>& multipliers) {
  set_aside_ = multipliers;
  for (Slots& slots : slots_)
    slots.carried_axes = std::any_of(multipliers.begin(), multipliers.end(), [&](int multiplier) {
      return multiplier >= slots.multiplier_begin && multiplier < slots.multiplier_begin + slots.multipliers;
    });
  // Rows that may be set aside later have to be carried, too.
  if (switches())
    for (Slots& slots : slots_) slots.carried_axes = true;
  build_pattern();
}

std::string System::unknown_name(int unknown) const {
  if (unknown >= kinematics_.unknowns())
    return scalar_names_[static_cast<std::size_t>(unknown - kinematics_.unknowns())];
  for (int i = 0; i < static_cast<int>(model_.nodes().size()); ++i) {
    const NodeFreedom& f = kinematics_.freedom(i);
    if (unknown < f.begin || unknown >= f.begin + f.count) continue;
    Eigen::Index direction = 0;
    f.G.col(unknown - f.begin).cwiseAbs().maxCoeff(&direction);
    return fmt::format("{} {} of node '{}'", direction < 3 ? "displacement" : "rotation", axis_names[direction % 3],
                       model_.node(i).name);
  }
  return "unknown " + std::to_string(unknown);
}

std::string System::equation_name(int equation) const {
  switch (kind(equation)) {
    case Kind::translation:
    case Kind::rotation: {
      std::string name = unknown_name(equation);
      const bool force = kind(equation) == Kind::translation;
      name.replace(0, name.find(' '), force ? "force" : "moment");
      name.replace(name.find(" of "), 4, " at ");
      return name;
    }
    case Kind::amplitude:
    case Kind::first_order:
      return "equation of " + unknown_name(equation);
    case Kind::multiplier:
      break;
  }
  return "constraint " + unknown_name(equation);
}

std::string System::equation_units(int equation) const {
  if (kind(equation) == Kind::translation) return "N";
  if (kind(equation) == Kind::rotation) return "N m";
  return scalar_equation_units_[static_cast<std::size_t>(equation - kinematics_.unknowns())];
}

std::string System::wrong_branch(const State& state, const Environment& environment) const {
  for (std::size_t m = 0; m < slots_.size(); ++m) {
    if (slots_[m].multipliers == 0) continue;
    const Member& member = model_.members()[m];
    if (const std::string what = member.component->wrong_branch(LocalState(state, slots_[m], environment));
        !what.empty())
      return fmt::format("{}: {}", describe(member), what);
  }
  return {};
}

State System::start(double time) const {
  State state;
  state.time = time;
  kinematics_.start(state.nodes, time);
  state.amplitude = start_amplitude_;
  state.amplitude_rate = VectorX::Zero(amplitudes_);
  state.amplitude_acceleration = VectorX::Zero(amplitudes_);
  state.first_order = start_first_order_;
  state.first_order_rate = VectorX::Zero(first_orders_);
  state.multiplier = start_multiplier_;
  state.memory = start_memory_;
  return state;
}

void System::displace(State& state, const State& base, const Eigen::Ref<const VectorX>& dq) const {
  kinematics_.displace(state.nodes, base.nodes, dq.head(kinematics_.unknowns()), state.time, state.motion_factor);
  state.amplitude = base.amplitude + dq.tail(amplitudes_);
}

void System::set_rates(State& state, const Eigen::Ref<const VectorX>& v, const Eigen::Ref<const VectorX>& a) const {
  const int n = kinematics_.unknowns();
  kinematics_.set_rates(state.nodes, v.head(n), a.head(n), state.time);
  state.amplitude_rate = v.tail(amplitudes_);
  state.amplitude_acceleration = a.tail(amplitudes_);
}

void System::get_rates(const State& state, Eigen::Ref<VectorX> v, Eigen::Ref<VectorX> a) const {
  const int n = kinematics_.unknowns();
  kinematics_.get_rates(state.nodes, v.head(n), a.head(n));
  v.tail(amplitudes_) = state.amplitude_rate;
  a.tail(amplitudes_) = state.amplitude_acceleration;
}

void System::constraint_rates(const State& state, const Environment& environment, Eigen::Ref<VectorX> velocity,
                              Eigen::Ref<VectorX> acceleration) const {
  velocity.setZero();
  acceleration.setZero();
  for (std::size_t m = 0; m < slots_.size(); ++m) {
    const Slots& slots = slots_[m];
    if (slots.multipliers == 0) continue;
    model_.members()[m].component->add_constraint_rates(
        LocalState(state, slots, environment), velocity.segment(slots.multiplier_begin, slots.multipliers),
        acceleration.segment(slots.multiplier_begin, slots.multipliers));
  }
}

std::vector<double> System::break_points() const {
  std::vector<double> times;
  for (const Member& member : model_.members()) member.component->add_break_points(times);
  for (const Node& node : model_.nodes())
    for (std::size_t k = 0; k < 6; ++k)
      if (node.freedom[k] == Freedom::prescribed)
        for (const double time : node.motion[k].break_points()) times.push_back(time);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

bool System::accept(State& state, const Environment& environment) const {
  thread_local VectorX memory;
  memory = state.memory;
  bool branches_left = false;
  for (std::size_t m = 0; m < slots_.size(); ++m) {
    if (slots_[m].memories == 0) continue;
    const Component& component = *model_.members()[m].component;
    const LocalState local(state, slots_[m], environment);
    if (component.leaves_branch(local)) branches_left = true;
    component.accept(local, memory.segment(slots_[m].memory_begin, slots_[m].memories));
  }
  state.memory.swap(memory);
  // One Newton step of the polar decomposition removes the rounding that products of rotations gather.
  for (NodeState& node : state.nodes) {
    const Matrix3 excess = node.R.transpose() * node.R;
    node.R = node.R * (1.5 * Matrix3::Identity() - 0.5 * excess);
  }
  return branches_left;
}

void System::begin_branch(State& state, const Environment& environment, const std::vector<int>& crossed) const {
  VectorX memory = state.memory;
  std::vector<int> own;
  for (std::size_t m = 0; m < slots_.size(); ++m) {
    if (slots_[m].memories == 0) continue;
    own.clear();
    for (const int k : crossed)
      if (crossings_[static_cast<std::size_t>(k)].member == m) own.push_back(crossings_[static_cast<std::size_t>(k)].index);
    model_.members()[m].component->begin_branch(LocalState(state, slots_[m], environment), own,
                                                memory.segment(slots_[m].memory_begin, slots_[m].memories));
  }
  state.memory = memory;
  switch_constraints(state, environment);
}

void System::switch_constraints(State& state, const Environment& environment) const {
  if (!switches()) return;
  state.idle.assign(static_cast<std::size_t>(multipliers_), Idle::active);
  for (const Switched& each : switched_)
    if (!model_.members()[each.member].component->is_on(LocalState(state, slots_[each.member], environment), each.row)) {
      state.idle[static_cast<std::size_t>(each.multiplier)] = Idle::switched_off;
      state.multiplier[each.multiplier] = 0;
    }
}

void System::calc_crossings(const State& state, const Environment& environment, Eigen::Ref<VectorX> values) const {
  for (std::size_t k = 0; k < crossings_.size();) {
    const std::size_t member = crossings_[k].member;
    std::size_t end = k;
    while (end < crossings_.size() && crossings_[end].member == member) ++end;
    const auto count = static_cast<Eigen::Index>(end - k);
    model_.members()[member].component->calc_crossings(LocalState(state, slots_[member], environment),
                                                       values.segment(static_cast<Eigen::Index>(k), count));
    k = end;
  }
}

}  // namespace bielle::mechanism

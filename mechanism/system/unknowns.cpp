#include "mechanism/system/unknowns.hpp"

#include <algorithm>
#include <functional>
#include <stdexcept>

#include <fmt/format.h>

namespace bielle::mechanism {
namespace {

constexpr const char* axis_names[] = {"x", "y", "z"};

/// Returns the units of a scalar's equation if its component declares none.
std::string usual_equation_units(Kind kind, const Declaration::Scalar& scalar) {
  if (kind == Kind::amplitude) return scalar.units == "m" ? "N" : scalar.units == "rad" ? "N m" : "N/sqrt(kg)";
  if (kind == Kind::first_order) return scalar.algebraic ? scalar.units : scalar.units + "/s";
  const std::string length = scalar.units == "N" ? "m" : "rad";
  return scalar.kind == ConstraintKind::holonomic ? length : length + "/s";
}

}  // namespace

std::string describe(const Member& member) {
  // A member that is neither element nor joint is named by its type.
  const Section section = member.entry.section;
  return fmt::format("{} '{}'",
                     section == Section::elements ? "element"
                     : section == Section::joints ? "joint"
                                                  : member.component->type(),
                     member.component->name());
}

Unknowns::Unknowns(const Model& model, const NodeKinematics& kinematics)
    : model_(model), kinematics_(kinematics), activities_(model), nodes_(kinematics.unknowns()) {
  slots_.reserve(model.members().size());  // references point to these elements
  member_index_.reserve(model.members().size());
}

void Unknowns::append(Kind kind, const std::vector<Declaration::Scalar>& declared, std::vector<Scalar>& scalars) {
  const auto member = static_cast<int>(slots_.size());
  const auto word = [&](const std::string& text) { return &*words_.insert(text).first; };
  for (const Declaration::Scalar& each : declared)
    scalars.push_back({each.start, each.scale, word(each.name),
                       word(each.equation_units.empty() ? usual_equation_units(kind, each) : each.equation_units),
                       member, each.kind, each.algebraic, each.holdable, each.yields});
}

void Unknowns::add(const Declaration& declaration) {
  const std::size_t member = slots_.size();
  member_index_[model_.members()[member].component.get()] = member;
  for (const Component* other : declaration.references) references_.emplace_back(member, other);
  auto& [amplitudes, first_orders, multipliers] = added_;
  Slots slots;
  slots.nodes = declaration.nodes;
  slots.amplitude_begin = static_cast<int>(amplitudes.size());
  slots.amplitudes = static_cast<int>(declaration.amplitudes.size());
  slots.first_order_begin = static_cast<int>(first_orders.size());
  slots.first_orders = static_cast<int>(declaration.first_order.size());
  slots.multiplier_begin = static_cast<int>(multipliers.size());
  slots.multipliers = static_cast<int>(declaration.multipliers.size());
  slots.memory_begin = static_cast<int>(start_memory_.size());
  slots.memories = static_cast<int>(declaration.memory.size());
  append(Kind::amplitude, declaration.amplitudes, amplitudes);
  append(Kind::first_order, declaration.first_order, first_orders);
  append(Kind::multiplier, declaration.multipliers, multipliers);
  start_memory_.insert(start_memory_.end(), declaration.memory.begin(), declaration.memory.end());
  slots_.push_back(std::move(slots));
}

void Unknowns::complete() {
  resolve_references();
  const auto count = [&](std::size_t kind) { return static_cast<int>(added_[kind].size()); };
  amplitudes_ = count(0);
  first_orders_ = count(1);
  multipliers_ = count(2);
  for (int k = 0; k < first_orders_; ++k)
    if (added_[1][static_cast<std::size_t>(k)].algebraic) algebraic_.push_back(k);
  for (int k = 0; k < first_orders_; ++k)
    if (added_[1][static_cast<std::size_t>(k)].holdable) holdable_.push_back(k);
  scalars_.reserve(static_cast<std::size_t>(amplitudes_ + first_orders_ + multipliers_));
  for (std::vector<Scalar>& scalars : added_) {
    scalars_.insert(scalars_.end(), scalars.begin(), scalars.end());
    scalars = {};
  }
  set_kinds();
  for (const Slots& slots : slots_) largest_local_ = std::max(largest_local_, slots.size());
}

void Unknowns::set_kinds() {
  kinds_.assign(static_cast<std::size_t>(size()), Kind::multiplier);
  for (int i = 0; i < static_cast<int>(model_.nodes().size()); ++i) {
    const NodeFreedom& f = kinematics_.freedom(i);
    for (int c = 0; c < f.count; ++c)
      kinds_[static_cast<std::size_t>(f.begin + c)] =
          f.G.col(c).head<3>().squaredNorm() > 0 ? Kind::translation : Kind::rotation;
  }
  const auto fill = [&](int begin, int count, Kind kind) { std::fill_n(kinds_.begin() + begin, count, kind); };
  fill(first_amplitude(), amplitudes_, Kind::amplitude);
  fill(first_first_order(), first_orders_, Kind::first_order);
}

void Unknowns::resolve_references() {
  enum class Progress : char { untouched, under_way, done };
  std::vector<Progress> progress(slots_.size(), Progress::untouched);
  const auto less = [](const auto& reference, std::size_t member) { return reference.first < member; };
  const std::function<void(std::size_t)> resolve = [&](std::size_t m) {
    progress[m] = Progress::under_way;
    for (auto each = std::lower_bound(references_.begin(), references_.end(), m, less);
         each != references_.end() && each->first == m; ++each) {
      const auto found = member_index_.find(each->second);
      if (found == member_index_.end())
        throw std::logic_error("component '" + each->second->name() + "' is referred to but not part of the model");
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
  for (const auto& reference : references_)
    if (progress[reference.first] == Progress::untouched) resolve(reference.first);
  references_ = {};
}

void Unknowns::carry_axes(const std::vector<bool>& of_multiplier) {
  for (Slots& slots : slots_) {
    const auto begin = of_multiplier.begin() + slots.multiplier_begin, end = begin + slots.multipliers;
    slots.carried_axes = std::find(begin, end, true) != end;
  }
}

std::string Unknowns::name(int unknown) const {
  if (unknown >= nodes_)
    return fmt::format("{} of {}", *scalar(unknown).name,
                       describe(model_.members()[static_cast<std::size_t>(scalar(unknown).member)]));
  const int node = kinematics_.node_of(unknown);
  const NodeFreedom& f = kinematics_.freedom(node);
  Eigen::Index direction = 0;
  f.G.col(unknown - f.begin).cwiseAbs().maxCoeff(&direction);
  return fmt::format("{} {} of node '{}'", direction < 3 ? "displacement" : "rotation", axis_names[direction % 3],
                     model_.node(node).name);
}

std::string Unknowns::equation_name(int equation) const {
  switch (kind(equation)) {
    case Kind::translation:
    case Kind::rotation: {
      std::string name = this->name(equation);
      const bool force = kind(equation) == Kind::translation;
      name.replace(0, name.find(' '), force ? "force" : "moment");
      name.replace(name.find(" of "), 4, " at ");
      return name;
    }
    case Kind::amplitude:
    case Kind::first_order:
      return "equation of " + name(equation);
    case Kind::multiplier:
      break;
  }
  return "constraint " + name(equation);
}

std::string Unknowns::equation_units(int equation) const {
  if (kind(equation) == Kind::translation) return "N";
  if (kind(equation) == Kind::rotation) return "N m";
  return *scalar(equation).equation_units;
}

void Unknowns::start(State& state) const {
  const auto values = [&](int begin, int count) {
    VectorX result(count);
    for (int k = 0; k < count; ++k) result[k] = scalar(begin + k).start;
    return result;
  };
  state.amplitude = values(first_amplitude(), amplitudes_);
  state.amplitude_rate = VectorX::Zero(amplitudes_);
  state.amplitude_acceleration = VectorX::Zero(amplitudes_);
  state.first_order = values(first_first_order(), first_orders_);
  state.first_order_rate = VectorX::Zero(first_orders_);
  state.multiplier = values(first_multiplier(), multipliers_);
  state.memory = Eigen::Map<const VectorX>(start_memory_.data(), static_cast<Eigen::Index>(start_memory_.size()));
}

}  // namespace bielle::mechanism

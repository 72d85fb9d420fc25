#include "mechanism/system/residual_assembly.hpp"

#include <algorithm>
#include <utility>

namespace bielle::mechanism {

/// Largest contributions of any component, by direction, and largest contributions of components to equations of
/// others.
struct ResidualAssembly::Largest {
  Vector3 force = Vector3::Zero(), moment = Vector3::Zero();
  ResidualScale of_references;
};

/// The global vectors to which the parts of the members are added.
class ResidualAssembly::Sums {
 public:
  Sums(const ResidualAssembly& assembly, VectorX& forces, Eigen::Ref<VectorX>& r)
      : assembly_(assembly),
        forces_(forces),
        r_(r),
        force_rows_(assembly.force_rows_.data()),
        amplitude_row_(assembly.unknowns_.first_amplitude()),
        first_order_row_(assembly.unknowns_.first_first_order()),
        multiplier_row_(assembly.unknowns_.first_multiplier()) {}

  /// Adds a member's part. @param local  its part; set to zero by this function
  void add(const Acting& acting, const Slots& slots, double* local) {
    double *part = local, *const forces = forces_.data();
    const int* force_row = force_rows_ + acting.nodes_begin;
    for (const int* const end = force_row + slots.nodes.size(); force_row != end; ++force_row, part += 6) {
      // Three entries are read at a time, as components write them: a read that spans two writes would have to wait for
      // both.
      const Vector3 force = Eigen::Map<const Vector3>(part), moment = Eigen::Map<const Vector3>(part + 3);
      std::fill_n(part, 6, 0.0);
      Eigen::Map<Vector3>(forces + *force_row) += force;
      Eigen::Map<Vector3>(forces + *force_row + 3) += moment;
      largest.force = largest.force.cwiseMax(force.cwiseAbs());
      largest.moment = largest.moment.cwiseMax(moment.cwiseAbs());
    }
    const auto scalars = [&, r = r_.data()](int count, int row) {
      for (int k = 0; k < count; ++k) r[row + k] += std::exchange(part[k], 0);
      part += count;
    };
    scalars(slots.amplitudes, amplitude_row_ + slots.amplitude_begin);
    scalars(slots.first_orders, first_order_row_ + slots.first_order_begin);
    scalars(slots.multipliers, multiplier_row_ + slots.multiplier_begin);
    if (slots.referenced == 0) return;
    assembly_.add_referenced(slots, local, forces_, r_, largest.of_references);
    std::fill_n(part, slots.referenced, 0.0);
  }

  Largest largest;

 private:
  const ResidualAssembly& assembly_;
  VectorX& forces_;
  Eigen::Ref<VectorX>& r_;
  const int* force_rows_;
  int amplitude_row_, first_order_row_, multiplier_row_;
};

void ResidualAssembly::add(const Declaration& declaration) {
  const std::size_t member = members_++;
  if (declaration.passive) return;
  small_.push_back({member, force_rows_.size()});
  for (const int node : declaration.nodes) force_rows_.push_back(kinematics_.force_row(node));
}

void ResidualAssembly::complete() {
  costly_.clear();
  const auto before = [](const Acting& acting, std::size_t member) { return acting.member < member; };
  for (const std::size_t member : work_.costly())
    costly_.push_back(*std::lower_bound(small_.begin(), small_.end(), member, before));
  std::erase_if(small_, [&](const Acting& acting) { return work_.is_costly(acting.member); });
}

/// @param local  zero on entry; then the member's part, or zero if the component throws
void ResidualAssembly::evaluate(std::size_t member, const State& state, const Environment& environment,
                                Eigen::Ref<VectorX> local) const {
  if (!unknowns_.is_active(state, member)) {
    hold_first_order(LocalState(state, unknowns_.slots()[member], environment), local);
    return;
  }
  try {
    model_.members()[member].component->add_residual(LocalState(state, unknowns_.slots()[member], environment), local);
  } catch (...) {
    local.setZero();
    throw;
  }
}

/// Adds the equations of the first-order unknowns of a released member, which keep their values. (Those of algebraic
/// ones, whose rates are zero, are 0 = 0: their increments are zero by the tangent.)
void ResidualAssembly::hold_first_order(const LocalState& state, Eigen::Ref<VectorX> local) {
  const Slots& slots = state.slots();
  if (slots.first_orders == 0 || state.environment().statics) return;
  local.segment(slots.first_order_row(), slots.first_orders) = state.first_order_rate();
}

void ResidualAssembly::add_small(const State& state, const Environment& environment, Sums& sums) const {
  // The buffer is zero except while it holds a component's part. (Components do not evaluate systems.)
  thread_local VectorX buffer;
  if (buffer.size() < unknowns_.largest_local()) buffer.setZero(unknowns_.largest_local());
  double* const local = buffer.data();
  for (const Acting& acting : small_) {
    const Slots& slots = unknowns_.slots()[acting.member];
    evaluate(acting.member, state, environment, Eigen::Map<VectorX>(local, slots.size()));
    sums.add(acting, slots, local);
  }
}

void ResidualAssembly::node_forces(const State& state, const Environment& environment, VectorX& forces,
                                   Eigen::Ref<VectorX> r, ResidualScale* scale) const {
  forces.setZero(kinematics_.force_rows());
  Sums sums(*this, forces, r);
  if (costly_.empty()) {
    add_small(state, environment, sums);
  } else {
    thread_local VectorX costly_parts;
    costly_parts.setZero(work_.row_begin(costly_.size()));
    VectorX& parts = costly_parts;  // all threads use the buffer of the calling thread
    const auto evaluate_costly = [&](std::size_t k) {
      evaluate(costly_[k].member, state, environment,
               parts.segment(work_.row_begin(k), work_.row_begin(k + 1) - work_.row_begin(k)));
    };
    work_.share(evaluate_costly, [&] { add_small(state, environment, sums); });
    for (std::size_t k = 0; k < costly_.size(); ++k)
      sums.add(costly_[k], unknowns_.slots()[costly_[k].member], parts.data() + work_.row_begin(k));
  }
  if (scale) set_scale(sums.largest, r, *scale);
  kinematics_.carry_forces(state.nodes, forces);
}

void ResidualAssembly::set_scale(const Largest& largest, const Eigen::Ref<VectorX>& r, ResidualScale& scale) const {
  const ResidualScale& of_references = largest.of_references;
  scale[Kind::translation] = std::max(largest.force.maxCoeff(), of_references[Kind::translation]);
  scale[Kind::rotation] = std::max(largest.moment.maxCoeff(), of_references[Kind::rotation]);
  // Each of the other rows contains the contribution of its own component, to which other components may have added.
  const auto of_rows = [&](Kind kind, int begin, int count) {
    const double all = count > 0 ? r.segment(begin, count).lpNorm<Eigen::Infinity>() : 0.0;
    scale[kind] = std::max(all, of_references[kind]);
  };
  of_rows(Kind::amplitude, unknowns_.first_amplitude(), unknowns_.amplitudes());
  of_rows(Kind::first_order, unknowns_.first_first_order(), unknowns_.first_orders());
  of_rows(Kind::multiplier, unknowns_.first_multiplier(), unknowns_.multipliers());
}

/// Adds the contributions of a component to equations of those that it refers to, recursively.
/// @param slots,part  slots of the referring component, and its local vector
void ResidualAssembly::add_referenced(const Slots& slots, const double* part, VectorX& forces, Eigen::Ref<VectorX> r,
                                      ResidualScale& scale) const {
  for (std::size_t k = 0; k < slots.references.size(); ++k) {
    const Slots& other = *slots.references[k];
    const double* const theirs = part + slots.reference_rows[k];
    for (std::size_t i = 0; i < other.nodes.size(); ++i) {
      const Eigen::Map<const Vector6> local(theirs + 6 * i);
      forces.segment<6>(kinematics_.force_row(other.nodes[i])) += local;
      scale[Kind::translation] = std::max(scale[Kind::translation], local.head<3>().lpNorm<Eigen::Infinity>());
      scale[Kind::rotation] = std::max(scale[Kind::rotation], local.tail<3>().lpNorm<Eigen::Infinity>());
    }
    const auto add_scalars = [&](Kind kind, int row, int begin, int count) {
      if (count == 0) return;
      const Eigen::Map<const VectorX> local(theirs + row, count);
      r.segment(begin, count) += local;
      scale[kind] = std::max(scale[kind], local.lpNorm<Eigen::Infinity>());
    };
    add_scalars(Kind::amplitude, other.amplitude_row(), unknowns_.first_amplitude() + other.amplitude_begin,
                other.amplitudes);
    add_scalars(Kind::first_order, other.first_order_row(), unknowns_.first_first_order() + other.first_order_begin,
                other.first_orders);
    add_referenced(other, theirs, forces, r, scale);
  }
}

void ResidualAssembly::add_all(const State& state, const Environment& environment, Eigen::Ref<VectorX> r,
                               ResidualScale* scale) const {
  thread_local VectorX forces;
  r.setZero();
  if (scale) *scale = {};
  node_forces(state, environment, forces, r, scale);
  kinematics_.reduce_forces(forces, r.head(kinematics_.unknowns()));
}

void ResidualAssembly::set_part(std::size_t member, const State& state, const Environment& environment,
                                Eigen::Ref<VectorX> r) const {
  thread_local VectorX forces, local;
  r.setZero();
  const std::vector<Acting>& acting = work_.is_costly(member) ? costly_ : small_;
  const auto found =
      std::find_if(acting.begin(), acting.end(), [&](const Acting& each) { return each.member == member; });
  if (found == acting.end()) return;  // the member adds to no equation
  forces.setZero(kinematics_.force_rows());
  local.setZero(unknowns_.slots()[member].size());
  evaluate(member, state, environment, local);
  Sums(*this, forces, r).add(*found, unknowns_.slots()[member], local.data());
  kinematics_.carry_forces(state.nodes, forces);
  kinematics_.reduce_forces(forces, r.head(kinematics_.unknowns()));
}

double ResidualAssembly::support_power(const State& state, const Environment& environment) const {
  thread_local VectorX forces, scalars;
  scalars.setZero(unknowns_.size());
  node_forces(state, environment, forces, scalars, nullptr);
  return kinematics_.support_power(state.nodes, forces);
}

}  // namespace bielle::mechanism

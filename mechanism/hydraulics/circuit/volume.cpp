#include "mechanism/hydraulics/circuit/volume.hpp"

#include <fmt/format.h>

#include "mechanism/model/description.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

constexpr double typical_pressure = 1e5;  // [Pa]: much smaller values do not matter

}  // namespace

Volume::Volume(std::string name, const Fluid& fluid, double volume, std::optional<double> pressure, double compliance,
               std::string type)
    : PressureNode(std::move(type), std::move(name), fluid, {pressure_row, fluid_row, space_row}),
      volume_(volume),
      start_(pressure),
      compliance_(compliance),
      drawn_(volume) {}

double Volume::room_at(double pressure) const {
  double space = compliance_ * (pressure - fluid().ambient);
  for (const auto& room : rooms_) space += room(pressure);
  return space;
}

double Volume::drawn() const { return drawn_ + room_at(start_.value_or(fluid().ambient)); }

void Volume::declare(Declaration& declaration) const {
  // A pressure that follows from the load is not known yet; this is marked by negative values of fluid and pressure.
  const double drawn = this->drawn(), begin = start_ ? fluid_at(*start_, drawn) : -drawn;
  Declaration::Scalar fluid_content{"fluid", "m^3", begin};
  fluid_content.scale = drawn * typical_pressure / fluid().bulk_modulus;
  fluid_content.equation_units = "m^3/s";
  Declaration::Scalar pressure{"pressure", "Pa", start_.value_or(-1)};
  pressure.scale = typical_pressure;
  pressure.algebraic = true;
  Declaration::Scalar space{"space", "m^3", drawn};
  space.scale = fluid_content.scale;
  space.algebraic = true;
  declaration.first_order = {fluid_content, pressure, space};
  declaration.stiffness = declaration.damping = true;
  declaration.starts_by_state = true;
  declaration.memory = {0};  // tells whether the volume has begun
}

double Volume::pressure_by_state(const LocalState& own) const {
  const double W = own.first_order()[fluid_row], V = own.first_order()[space_row];
  if (!(W > 0))
    throw ComputationError(
        fmt::format("t = {:.6g} s: the volume '{}' is empty: more is drawn from it than it holds", own.time(), name()));
  if (!(V > 0))
    throw ComputationError(fmt::format(
        "t = {:.6g} s: the volume '{}' has {:.3g} m^3 left: what opens into it leaves it no space (a piston "
        "beyond its stroke?)",
        own.time(), name(), V));
  return fluid().pressure_of(V / W, pressure(own));
}

PressureNode::Exchange Volume::exchange(const LocalState& own) const {
  const Fluid::Content content = fluid().content(pressure(own));
  Exchange exchange;
  exchange.factor = content.f;
  exchange.by[pressure_row] = content.f_p;
  return exchange;
}

double Volume::net_flow(const LocalState& own) const {
  return own.first_order_rate()[fluid_row] / exchange(own).factor;
}

void Volume::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  const double p = pressure(state);
  r[fluid_row] += state.first_order_rate()[fluid_row];
  if (!waits(state)) r[pressure_row] += p - pressure_by_state(state);
  r[space_row] += space(state) - volume_ - compliance_ * (p - fluid().ambient);
}

void Volume::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (tangent.wants_C) tangent.C.dense()(fluid_row, fluid_row) += 1;
  if (!tangent.wants_K) return;
  auto K = tangent.K.dense();
  if (!balances(state)) K(fluid_row, fluid_row) += 1;  // the fluid is constant
  if (!waits(state)) {
    const double W = state.first_order()[fluid_row], V = state.first_order()[space_row];
    const double p_v = 1 / fluid().ratio(pressure_by_state(state)).v_p;
    K(pressure_row, pressure_row) += 1;
    K(pressure_row, fluid_row) += p_v * V / (W * W);
    K(pressure_row, space_row) -= p_v / W;
  }
  K(space_row, space_row) += 1;
  K(space_row, pressure_row) -= compliance_;
}

// The space is computed for the present pressure, and its pressure-dependent part is then replaced by that at the given
// one. Pressure and space follow from their equations when these are solved.
void Volume::add_start_values(const LocalState& state, Eigen::Ref<VectorX> change) const {
  if (!start_ || state.memory()[0] != 0) return;
  const double at_start = space(state) - room_at(pressure(state)) + room_at(*start_);
  change[fluid_row] += fluid_at(*start_, at_start) - state.first_order()[fluid_row];
}

void Volume::accept(const LocalState& state, Eigen::Ref<VectorX> memory) const {
  if (!waits(state)) memory[0] = 1;
}

void Volume::add_energy(const LocalState& state, Energy& energy) const {
  if (waits(state)) return;
  const double p = pressure(state), away = p - fluid().ambient;
  energy.elastic += state.first_order()[fluid_row] * fluid().stored(p) + 0.5 * compliance_ * away * away;
}

std::vector<OutputField> Volume::output_fields() const {
  const bool mass = fluid().conserves == Fluid::Conserves::mass;
  return {{"pressure", {}, "Pa", fluid().ambient == 0 ? "gauge" : "absolute"},
          {"flow", {}, "m^3/s", mass ? "net flow in, at the reference pressure" : "net flow in, at its pressure"},
          {"volume", {}, "m^3", "space that the fluid fills"},
          {"fluid", {}, "m^3", "the fluid in it, as its volume at 101325 Pa"}};
}

void Volume::write_output(const LocalState& state, double* values) const {
  values[0] = pressure(state);
  values[1] = net_flow(state);
  values[2] = space(state);
  values[3] = state.first_order()[fluid_row];
}

void Volume::describe(const LocalState& state, Description& description) const {
  description.add(fmt::format("{:.6g} m^3", space(state)));
  description.add(start_ ? fmt::format("{:.6g} Pa at the start", *start_)
                         : "its pressure at the start follows from the load");
  if (compliance_ > 0) description.add(fmt::format("walls give {:.6g} m^3/Pa", compliance_));
}

}  // namespace bielle::mechanism

#include "mechanism/joints/tyres/tyre.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "mechanism/drawing/drawing.hpp"
#include "mechanism/model/description.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

/// A force with the velocity along which it acts, as a term of the residual: -force * w.
template <int order>
struct PatchTerm {
  TyreNumber TyreForces::*force;
  PairMeasureOf<order> ContactPatch<order>::*along;
  double sign;
};

template <int order>
constexpr PatchTerm<order> patch_terms[] = {{&TyreForces::N, &ContactPatch<order>::deflection, 1},
                                            {&TyreForces::F_x, &ContactPatch<order>::longitudinal, -1},
                                            {&TyreForces::F_y, &ContactPatch<order>::lateral, -1},
                                            {&TyreForces::along_roll, &ContactPatch<order>::roll, -1},
                                            {&TyreForces::moment, &ContactPatch<order>::spin, -1}};

/// The variables that are velocities of the patch.
template <int order>
constexpr std::pair<TyreVariable, PairMeasureOf<order> ContactPatch<order>::*> patch_rates[] = {
    {tyre_e_rate, &ContactPatch<order>::deflection},
    {tyre_v_x, &ContactPatch<order>::longitudinal},
    {tyre_v_y, &ContactPatch<order>::lateral},
    {tyre_V_r, &ContactPatch<order>::roll},
    {tyre_spin, &ContactPatch<order>::spin}};

}  // namespace

Tyre::Tyre(JointFrames frames, const std::string& name, double radius, SpringTyreLaw law,
           std::shared_ptr<const RoadProfile> road, const Model& model)
    : Joint("tyre", name, std::move(frames),
            {{"x", JointCoordinate::Kind::displacement, 0},
             {"y", JointCoordinate::Kind::displacement, 1},
             {"z", JointCoordinate::Kind::displacement, 2}},
            model),
      radius_(radius),
      law_(std::move(law)),
      road_(std::move(road)) {}

void Tyre::declare(Declaration& declaration) const {
  Joint::declare(declaration);
  declaration.stiffness = declaration.damping = true;
  declaration.kinks = true;
  // The memory tells whether the tyre touches (NaN before the first motion). The last entry is the time of the joint's
  // memory.
  declaration.memory.insert(declaration.memory.end() - 1, std::numeric_limits<double>::quiet_NaN());
  declaration.event_functions = {{"touches the road", EventFunction::Direction::rising},
                                 {"leaves the road", EventFunction::Direction::falling}};
  if (!law_.slip) return;
  for (const Eigen::Index k : {0, 1}) {
    Declaration::Scalar u{k == 0 ? "longitudinal deflection" : "lateral deflection", "m"};
    u.scale = law_.slip->relaxation[k];
    u.equation_units = "m/s";
    declaration.first_order.push_back(std::move(u));
  }
}

PairSlope Tyre::deflection(const LocalState& state) const {
  return calc_deflection(state.node(0), state.node(1), frames(), radius_, road_.get());
}

bool Tyre::touches(const LocalState& state) const {
  const auto memory = state.memory();
  const double known = memory[memory.size() - 2];
  // A tyre that just touches has its stiffness, because nothing else would hold its wheel in statics.
  if (state.environment().statics || std::isnan(known)) return deflection(state).value >= 0;
  return known > 0;
}

TyreValues Tyre::unknowns_alone(const LocalState& state) const {
  TyreValues z = TyreValues::Zero();
  if (law_.slip) z.segment<2>(tyre_u_x) = state.first_order();
  return z;
}

template <int order>
Tyre::Contact<order> Tyre::calc_contact(const LocalState& state) const {
  Contact<order> contact;
  try {
    contact.patch = calc_patch<order>(state.node(0), state.node(1), frames(), radius_, road_.get());
  } catch (const ComputationError& error) {
    throw ComputationError(fmt::format("t = {:.6g} s: tyre '{}': {}", state.time(), name(), error.what()));
  }
  const Vector12 v = pair_rate(state.node(0), state.node(1));
  TyreValues z = unknowns_alone(state);
  z[tyre_e] = contact.patch.deflection.value;
  z[tyre_c] = contact.patch.camber.value;
  for (const auto& [variable, measure] : patch_rates<order>) z[variable] = (contact.patch.*measure).rate(v);
  if constexpr (order == 2) {
    contact.by_position.setZero();
    contact.by_rate.setZero();
    contact.by_position.row(tyre_e).template head<12>() = contact.patch.deflection.gradient.transpose();
    contact.by_position.row(tyre_c).template head<12>() = contact.patch.camber.gradient.transpose();
    for (const auto& [variable, measure] : patch_rates<order>) {
      const PairMeasure& w = contact.patch.*measure;
      contact.by_position.row(variable).template head<12>() = v.transpose() * w.second;
      contact.by_rate.row(variable).template head<12>() = w.gradient.transpose();
    }
    contact.by_position(tyre_u_x, unknowns_row) = contact.by_position(tyre_u_y, unknowns_row + 1) = 1;
  }
  contact.forces = law_.calc(z, true);
  return contact;
}

template Tyre::Contact<2> Tyre::calc_contact(const LocalState&) const;

TyreForces Tyre::forces(const LocalState& state) const {
  return touches(state) ? calc_contact<1>(state).forces : law_.calc(unknowns_alone(state), false);
}

// Time does not advance in a static analysis, and the tread therefore keeps its deflections.
void Tyre::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  TyreForces acting;
  if (touches(state)) {
    const Contact<1> contact = calc_contact<1>(state);
    acting = contact.forces;
    for (const auto& [force, along, sign] : patch_terms<1>)
      r.head<12>() += sign * (acting.*force).value * (contact.patch.*along).gradient;
  } else {
    acting = law_.calc(unknowns_alone(state), false);
  }
  if (!law_.slip) return;
  r.segment<2>(unknowns_row) += state.first_order_rate();
  if (!state.environment().statics)
    r.segment<2>(unknowns_row) -= Eigen::Vector2d(acting.u_x_rate.value, acting.u_y_rate.value);
}

void Tyre::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (!tangent.wants_K && !tangent.wants_C) return;
  const int size = law_.slip ? 14 : 12;
  const bool at_rest = state.environment().statics, touching = touches(state);
  Contact<2> contact;
  if (touching) {
    contact = calc_contact<2>(state);
  } else {
    contact.forces = law_.calc(unknowns_alone(state), false);
    contact.by_position.setZero();
    contact.by_rate.setZero();
    contact.by_position(tyre_u_x, unknowns_row) = contact.by_position(tyre_u_y, unknowns_row + 1) = 1;
  }
  const TyreForces& forces = contact.forces;
  Eigen::Matrix<double, 14, 14> K = Eigen::Matrix<double, 14, 14>::Zero(), C = K;
  if (touching)
    for (const auto& [force, along, sign] : patch_terms<2>) {
      const PairMeasure& w = contact.patch.*along;
      const TyreNumber& value = forces.*force;
      K.topLeftCorner<12, 12>() += sign * value.value * w.second;
      K.topRows<12>() += sign * w.gradient * (value.gradient.transpose() * contact.by_position);
      C.topRows<12>() += sign * w.gradient * (value.gradient.transpose() * contact.by_rate);
    }
  if (law_.slip) {
    int row = unknowns_row;
    for (const TyreNumber* rate : {&forces.u_x_rate, &forces.u_y_rate}) {
      C(row, row) += 1;
      if (at_rest) {
        K(row, row) += 1;
      } else {
        K.row(row) -= rate->gradient.transpose() * contact.by_position;
        C.row(row) -= rate->gradient.transpose() * contact.by_rate;
      }
      ++row;
    }
  }
  if (tangent.wants_K) tangent.K.dense() += K.topLeftCorner(size, size);
  if (tangent.wants_C) tangent.C.dense() += C.topLeftCorner(size, size);
}

void Tyre::add_energy(const LocalState& state, Energy& energy) const {
  const TyreForces acting = forces(state);
  energy.elastic += acting.elastic;
  energy.dissipation += acting.dissipation;
}

void Tyre::calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const {
  values.setConstant(deflection(state).value);
}

bool Tyre::leaves_branch(const LocalState& state) const { return touches(state) && deflection(state).value < 0; }

void Tyre::begin_branch(const LocalState& state, std::span<const int> /*crossed*/, Eigen::Ref<VectorX> memory) const {
  const PairSlope e = deflection(state);
  memory[memory.size() - 2] =
      e.value > 0 || (e.value == 0 && e.rate(pair_rate(state.node(0), state.node(1))) >= 0) ? 1 : 0;
}

void Tyre::accept(const LocalState& state, Eigen::Ref<VectorX> memory) const {
  Joint::accept(state, memory);
  if (touches(state) && deflection(state).value >= radius_)
    throw ComputationError(
        fmt::format("t = {:.6g} s: the middle of the wheel of tyre '{}' is below the road: the tyre is too soft or the "
                    "road too steep",
                    state.time(), name()));
}

std::vector<OutputField> Tyre::output_fields() const {
  std::vector<OutputField> fields = Joint::output_fields();
  fields.push_back({"deflection", {}, "m", "how far the tyre is pressed in, negative above the road"});
  fields.push_back({"normal_force", {}, "N", "of the road on the tyre"});
  fields.push_back({"tyre_force", {2}, "N", "on the wheel, along its way and across it"});
  fields.push_back({"slip", {2}, "-", "velocities of the contact along and across, over the rolling speed"});
  fields.push_back({"aligning_moment", {}, "N m", "on the wheel, about the normal of the road"});
  fields.push_back({"camber", {}, "rad", "angle of the wheel's axis with the road, positive if it points up"});
  return fields;
}

void Tyre::write_output(const LocalState& state, double* values) const {
  Joint::write_output(state, values);
  double* own = values + 2 * coordinates().size() + 12;
  Eigen::Map<Eigen::Matrix<double, 8, 1>> written(own);
  written.setZero();
  written[0] = deflection(state).value;
  if (!touches(state)) return;
  const Contact<1> contact = calc_contact<1>(state);
  const TyreForces& acting = contact.forces;
  written.tail<7>() << acting.N.value, acting.F_x.value, acting.F_y.value, acting.slip, acting.moment.value,
      std::asin(std::clamp(contact.patch.camber.value, -1.0, 1.0));
}

void Tyre::describe(const LocalState& state, Description& description) const {
  Joint::describe(state, description);
  const Vector3 axis = state.node(1).R * frames().on_second.R.col(2);
  description.add(fmt::format("radius {:.6g} m, axis {}", radius_, format_vector(axis)));
  const double pressed = deflection(state).value;
  description.add(pressed > 0 ? fmt::format("pressed in by {:.6g} m", pressed)
                              : fmt::format("{:.6g} m above the road", -pressed));
  for (const std::string& line : law_.describe()) description.add_line(line);
}

void Tyre::draw(Drawing& drawing) const {
  if (!road_) drawing.add({.shape = "plane", .places = {{frames().first, frames().on_first}}});
  drawing.add({.shape = "tyre", .places = {{frames().second, frames().on_second}}, .values = {{"radius", radius_}}});
  if (road_)
    drawing.add({.shape = "curve",
                 .places = {{frames().first, frames().on_first}},
                 .values = {{"points", road_->line()}, {"closed", false}}});
}

}  // namespace bielle::mechanism

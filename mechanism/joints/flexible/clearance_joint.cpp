#include "mechanism/joints/flexible/clearance_joint.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "mechanism/model/description.hpp"

namespace bielle::mechanism {

ClearanceJoint::ClearanceJoint(std::string type, std::string name, JointFrames frames,
                               std::vector<JointCoordinate> coordinates, std::vector<Place> places,
                               std::optional<FrictionLaw> friction, const Model& model)
    : Joint(std::move(type), std::move(name), std::move(frames), std::move(coordinates), model),
      places_(std::move(places)),
      friction_(friction) {}

void ClearanceJoint::declare(Declaration& declaration) const {
  Joint::declare(declaration);
  declaration.stiffness = declaration.damping = true;
  declaration.kinks = true;                       // the force has a kink at zero
  const double time = declaration.memory.back();  // the time is the last entry
  declaration.memory.pop_back();
  for (const Place& place : places_) {
    declaration.event_functions.push_back({fmt::format("contact {}", place.name)});
    declaration.memory.insert(declaration.memory.end(),
                              {0, place.law.damping_after(place.law.slowest_impact), 0, 0, 0});
  }
  declaration.memory.push_back(time);
}

PairRotation ClearanceJoint::rotation(const LocalState& state) const {
  return {state.node(0), state.node(1), frames().on_first.R, frames().on_second.R};
}

ClearanceContact ClearanceJoint::contact(std::size_t k, const LocalState& state, const PairRotation& rotation,
                                         bool second) const {
  return {state.node(0), state.node(1), frames(), places_[k].place, rotation, second};
}

NormalLaw::Force ClearanceJoint::push(std::size_t k, const LocalState& state, const ClearanceContact& contact) const {
  const double rate = contact.p().rate(pair_rate(state.node(0), state.node(1)));
  return places_[k].law.force(contact.p().value, rate, state.memory()[memory_of(k) + 1]);
}

BristleStep ClearanceJoint::bristle(std::size_t k, const LocalState& state, const ClearanceContact& contact,
                                    const Vector3& slip) const {
  const auto memory = state.memory();
  const double before = memory[memory.size() - 1];
  const double h = std::isnan(before) ? 0 : std::max(0.0, state.time() - before);
  return {*friction_, contact.sliding(bristle_before(k, state)), slip, h};
}

void ClearanceJoint::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  const PairRotation turned = rotation(state);
  const Vector12 v = pair_rate(state.node(0), state.node(1));
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const ClearanceContact c = contact(k, state, turned, false);
    const double N = push(k, state, c).F;
    if (N == 0) continue;
    r.head<12>() += N * c.p().gradient;
    if (!rubs(state)) continue;
    const Vector3 slip = c.sliding(c.Y() * v);
    const Vector3 force =
        has_bristles() ? bristle(k, state, c, slip).force : Vector3(friction_->sliding(slip.norm()).h * slip);
    r.head<12>() += N * (c.Y().transpose() * force);
  }
}

// With slip = P w, P = I - n n^T, and the friction force F = N f, Y^T F is its part of the residual; f = h(|slip|)
// slip, or a function of the bristle P z_0 and slip:
//   dN = N_p dp + N_v d(pdot),   dF = f dN + N [df/d(slip) d(slip) + df/d(P z_0) turned_sliding(z_0) dz],
//   d(slip) = P (Y dv + [v . dY]) + turned_sliding(w) dz,   d(Y^T F) = Y^T dF + Z(F) dz
void ClearanceJoint::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (!tangent.wants_K && !tangent.wants_C) return;
  using Rows = ClearanceContact::Rows;
  const PairRotation turned = rotation(state);
  const Vector12 v = pair_rate(state.node(0), state.node(1));
  Matrix12 K = Matrix12::Zero(), C = Matrix12::Zero();
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const ClearanceContact c = contact(k, state, turned, true);
    const NormalLaw::Force push = this->push(k, state, c);
    if (push.F == 0) continue;
    const Vector12& g = c.p().gradient;
    const Vector12 by_position = push.by_p * g + push.by_rate * (c.p().second.transpose() * v);
    Vector12 along = g;  // derivative of N
    K += push.F * c.p().second;
    if (rubs(state)) {
      const Vector3 w = c.Y() * v, slip = c.sliding(w);
      Vector3 force;
      Matrix3 slope;
      if (has_bristles()) {
        const BristleStep step = bristle(k, state, c, slip);
        force = step.force;
        slope = step.by_slip;
        K += (push.F * step.by_before) * (c.Y().transpose() * c.turned_sliding(bristle_before(k, state)));
      } else {
        const FrictionLaw::Sliding law = friction_->sliding(slip.norm());
        force = law.h * slip;
        slope = law.h * Matrix3::Identity() + law.slope_over_speed * slip * slip.transpose();
      }
      along += c.Y().transpose() * force;
      slope *= push.F;
      Rows by_rate, turning;
      for (int j = 0; j < 3; ++j) turning.row(j) = v.transpose() * c.Z(Vector3::Unit(j));
      for (int j = 0; j < 12; ++j) {
        by_rate.col(j) = c.sliding(c.Y().col(j));
        turning.col(j) = c.sliding(turning.col(j).eval());
      }
      turning += c.turned_sliding(w);
      const Rows K_slip = slope * turning, C_slip = slope * by_rate;
      K += c.Z(push.F * force);
      K += c.Y().transpose() * K_slip;
      C += c.Y().transpose() * C_slip;
    }
    K += along * by_position.transpose();
    C += push.by_rate * along * g.transpose();
  }
  if (tangent.wants_K) tangent.K.dense().topLeftCorner<12, 12>() += K;
  if (tangent.wants_C) tangent.C.dense().topLeftCorner<12, 12>() += C;
}

void ClearanceJoint::add_energy(const LocalState& state, Energy& energy) const {
  const PairRotation turned = rotation(state);
  const Vector12 v = pair_rate(state.node(0), state.node(1));
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const ClearanceContact c = contact(k, state, turned, false);
    const double p = c.p().value, N = push(k, state, c).F;
    if (p <= 0) continue;
    energy.elastic += places_[k].law.energy(p);
    // The damper dissipates the energy of a spring that it prevents from pushing.
    energy.dissipation += (N - places_[k].law.force(p, 0, 0).F) * c.p().rate(v);
    if (!rubs(state)) continue;
    if (has_bristles()) {
      const BristleStep step = bristle(k, state, c, c.sliding(c.Y() * v));
      energy.dissipation += N * step.lost;
      energy.input -= N * step.stored;
      continue;
    }
    const double speed = c.sliding(c.Y() * v).norm();
    energy.dissipation += N * friction_->sliding(speed).h * speed * speed;
  }
}

void ClearanceJoint::calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const {
  const PairRotation turned = rotation(state);
  for (std::size_t k = 0; k < places_.size(); ++k)
    values[static_cast<Eigen::Index>(k)] = contact(k, state, turned, false).p().value;
}

void ClearanceJoint::accept(const LocalState& state, Eigen::Ref<VectorX> memory) const {
  remember_bristles(state, memory);
  Joint::accept(state, memory);
}

void ClearanceJoint::remember_bristles(const LocalState& state, Eigen::Ref<VectorX> memory) const {
  if (!has_bristles()) return;
  const PairRotation turned = rotation(state);
  const Vector12 v = pair_rate(state.node(0), state.node(1));
  for (std::size_t k = 0; k < places_.size(); ++k) {
    auto z = memory.segment<3>(memory_of(k) + 2);
    const ClearanceContact c = contact(k, state, turned, false);
    if (c.p().value <= 0)
      z.setZero();
    else if (!state.environment().statics)
      z = bristle(k, state, c, c.sliding(c.Y() * v)).z;
  }
}

void ClearanceJoint::begin_branch(const LocalState& state, std::span<const int> crossed,
                                  Eigen::Ref<VectorX> memory) const {
  const PairRotation turned = rotation(state);
  const Vector12 v = pair_rate(state.node(0), state.node(1));
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const bool met = std::find(crossed.begin(), crossed.end(), static_cast<int>(k)) != crossed.end();
    // At an event p is zero up to rounding, and its rate determines the side. The gap is reduced, so that the gradient
    // of p is computed there, too.
    ClearancePlace place = places_[k].place;
    if (met) place.gap *= 0.5;
    const ClearanceContact c(state.node(0), state.node(1), frames(), place, turned, false);
    const double rate = c.p().rate(v);
    const bool touched = memory[memory_of(k)] != 0, touches = met ? rate > 0 : c.p().value > 0;
    memory[memory_of(k)] = touches ? 1 : 0;
    if (!touches || !touched) memory.segment<3>(memory_of(k) + 2).setZero();
    if (touches && !touched) memory[memory_of(k) + 1] = places_[k].law.damping_after(std::max(0.0, rate));
  }
}

std::string ClearanceJoint::what_is_open(const LocalState& state) const {
  const PairRotation turned = rotation(state);
  double deepest = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < places_.size(); ++k)
    deepest = std::max(deepest, contact(k, state, turned, false).p().value);
  return deepest > 0 ? std::string() : fmt::format("is open, its surfaces are {:.3g} m apart", -deepest);
}

bool ClearanceJoint::leaves_branch(const LocalState& state) const {
  const PairRotation turned = rotation(state);
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const bool touches = state.memory()[memory_of(k)] != 0;
    const double p = contact(k, state, turned, false).p().value;
    if (touches ? p < 0 : p > 0) return true;
  }
  return false;
}

std::vector<OutputField> ClearanceJoint::output_fields() const {
  std::vector<OutputField> fields = Joint::output_fields();
  std::string names;
  for (const Place& place : places_) names += (names.empty() ? "" : ", ") + place.name;
  fields.push_back(
      {"penetration", {places_.size()}, "m", "how far surfaces press into each other, negative in the gap: " + names});
  fields.push_back({"normal_force", {places_.size()}, "N", "of the same"});
  return fields;
}

void ClearanceJoint::write_output(const LocalState& state, double* values) const {
  Joint::write_output(state, values);
  double* own = values + 2 * coordinates().size() + 12;
  const PairRotation turned = rotation(state);
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const ClearanceContact c = contact(k, state, turned, false);
    own[k] = c.p().value;
    own[places_.size() + k] = push(k, state, c).F;
  }
}

void ClearanceJoint::describe(const LocalState& state, Description& description) const {
  Joint::describe(state, description);
  for (const Place& place : places_)
    description.add_line(fmt::format("{}: gap {:.6g} m, {}", place.name, place.place.gap, place.law.describe()));
  if (friction_)
    description.add_line(fmt::format("{}, at the radius {:.6g} m", friction_->describe(), places_[0].place.radius));
}

}  // namespace bielle::mechanism

#include "mechanism/elements/beam/beam_element.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "mechanism/elements/beam/beam_deformation.hpp"
#include "mechanism/elements/beam/beam_strain.hpp"
#include "mechanism/elements/beam/beam_stress.hpp"
#include "mechanism/math/gauss.hpp"
#include "mechanism/math/inverse.hpp"
#include "mechanism/model/description.hpp"
#include "reduce/common/counted.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

/// Returns the flexibility at z: the parabola through those of the Gauss points (constant for a uniform section).
Matrix6 flexibility_at(const std::array<Matrix6, 3>& S, double z) {
  const std::array<double, 3>& p = Gauss3::place;
  Matrix6 sum = Matrix6::Zero();
  for (std::size_t g = 0; g < 3; ++g) {
    const std::size_t i = (g + 1) % 3, j = (g + 2) % 3;
    sum += (z - p[i]) * (z - p[j]) / ((p[g] - p[i]) * (p[g] - p[j])) * S[g];
  }
  return sum;
}

Matrix6 element_stiffness(const ElementSections& sections, const BeamReference& reference, BeamBending bending) {
  constexpr int parts = 16;  // three Gauss points in each: 1e-10 for an element with a rotation of a right angle
  std::array<Matrix6, 3> S;
  Matrix6 mean = Matrix6::Zero(), sum = Matrix6::Zero();
  for (std::size_t g = 0; g < 3; ++g) {
    S[g] = symmetric_inverse(sections.at[g].stiffness);
    mean += Gauss3::weight[g] * sections.at[g].stiffness;
  }
  if (bending == BeamBending::constant) return mean;
  for (int part = 0; part < parts; ++part)
    for (std::size_t g = 0; g < 3; ++g) {
      const double z = (part + Gauss3::place[g]) / parts;
      const Matrix6 A = equilibrium(reference.d0, reference.seen_from_B(z));
      sum += Gauss3::weight[g] / parts * A.transpose() * flexibility_at(S, z) * A;
    }
  return symmetric_inverse(sum);
}

/// Returns velocities and angular velocities of the nodes, [v_A; Omega_A; v_B; Omega_B].
Vector12 node_velocities(const LocalState& state) {
  Vector12 v;
  v << state.node(0).v, state.node(0).Omega, state.node(1).v, state.node(1).Omega;
  return v;
}

/// Adds A B. (Products of this size are faster by coefficients, and into a matrix of fixed size, than through Eigen's
/// blocked kernel.)
void add_product(const Matrix12x6& A, const Matrix6x12& B, Eigen::Ref<MatrixX> sum) {
  const Eigen::Matrix<double, 12, 12> product = A.lazyProduct(B);
  sum += product;
}

/// Returns the larger eigenvalue of the flexibility for moments normal to the element [1/(N m^2)].
double softness_across(const Matrix6& flexibility, const Vector3& along) {
  const Matrix3 across = Matrix3::Identity() - along * along.transpose();
  const Matrix3 bending = across * flexibility.bottomRightCorner<3, 3>() * across;
  const double sum = bending.trace(), difference = std::sqrt(std::max(0.0, 2 * bending.squaredNorm() - sum * sum));
  return 0.5 * (sum + difference);
}

}  // namespace

BeamElement::BeamElement(std::string name, BeamPlace place, int node_a, int node_b, const Matrix3& R_A,
                         const Matrix3& R_B, const BeamReference& reference, const ElementSections& sections,
                         double damping, BeamBending bending)
    : Component("beam", std::move(name)),
      place_(place),
      node_a_(node_a),
      node_b_(node_b),
      R_A_(R_A),
      R_B_(R_B),
      d0_(reference.d0),
      L_(reference.length),
      along_(d0_.head<3>().normalized()),
      bending_(bending),
      stiffness_(element_stiffness(sections, reference, bending)),
      section_(sections.middle()),
      flexibility_(symmetric_inverse(section_.stiffness)),
      softness_(softness_across(flexibility_, along_)),
      mass_(L_ * sections.mean_mass()),
      damping_(damping),
      inertia_(sections, R_A, R_B, reference) {
  if (bending == BeamBending::constant) return;
  to_middle_ = flexibility_ * equilibrium(d0_, exp_se3(-0.5 * d0_)) * stiffness_;
  bowing_ = BeamBowing(stiffness_, sections, along_);
}

void BeamElement::declare(Declaration& declaration) const {
  declaration.nodes = {node_a_, node_b_};
  declaration.stiffness = true;
  declaration.mass = !inertia_.is_massless();
  declaration.damping = declaration.mass || damping_ > 0;
  const Vector3 psi = d0_.tail<3>();
  declaration.memory.assign(psi.begin(), psi.end());
}

Vector6 BeamElement::relative_motion(const LocalState& state, const Matrix3& R_A, const Matrix3& R_B) const {
  Vector6 d = log_se3({R_A.transpose() * (state.node(1).x - state.node(0).x), R_A.transpose() * R_B});
  // The logarithm jumps to the opposite rotation at 180 degrees.
  if ((d.tail<3>() - state.memory()).norm() > std::numbers::pi)
    refuse(state, "its ends have turned past 180 degrees against each other", ", or take smaller steps");
  return d;
}

void BeamElement::refuse(const LocalState& state, const std::string& why, const char* or_else) const {
  const std::string when = state.environment().statics
                               ? fmt::format("load factor {:.6g}", state.environment().load_factor)
                               : fmt::format("t = {:.6g} s", state.time());
  throw ComputationError(
      fmt::format("{}: beam '{}', element {} of {}: {}, and one element follows up to {:.0f}: give "
                  "the beam more `elements`{}",
                  when, name(), place_.element, place_.elements, why, degrees(largest_turn), or_else));
}

void BeamElement::accept(const LocalState& state, Eigen::Ref<VectorX> memory) const {
  const NodeState &A = state.node(0), &B = state.node(1);
  const Vector3 psi = relative_motion(state, A.R * R_A_, B.R * R_B_).tail<3>();
  if (psi.norm() > largest_turn)
    refuse(state, fmt::format("its ends are turned by {:.0f} degrees against each other", degrees(psi.norm())), "");
  memory = psi;
}

BeamElement::Strain BeamElement::strain(const LocalState& state) const {
  Strain S;
  S.R_A = state.node(0).R * R_A_;
  S.R_B = state.node(1).R * R_B_;
  S.d = relative_motion(state, S.R_A, S.R_B);
  S.eps = (S.d - d0_) / L_;
  S.bowing = bowing_.at(S.eps);
  S.eps.head<3>() += S.bowing.q * along_;
  return S;
}

BeamElement::Deformation BeamElement::deformation(const LocalState& state, const Strain& strain) const {
  Deformation D{strain, {}, Vector6::Zero(), {}};
  const Matrix6 inverse = tangent_se3_inverse(D.d);
  const Matrix3 along = inverse.topLeftCorner<3, 3>(), across = inverse.topRightCorner<3, 3>();
  // T6^-1(-d) has the transposed blocks of T6^-1(d).
  D.PT << -D.R_A * along, Matrix3::Zero(), -R_A_ * across, -R_A_ * along, D.R_B * along.transpose(), Matrix3::Zero(),
      R_B_ * across.transpose(), R_B_ * along.transpose();
  if (damping_ > 0) D.epsdot = D.of_strain(D.PT.transpose() * node_velocities(state), along_) / L_;
  D.f = stiffness_ * (D.eps + damping_ * D.epsdot);
  return D;
}

BeamElement::Deformation BeamElement::deformation(const LocalState& state) const {
  return deformation(state, strain(state));
}

void BeamElement::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  const Deformation D = deformation(state);
  r.head<12>().noalias() += D.PT * D.of_motion(D.f, along_);
  if (!inertia_.is_massless()) inertia_.add_force(state, r);
}

Matrix6 BeamElement::form_of_motion(const Matrix6& A, const Strain& strain) const {
  const Vector6& q_gradient = strain.bowing.gradient;
  Matrix6 form = A + (A.leftCols<3>() * along_) * q_gradient.transpose();
  form += q_gradient * (along_.transpose() * form.topRows<3>()).eval();
  return form;
}

// With P and h = [dx_A; dTheta_A; dx_B; dTheta_B] of the nodes, P = PT^T:
//   L depsdot/dh = J Y + (t/L) (P v)^T d2q/de2 P,
//   Y = d(P v)/dh = [D(d, v_B) + D(-d, v_A)] P + P [0 xdot_k~ R_k; 0 0]_k,   D(d, w) = d(T6^-1(d) w)/dd
// where v_k are velocities of the section frames in their axes.
Matrix6x12 BeamElement::rate_gradient(const LocalState& state, const Deformation& D) const {
  const NodeState &A = state.node(0), &B = state.node(1);
  Vector6 v_A, v_B;
  v_A << D.R_A.transpose() * A.v, R_A_.transpose() * A.Omega;
  v_B << D.R_B.transpose() * B.v, R_B_.transpose() * B.Omega;
  const Matrix6 along_d = tangent_se3_inverse_gradient(D.d, v_B) + tangent_se3_inverse_gradient(-D.d, v_A);
  Matrix6x12 gradient = along_d * D.PT.transpose();
  for (int k = 0; k < 2; ++k)
    gradient.middleCols<3>(6 * k + 3) +=
        D.PT.middleRows<3>(6 * k).transpose() * skew(state.node(k).v) * state.node(k).R;
  const Vector6 bows_rate = bowing_.second_gradient(D.bowing) * (D.PT.transpose() * node_velocities(state)) / L_;
  gradient.topRows<3>() +=
      along_ * (D.bowing.gradient.transpose() * gradient + bows_rate.transpose() * D.PT.transpose()).eval();
  return gradient;
}

// With P and h of the nodes, dh_k = [R_Sk^T dx; R_k^T dTheta] in section frames (section axes R_Sk, their constant
// orientation R_k in the node), Q = diag(R_SA, R_A, R_SB, R_B), F = P^T J^T f, n = t . f:
//   K = {P^T [J^T C_e J + n d2q/de2]/L + Q [G(-d, J^T f); G(d, J^T f)]} P + P^T J^T C_d depsdot/dh,
//   C = P^T J^T C_d J P/L
// and in the blocks (x_k, Theta_k) of K the rotation of the force with its node, -F_u,k~ R_k.
void BeamElement::add_stiffness(const LocalState& state, const Deformation& D, Eigen::Ref<MatrixX> K) const {
  const Vector6 f_of_motion = D.of_motion(D.f, along_);
  const Vector12 F = D.PT * f_of_motion;
  const double n = along_.dot(D.f.head<3>());
  const Matrix6 H = (form_of_motion(stiffness_, D) + n * bowing_.second_gradient(D.bowing)) / L_;
  Matrix12x6 X = D.PT.lazyProduct(H);
  for (int k = 0; k < 2; ++k) {
    const Eigen::Index x = 6 * k, Theta = x + 3;
    const Matrix6 G = inverse_transpose_gradient_se3(k == 0 ? Vector6(-D.d) : D.d, f_of_motion);
    X.block<3, 3>(x, 3) += (k == 0 ? D.R_A : D.R_B) * G.topRightCorner<3, 3>();
    X.middleRows<3>(Theta) += (k == 0 ? R_A_ : R_B_) * G.bottomRows<3>();
    K.block<3, 3>(x, Theta) -= skew(F.segment<3>(x)) * state.node(k).R;
  }
  add_product(X, D.PT.transpose(), K);
  if (damping_ == 0) return;
  Matrix6 C_d = damping_ / L_ * stiffness_;
  C_d += D.bowing.gradient * (along_.transpose() * C_d.topRows<3>()).eval();  // J^T C_d
  X = D.PT.lazyProduct(C_d);
  add_product(X, rate_gradient(state, D), K);
}

// f = C (eps + J P h/L), with the step h.
Vector6 BeamElement::predicted_resultants(const LocalState& before, const LocalState& state) const {
  const Deformation D = deformation(before);
  Vector12 h;
  for (int k = 0; k < 2; ++k) {
    h.segment<3>(6 * k) = state.node(k).x - before.node(k).x;
    h.segment<3>(6 * k + 3) = log_so3(before.node(k).R.transpose() * state.node(k).R);
  }
  return stiffness_ * (D.eps + D.of_strain(D.PT.transpose() * h, along_) / L_);
}

void BeamElement::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  const bool wants_damping = tangent.wants_C && damping_ > 0;
  if (tangent.wants_K || wants_damping) {
    Deformation D = deformation(state);
    if (const State* before = state.environment().before; before && tangent.wants_K)
      D.f = predicted_resultants(LocalState(*before, state.slots(), state.environment()), state);
    if (tangent.wants_K) add_stiffness(state, D, tangent.K.dense());
    if (wants_damping) {
      const Matrix12x6 X = D.PT.lazyProduct(damping_ / L_ * form_of_motion(stiffness_, D));
      add_product(X, D.PT.transpose(), tangent.C.dense());
    }
  }
  if (!inertia_.is_massless()) inertia_.add_tangent(state, tangent);
}

void BeamElement::add_energy(const LocalState& state, Energy& energy) const {
  const Strain S = strain(state);
  energy.elastic += 0.5 * L_ * S.eps.dot(stiffness_ * S.eps);
  if (damping_ > 0) {
    const Vector6 epsdot = deformation(state, S).epsdot;
    energy.dissipation += L_ * damping_ * epsdot.dot(stiffness_ * epsdot);
  }
  if (!inertia_.is_massless()) inertia_.add_energy(state, energy);
}

// Energies of shear are added to those of bending: they contain the energy of the moment's variation along the element
// (residual flexibility).
StrainEnergies BeamElement::strain_energies(const LocalState& state, const Eigen::Ref<const VectorX>& du) const {
  const Deformation D = deformation(state);
  const Vector6 strain = D.of_strain(D.PT.transpose() * du.head<12>(), along_) / L_, resultants = stiffness_ * strain;
  const Vector6 energy = 0.5 * L_ * strain.cwiseProduct(resultants);
  return {energy[0], energy[3], energy[2] + energy[4], energy[1] + energy[5]};
}

int BeamElement::softer_axis() const {
  constexpr double equal = 1.05;
  const double about_y = section_.stiffness(4, 4), about_z = section_.stiffness(5, 5);
  return about_z > equal * about_y ? 1 : about_y > equal * about_z ? 2 : 0;
}

void BeamElement::describe(const LocalState& /*state*/, Description& description) const {
  description.add_sum("length", L_, "m");
  description.add_sum("mass", mass_, "kg");
  if (place_.element == 1) {
    description.add(counted(place_.elements, "element"));
    if (damping_ > 0) description.add(fmt::format("damping {:.6g} s", damping_));
    if (bending_ == BeamBending::constant) description.add("bending constant along each element");
  }
  const Matrix6& C = section_.stiffness;
  const bool coupled = !C.isDiagonal(1e-12);
  std::string text =
      fmt::format("EA {:.6g}, GAy {:.6g}, GAz {:.6g} N, GJ {:.6g}, EIy {:.6g}, EIz {:.6g} N m^2{}", C(0, 0), C(1, 1),
                  C(2, 2), C(3, 3), C(4, 4), C(5, 5), coupled ? " about the node line, and coupling terms" : "");
  if (coupled) {
    const Vector6 alone = flexibility_.diagonal().cwiseInverse();
    text += fmt::format("\n      against one moment alone: GJ {:.6g}, EIy {:.6g}, EIz {:.6g} N m^2", alone[3], alone[4],
                        alone[5]);
  }
  description.add_each("section in the middle of", "element", text);
}

BeamElement::Validity BeamElement::validity(const LocalState& state) const {
  const Strain S = strain(state);
  const double tension = along_.dot(stiffness_.topRows<3>() * S.eps);
  return {section_.largest_strain(to_middle_ * (S.d - d0_) / L_), L_ * std::sqrt(std::max(0.0, tension) * softness_)};
}

std::unique_ptr<StepRecorder> BeamElement::make_step_recorder() const {
  return std::make_unique<BeamStrainWatch>(*this);
}

Matrix6 BeamElement::wrench_to_middle(const Deformation& D) const {
  if (bending_ == BeamBending::constant) return Matrix6::Identity();
  return equilibrium(D.d, exp_se3(-0.5 * D.d));
}

std::vector<OutputField> BeamElement::output_fields() const {
  std::vector<OutputField> fields{
      {"strain", {6}, "1, 1/m", "stretch and shears [1], twist and curvatures [1/m] in the middle, section frame"},
      {"resultants", {6}, "N, N m", "forces [N] and moments [N m] in the middle, section frame"}};
  if (!section_.stress.empty()) {
    fields.push_back(
        {"stress", {section_.stress.size(), 3}, "Pa", "sigma xx, tau xy, tau xz at the stress points, in the middle"});
    fields.push_back(
        {"von_mises", {section_.stress.size()}, "Pa", "sqrt(sigma^2 + 3 tau^2) at the stress points, in the middle"});
  }
  return fields;
}

Vector6 BeamElement::middle_forces(const LocalState& state) const {
  const Deformation D = deformation(state);
  return wrench_to_middle(D) * D.of_motion(D.f, along_);
}

void BeamElement::write_output(const LocalState& state, double* values) const {
  const Deformation D = deformation(state);
  const Matrix6 middle = wrench_to_middle(D);
  const Vector6 f = middle * D.of_motion(D.f, along_);
  Eigen::Map<Vector12> out(values);
  out << flexibility_ * middle * D.of_motion(stiffness_ * D.eps, along_), f;
  double* stress = values + 12;
  double* von_mises = stress + 3 * section_.stress.size();
  for (std::size_t p = 0; p < section_.stress.size(); ++p) {
    Eigen::Map<Vector3> sigma(stress + 3 * p);
    sigma = section_.stress[p] * f;
    von_mises[p] = von_mises_stress(sigma);
  }
}

}  // namespace bielle::mechanism

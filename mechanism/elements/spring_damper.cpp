#include "mechanism/elements/spring_damper.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include <fmt/format.h>

namespace bielle::mechanism {
namespace {

/// Gauss-Legendre with five points: exact for polynomials up to degree nine.
double gauss5(const Expression& N, double from, double to) {
  static constexpr std::array<double, 3> point{0, 0.5384693101056831, 0.9061798459386640};
  static constexpr std::array<double, 3> weight{0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k)
    for (int sign : {-1, 1}) {
      if (k == 0 && sign < 0) continue;
      const std::array<double, 2> e_v{middle + sign * half * point[k], 0};
      sum += weight[k] * N(e_v);
    }
  return half * sum;
}

/// Halves the interval until both halves agree with the whole: formulas may have kinks.
double integral(const Expression& N, double from, double to, double whole, int depth) {
  const double middle = 0.5 * (from + to);
  const double left = gauss5(N, from, middle), right = gauss5(N, middle, to);
  if (depth == 0 || std::abs(left + right - whole) <= 1e-12 * (std::abs(left) + std::abs(right))) return left + right;
  return integral(N, from, middle, left, depth - 1) + integral(N, middle, to, right, depth - 1);
}

}  // namespace

TensionLaw TensionLaw::linear(double stiffness, double damping) {
  TensionLaw law;
  law.stiffness_ = stiffness;
  law.damping_ = damping;
  return law;
}

TensionLaw TensionLaw::formula(const Expression& of_e_v) {
  TensionLaw law;
  law.formula_ = of_e_v;
  return law;
}

TensionLaw TensionLaw::timed_formula(const Expression& of_e_v_t) {
  TensionLaw law = formula(of_e_v_t);
  law.timed_ = true;
  return law;
}

Tension TensionLaw::at(double e, double v, double t) const {
  if (is_linear()) return {stiffness_ * e + damping_ * v, stiffness_, damping_};
  const std::array<double, 3> arguments{e, v, t};
  const std::span<const double> used(arguments.data(), timed_ ? 3 : 2);
  return {(*formula_)(used), formula_->derivative(used, 0), formula_->derivative(used, 1)};
}

double TensionLaw::elastic_energy(double e) const {
  if (is_linear()) return 0.5 * stiffness_ * e * e;
  return integral(*formula_, 0, e, gauss5(*formula_, 0, e), 30);
}

SpringDamper::SpringDamper(std::string name, int node_a, int node_b, const Vector3& at_a, const Vector3& at_b,
                           double length, TensionLaw law)
    : Component("spring_damper", std::move(name)),
      node_a_(node_a),
      node_b_(node_b),
      c_a_(at_a),
      c_b_(at_b),
      length_(length),
      law_(std::move(law)) {}

void SpringDamper::declare(Declaration& declaration) const {
  declaration.nodes = {node_a_, node_b_};
  declaration.stiffness = true;
  declaration.damping = !law_.is_linear() || law_.damping() > 0;
}

struct SpringDamper::Line {
  double l, v;
  Vector3 u, sdot;
  Tension tension;
  double N_over_l;
};

SpringDamper::Line SpringDamper::line(const LocalState& state) const {
  const NodeState &A = state.node(0), &B = state.node(1);
  const Vector3 s = B.x + B.R * c_b_ - A.x - A.R * c_a_;
  Line line;
  line.sdot = B.v + B.R * B.Omega.cross(c_b_) - A.v - A.R * A.Omega.cross(c_a_);
  line.l = s.norm();
  // Below this the direction is made of rounding errors of the positions.
  const double smallest = 1e-12 * (A.x.cwiseAbs().maxCoeff() + B.x.cwiseAbs().maxCoeff() + c_a_.cwiseAbs().maxCoeff() +
                                   c_b_.cwiseAbs().maxCoeff());
  if (line.l <= smallest) {
    if (!(law_.is_linear() && length_ == 0 && law_.damping() == 0))
      throw ComputationError(fmt::format(
          "t = {:.6g} s: the ends of spring_damper '{}' have met: its force has no direction", state.time(), name()));
    line.u = Vector3::UnitX();
  } else {
    line.u = s / line.l;
  }
  line.v = line.u.dot(line.sdot);
  line.tension = law_.at(line.l - length_, line.v, state.time());
  line.N_over_l = line.l > smallest ? line.tension.N / line.l : line.tension.N_e;
  return line;
}

void SpringDamper::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  const Line L = line(state);
  const Vector3 f = L.tension.N * L.u;
  r.segment<3>(0) -= f;
  r.segment<3>(3) -= c_a_.cross(state.node(0).R.transpose() * f);
  r.segment<3>(6) += f;
  r.segment<3>(9) += c_b_.cross(state.node(1).R.transpose() * f);
}

// With the projector Q = I - u u^T, f = N u and J of the head of the file:
//   df/ds = N_e u u^T + (N/l) Q + (N_v/l) u sdot^T Q,   df/dsdot = N_v u u^T
//   K = J^T (df/ds J + df/dsdot [0, R_A (Omega_A~ c_A)~, 0, -R_B (Omega_B~ c_B)~]) + diag(0, -c_A~ (R_A^T f)~, 0, c_B~
//   (R_B^T f)~) C = J^T df/dsdot J
void SpringDamper::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (!tangent.wants_K && !tangent.wants_C) return;
  const NodeState &A = state.node(0), &B = state.node(1);
  const Line L = line(state);
  Eigen::Matrix<double, 3, 12> J;
  J << -Matrix3::Identity(), A.R * skew(c_a_), Matrix3::Identity(), -B.R * skew(c_b_);
  const Eigen::Matrix<double, 12, 1> Ju = J.transpose() * L.u;
  if (tangent.wants_C) tangent.C.topLeftCorner<12, 12>() += L.tension.N_v * Ju * Ju.transpose();
  if (!tangent.wants_K) return;
  const Matrix3 Q = Matrix3::Identity() - L.u * L.u.transpose();
  Eigen::Matrix<double, 12, 1> v_gradient = Eigen::Matrix<double, 12, 1>::Zero();
  v_gradient.segment<3>(3) = skew(A.Omega.cross(c_a_)).transpose() * A.R.transpose() * L.u;
  v_gradient.segment<3>(9) = -skew(B.Omega.cross(c_b_)).transpose() * B.R.transpose() * L.u;
  // Where the ends meet (allowed without damper only) the quotient has no meaning and no effect.
  if (L.tension.N_v != 0) v_gradient += J.transpose() * (Q * L.sdot) / L.l;
  const Vector3 f = L.tension.N * L.u;
  auto K = tangent.K.topLeftCorner<12, 12>();
  K += Ju * (L.tension.N_e * Ju + L.tension.N_v * v_gradient).transpose() + L.N_over_l * J.transpose() * Q * J;
  K.block<3, 3>(3, 3) -= skew(c_a_) * skew(A.R.transpose() * f);
  K.block<3, 3>(9, 9) += skew(c_b_) * skew(B.R.transpose() * f);
}

void SpringDamper::add_energy(const LocalState& state, Energy& energy) const {
  const Line L = line(state);
  if (law_.is_timed()) {
    energy.input -= L.tension.N * L.v;
    return;
  }
  const double e = L.l - length_;
  energy.elastic += law_.elastic_energy(e);
  energy.dissipation += (L.tension.N - law_.at(e, 0, state.time()).N) * L.v;
}

std::vector<OutputField> SpringDamper::output_fields() const {
  return {{"length", {}, "m", "distance of the attachment points"},
          {"rate", {}, "m/s", "rate of the length"},
          {"force", {}, "N", "tension, positive when it pulls the points together"}};
}

void SpringDamper::write_output(const LocalState& state, double* values) const {
  const Line L = line(state);
  values[0] = L.l;
  values[1] = L.v;
  values[2] = L.tension.N;
}

namespace {

TensionLaw read_law(const YamlValue& entry) {
  if (const auto force = entry.find("force")) {
    for (const char* key : {"stiffness", "damping"})
      if (const auto other = entry.find(key)) other->fail("give either `force` or `stiffness` and `damping`");
    Expression timed = force->expression({"e", "v", "t"});
    // A formula that can do without t is a spring and damper; one that cannot is an actuator.
    try {
      return TensionLaw::formula(force->expression({"e", "v"}));
    } catch (const InputError&) {
      return TensionLaw::timed_formula(timed);
    }
  }
  const auto stiffness = entry.find("stiffness"), damping = entry.find("damping");
  if (!stiffness && !damping) entry.fail("a spring_damper needs `stiffness`, `damping` or `force`");
  return TensionLaw::linear(stiffness ? stiffness->non_negative_number() : 0,
                            damping ? damping->non_negative_number() : 0);
}

}  // namespace

void read_spring_damper(const std::string& name, const YamlValue& entry, Model& model) {
  entry.check_keys({"type", "nodes", "at", "stiffness", "damping", "length", "force"}, "a spring_damper");
  const YamlValue node_names = entry.at("nodes");
  const std::vector<int> nodes = model.nodes_named_by(node_names, 2);
  if (nodes[0] == nodes[1]) node_names.fail("a spring_damper joins two different nodes");
  Vector3 at_a = Vector3::Zero(), at_b = Vector3::Zero();
  if (const auto at = entry.find("at")) {
    if (!at->is_sequence() || at->size() != 2) at->fail("expected two points, one in the axes of each node");
    at_a = at->at(std::size_t{0}).vector3();
    at_b = at->at(std::size_t{1}).vector3();
  }
  const Frame &A = model.node(nodes[0]).frame, &B = model.node(nodes[1]).frame;
  const double placed = (B.x + B.R * at_b - A.x - A.R * at_a).norm();
  const auto length = entry.find("length");
  const double free_length = length ? length->non_negative_number() : placed;
  TensionLaw law = read_law(entry);
  if (placed == 0 && !(law.is_linear() && free_length == 0 && law.damping() == 0))
    node_names.fail("the attachment points coincide: the spring_damper has no direction");
  model.add(std::make_unique<SpringDamper>(name, nodes[0], nodes[1], at_a, at_b, free_length, std::move(law)),
            "elements/" + name);
}

}  // namespace bielle::mechanism

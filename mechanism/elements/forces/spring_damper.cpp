#include "mechanism/elements/forces/spring_damper.hpp"

#include <cmath>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "mechanism/drawing/drawing.hpp"
#include "mechanism/measures/read_measure.hpp"
#include "mechanism/model/description.hpp"
#include "mechanism/reading/names.hpp"

namespace bielle::mechanism {
SpringDamper::SpringDamper(std::string name, int node_a, int node_b, const Vector3& at_a, const Vector3& at_b,
                           double length, ForceLaw law)
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
  declaration.damping = law_.has_damping();
  declaration.reads_reactions = law_.reads_reactions();
  references_.declare(declaration);
}

void SpringDamper::read(const YamlValue& formula, Model& model) {
  law_.add(read_state_formula(formula, {"e", "v", "t"}, model, references_));
}

struct SpringDamper::Line {
  double l, v;
  Vector3 u, sdot;
};

/// Returns the length below which the direction consists of rounding errors of the positions [m].
double SpringDamper::smallest_length(const LocalState& state) const {
  return 1e-12 * (state.node(0).x.cwiseAbs().maxCoeff() + state.node(1).x.cwiseAbs().maxCoeff() +
                  c_a_.cwiseAbs().maxCoeff() + c_b_.cwiseAbs().maxCoeff());
}

Vector3 SpringDamper::span(const LocalState& state) const {
  const NodeState &A = state.node(0), &B = state.node(1);
  return B.x + B.R * c_b_ - A.x - A.R * c_a_;
}

SpringDamper::Line SpringDamper::line(const LocalState& state) const {
  const NodeState &A = state.node(0), &B = state.node(1);
  const Vector3 s = span(state);
  Line line;
  line.sdot = B.v + B.R * B.Omega.cross(c_b_) - A.v - A.R * A.Omega.cross(c_a_);
  line.l = s.norm();
  if (line.l <= smallest_length(state)) {
    if (!(law_.is_linear() && length_ == 0 && law_.damping() == 0))
      throw ComputationError(fmt::format(
          "t = {:.6g} s: the ends of spring_damper '{}' have met: its force has no direction", state.time(), name()));
    line.u = Vector3::UnitX();
  } else {
    line.u = s / line.l;
  }
  line.v = line.u.dot(line.sdot);
  return line;
}

void SpringDamper::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  const Line L = line(state);
  const Vector3 f = law_.force(state, L.l - length_, L.v) * L.u;
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
  const LawForce law = law_.calc(state, L.l - length_, L.v, false);
  Eigen::Matrix<double, 3, 12> J;
  J << -Matrix3::Identity(), A.R * skew(c_a_), Matrix3::Identity(), -B.R * skew(c_b_);
  const Eigen::Matrix<double, 12, 1> Ju = J.transpose() * L.u;
  if (law_.reads_state()) law_.add_measures(state, L.l - length_, L.v, Ju, 0, tangent);
  if (tangent.wants_C) tangent.C.dense().topLeftCorner<12, 12>() += law.N_v * Ju * Ju.transpose();
  if (!tangent.wants_K) return;
  const Matrix3 Q = Matrix3::Identity() - L.u * L.u.transpose();
  Eigen::Matrix<double, 12, 1> v_gradient = Eigen::Matrix<double, 12, 1>::Zero();
  // If the ends coincide (allowed only without damper), the direction is undefined, and the term has no effect.
  if (law.N_v != 0) v_gradient = calc_elongation(state).v_gradient;
  const Vector3 f = law.N * L.u;
  const double N_over_l = L.l > smallest_length(state) ? law.N / L.l : law.N_x;
  auto K = tangent.K.dense().topLeftCorner<12, 12>();
  K += Ju * (law.N_x * Ju + law.N_v * v_gradient).transpose() + N_over_l * J.transpose() * Q * J;
  K.block<3, 3>(3, 3) -= skew(c_a_) * skew(A.R.transpose() * f);
  K.block<3, 3>(9, 9) += skew(c_b_) * skew(B.R.transpose() * f);
}

std::vector<TimeDependent::Formula> SpringDamper::time_formulas() const {
  if (!law_.holds_time()) return {};
  return {{"force", "N"}};
}

void SpringDamper::calc_time_formulas(const LocalState& state, std::span<double> values) const {
  const auto [e, v] = elongation(state);
  values[0] = law_.force(state, e, v);
}

void SpringDamper::describe(const LocalState& state, Description& description) const {
  description.add(fmt::format("between nodes {} and {}", description.node(node_a_), description.node(node_b_)));
  for (const std::string& fact : law_.describe(false)) description.add(fact);
  description.add(fmt::format("free length {:.6g} m", length_));
  description.add(fmt::format("assembled at {:.6g} m", span(state).norm()));
}

std::pair<double, double> SpringDamper::elongation(const LocalState& state) const {
  const Line L = line(state);
  return {L.l - length_, L.v};
}

SpringDamper::Gradients SpringDamper::calc_elongation(const LocalState& state) const {
  const NodeState &A = state.node(0), &B = state.node(1);
  const Line L = line(state);
  Eigen::Matrix<double, 3, 12> J;
  J << -Matrix3::Identity(), A.R * skew(c_a_), Matrix3::Identity(), -B.R * skew(c_b_);
  Gradients g{L.l - length_, L.v, J.transpose() * L.u, J.transpose() * ((L.sdot - L.u * L.v) / L.l)};
  g.v_gradient.segment<3>(3) += skew(A.Omega.cross(c_a_)).transpose() * A.R.transpose() * L.u;
  g.v_gradient.segment<3>(9) -= skew(B.Omega.cross(c_b_)).transpose() * B.R.transpose() * L.u;
  return g;
}

void SpringDamper::add_energy(const LocalState& state, Energy& energy) const {
  const Line L = line(state);
  const double e = L.l - length_, N = law_.force(state, e, L.v);
  if (law_.is_actuator()) {
    energy.input -= N * L.v;
    return;
  }
  energy.elastic += law_.elastic_energy(state, e);
  energy.dissipation += (N - law_.force(state, e, 0)) * L.v;
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
  values[2] = law_.force(state, L.l - length_, L.v);
}

double SpringDamper::force(const LocalState& state) const {
  const auto [e, v] = elongation(state);
  return law_.force(state, e, v);
}

LawForce SpringDamper::calc_force(const LocalState& state) const {
  if (law_.reads_state())
    throw ComputationError(fmt::format(
        "the force of spring_damper '{0}' is a formula of measures, so that '{0}.force' has no derivatives: "
        "use these measures in its place",
        name()));
  const auto [e, v] = elongation(state);
  return law_.calc(state, e, v, false);
}

namespace {

/// "spring.elongation", "spring.elongation.rate"
class ElongationMeasure final : public Measure {
 public:
  ElongationMeasure(std::string name, const SpringDamper& spring, bool rate)
      : Measure(std::move(name)), spring_(spring), rate_(rate) {}
  std::string units() const override { return rate_ ? "m/s" : "m"; }
  double value(const LocalState& state) const override {
    const auto [e, v] = spring_.elongation(state.of(0));
    return rate_ ? v : e;
  }
  double calc(const LocalState& state, MeasureGradient& gradient) const override {
    gradient.prepare(state.slots().size());
    const SpringDamper::Gradients g = spring_.calc_elongation(state.of(0));
    const int row = state.slots().reference_row(0);
    gradient.position().segment<12>(row) = rate_ ? g.v_gradient : g.e_gradient;
    if (rate_) gradient.rate().segment<12>(row) = g.e_gradient;
    return rate_ ? g.v : g.e;
  }

 private:
  void declare_subjects(Declaration& declaration) const override { declaration.references = {&spring_}; }
  const SpringDamper& spring_;
  bool rate_;
};

/// "spring.force"
class SpringForceMeasure final : public Measure {
 public:
  SpringForceMeasure(std::string name, const SpringDamper& spring) : Measure(std::move(name)), spring_(spring) {}
  std::string units() const override { return "N"; }
  double value(const LocalState& state) const override { return spring_.force(state.of(0)); }
  double calc(const LocalState& state, MeasureGradient& gradient) const override {
    gradient.prepare(state.slots().size());
    const LocalState of_spring = state.of(0);
    const SpringDamper::Gradients g = spring_.calc_elongation(of_spring);
    const LawForce law = spring_.calc_force(of_spring);
    const int row = state.slots().reference_row(0);
    gradient.position().segment<12>(row) = law.N_x * g.e_gradient + law.N_v * g.v_gradient;
    gradient.rate().segment<12>(row) = law.N_v * g.e_gradient;
    return law.N;
  }

 private:
  void declare_subjects(Declaration& declaration) const override { declaration.references = {&spring_}; }
  const SpringDamper& spring_;
};

}  // namespace

std::unique_ptr<Measure> SpringDamper::make_measure(const std::string& name, const std::string& measure) const {
  if (measure == "force") return std::make_unique<SpringForceMeasure>(name, *this);
  return std::make_unique<ElongationMeasure>(name, *this, measure != "elongation");
}

namespace {

/// Reads `stiffness` and `damping`; a formula `force` is read later.
ForceLaw read_linear(const YamlValue& entry) {
  const auto stiffness = entry.find("stiffness"), damping = entry.find("damping");
  if (entry.has("force")) {
    for (const char* key : {"stiffness", "damping"})
      if (const auto other = entry.find(key)) other->fail("give either `force` or `stiffness` and `damping`");
    return {};
  }
  if (!stiffness && !damping) entry.fail("a spring_damper needs `stiffness`, `damping` or `force`");
  return {stiffness ? stiffness->number() : 0, damping ? damping->number() : 0};
}

}  // namespace

const KeyTable& spring_damper_keys() {
  using namespace keys;
  static const KeyTable table{
      "a spring_damper",
      "A spring, a damper or a force along the line between points of two nodes.",
      {type_key(),
       {"nodes", list_of(2, name_of("node")), required, "The two nodes."},
       {"at", list_of(2, vector3("m").as_point()), otherwise("[[0, 0, 0], [0, 0, 0]]"),
        "Points of attachment, each in the axes of its node."},
       {"stiffness", number("N/m").non_negative(), optional, "Force per elongation."},
       {"damping", number("N s/m").non_negative(), optional, "Force per rate of the length."},
       {"length", number("m").non_negative(), computed("the distance as placed"), "Free length of the spring."},
       {"force", state_formula("N", {"e", "v", "t"}), optional,
        "Tension as a formula of the elongation e, its rate v, the time t and measures, in place of `stiffness` and "
        "`damping`."}}};
  return table;
}

void read_spring_damper(const std::string& name, const YamlValue& entry, Model& model) {
  const YamlValue node_names = entry.at("nodes");
  const std::vector<int> nodes = nodes_named_by(node_names, 2, model);
  if (nodes[0] == nodes[1]) node_names.fail("a spring_damper joins two different nodes");
  const YamlValue at = entry.at("at");
  if (!at.is_sequence() || at.size() != 2) at.fail("expected two points, one in the axes of each node");
  const Vector3 at_a = at.at(std::size_t{0}).vector3(), at_b = at.at(std::size_t{1}).vector3();
  const Frame &A = model.node(nodes[0]).frame, &B = model.node(nodes[1]).frame;
  const double placed = (B.x + B.R * at_b - A.x - A.R * at_a).norm();
  const auto length = entry.find("length");
  const double free_length = length ? length->number() : placed;
  ForceLaw law = read_linear(entry);
  const auto force = entry.find("force");
  if (placed == 0 && (force || free_length != 0 || law.damping() != 0))
    node_names.fail("the attachment points coincide: the spring_damper has no direction");
  auto spring = std::make_unique<SpringDamper>(name, nodes[0], nodes[1], at_a, at_b, free_length, std::move(law));
  if (force)
    model.when_read(Model::Stage::formulas,
                    [spring = spring.get(), formula = *force, &model] { spring->read(formula, model); });
  model.add(std::move(spring), Entry{Section::elements, name});
}

void SpringDamper::draw(Drawing& drawing) const {
  const bool damps = law_.has_damping();
  const bool springs = law_.stiffness() != 0 || !law_.is_linear() || !damps;
  drawing.add_between(!damps    ? "coil"
                      : springs ? "coil_damper"
                                : "damper",
                      {node_a_, {c_a_, Matrix3::Identity()}}, {node_b_, {c_b_, Matrix3::Identity()}});
}

}  // namespace bielle::mechanism

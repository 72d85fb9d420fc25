#include "mechanism/joints/flexible/shaft_bearing.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "mechanism/measures/middle_frame.hpp"
#include "mechanism/measures/own_measure.hpp"
#include "mechanism/model/description.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

constexpr int bearing_x = 0, bearing_y = 1, bearing_z = 2;

std::vector<JointCoordinate> bearing_coordinates() {
  using Kind = JointCoordinate::Kind;
  return {{"x", Kind::displacement, bearing_x},
          {"y", Kind::displacement, bearing_y},
          {"z", Kind::displacement, bearing_z},
          {"tilt_x", Kind::rotation, JointCoordinate::by_type},
          {"tilt_y", Kind::rotation, JointCoordinate::by_type},
          {"angle", Kind::angle, bearing_z}};
}

/// theta/sin(theta) with its first two derivatives by c = cos(theta), -1 < c <= 1.
struct TiltFactor {
  double f, f1, f2;
  explicit TiltFactor(double c) {
    // f solves (1 - c^2) f' = c f - 1; near c = 1 the series in s = 1 - c:  sum of a_k s^k, a_k = a_(k-1) k/(2k + 1).
    const double s = 1 - c;
    if (s < 0.05) {
      double a = 1, power = 1;  // a_k, s^k
      f = 1;
      f1 = f2 = 0;
      double power_1 = 1, power_2 = 1;  // s^(k-1), s^(k-2)
      for (int k = 1; k < 16; ++k) {
        a *= k / (2.0 * k + 1);
        power *= s;
        f += a * power;
        f1 -= k * a * power_1;
        if (k > 1) {
          f2 += k * (k - 1) * a * power_2;
          power_2 *= s;
        }
        power_1 *= s;
      }
      return;
    }
    const double w = 1 - c * c;
    f = std::acos(c) / std::sqrt(w);
    f1 = (c * f - 1) / w;
    f2 = (f + 3 * c * f1) / w;
  }
};

constexpr const char* bearing_forces[] = {"x", "y", "z", "tilt_x", "tilt_y"};
constexpr std::size_t tilt_x = 3, tilt_y = 4, spin = 5;

}  // namespace

ShaftBearing::ShaftBearing(std::string type, std::string name, JointFrames frames,
                           std::shared_ptr<const BearingLaw> law, const Model& model)
    : Joint(std::move(type), std::move(name), std::move(frames), bearing_coordinates(), model), law_(std::move(law)) {}

template <int order>
ShaftBearing::Measures<order> ShaftBearing::calc_measures(const LocalState& state) const {
  Measures<order> measures;
  for (const int axis : {bearing_x, bearing_y, bearing_z})
    measures[static_cast<std::size_t>(axis)] = position<order>(axis, state);
  const auto shaft_along = [&](int axis) {
    return measure_alignment<order>(state.node(0), state.node(1), frames().on_first.R.col(axis),
                                    frames().on_second.R.col(bearing_z));
  };
  const auto c = shaft_along(bearing_z);
  const TiltFactor tilt(std::min(1.0, c.value));
  const auto factor = compose(c, tilt.f, tilt.f1, tilt.f2);
  measures[tilt_x] = -(factor * shaft_along(bearing_y));
  measures[tilt_y] = factor * shaft_along(bearing_x);
  measures[spin] = measure_angle<order>(state.node(0), state.node(1), frames().on_first.R, frames().on_second.R);
  return measures;
}

template <class Measure>
ShaftBearing::Motion ShaftBearing::motion(const LocalState& state, const std::array<Measure, 6>& measures) const {
  const Vector12 v = pair_rate(state.node(0), state.node(1));
  Motion motion;
  for (std::size_t k = 0; k < measures.size(); ++k) {
    motion.e[static_cast<Eigen::Index>(k)] = measures[k].value;
    motion.v[static_cast<Eigen::Index>(k)] = measures[k].rate(v);
  }
  motion.e[spin] = coordinate(spin, state).value;  // the angle includes its turns
  if (const std::string why = law_->refusal(motion.e); !why.empty())
    throw ComputationError(fmt::format("t = {:.6g} s: {} '{}': {}", state.time(), type(), name(), why));
  return motion;
}

void ShaftBearing::declare(Declaration& declaration) const {
  Joint::declare(declaration);
  declaration.stiffness = true;
  declaration.damping = law_->has_rates();
  declaration.kinks |= law_->has_kinks();
}

void ShaftBearing::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  const Measures<1> m = calc_measures<1>(state);
  const auto [e, v] = motion(state, m);
  const Vector6 N = law_->calc(e, v).N;
  for (std::size_t k = 0; k < m.size(); ++k) r.head<12>() += N[static_cast<Eigen::Index>(k)] * m[k].gradient;
}

namespace {

/// Derivatives of the forces by positions and velocities of the two nodes.
struct BearingSlopes {
  Eigen::Matrix<double, 6, 12> G, by_position, by_rate;
  BearingSlopes(const std::array<PairMeasure, 6>& m, const BearingLaw::Force& force, const Vector12& v) {
    Eigen::Matrix<double, 6, 12> turned;  // derivatives of the rates by positions
    for (std::size_t k = 0; k < m.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      G.row(i) = m[k].gradient.transpose();
      turned.row(i) = v.transpose() * m[k].second;
    }
    by_position = force.by_e * G + force.by_v * turned;
    by_rate = force.by_v * G;
  }
};

}  // namespace

void ShaftBearing::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (!tangent.wants_K && !(tangent.wants_C && law_->has_rates())) return;
  const Measures<2> m = calc_measures<2>(state);
  const auto [e, v] = motion(state, m);
  const BearingLaw::Force force = law_->calc(e, v);
  const BearingSlopes slopes(m, force, pair_rate(state.node(0), state.node(1)));
  if (tangent.wants_K) {
    Matrix12 K = slopes.G.transpose() * slopes.by_position;
    for (std::size_t k = 0; k < m.size(); ++k) K += force.N[static_cast<Eigen::Index>(k)] * m[k].second;
    tangent.K.dense().topLeftCorner<12, 12>() += K;
  }
  if (tangent.wants_C && law_->has_rates()) {
    const Matrix12 C = slopes.G.transpose() * slopes.by_rate;
    tangent.C.dense().topLeftCorner<12, 12>() += C;
  }
}

void ShaftBearing::add_energy(const LocalState& state, Energy& energy) const {
  const auto [e, v] = motion(state, calc_measures<1>(state));
  const BearingLaw::Potential potential = law_->potential(e);
  energy.elastic += potential.energy;
  Vector6 unturned = v;
  unturned[spin] = 0;
  const Vector6 at_rest = law_->calc(e, Vector6::Zero()).N, still = law_->calc(e, unturned).N;
  const double dissipated = (still - at_rest).dot(unturned);
  energy.dissipation += dissipated;
  energy.input -= (law_->calc(e, v).N - potential.N).dot(v) - dissipated;
}

std::vector<OutputField> ShaftBearing::output_fields() const {
  std::vector<OutputField> fields = Joint::output_fields();
  fields.push_back({"force", {5}, "N, N, N, N m, N m", "what the joint exerts along x, y, z, tilt_x, tilt_y"});
  return fields;
}

void ShaftBearing::write_output(const LocalState& state, double* values) const {
  Joint::write_output(state, values);
  const auto [e, v] = motion(state, calc_measures<1>(state));
  Eigen::Map<Eigen::Matrix<double, 5, 1>>(values + 2 * coordinates().size() + 12) = -law_->calc(e, v).N.head<5>();
}

double ShaftBearing::calc_force(const LocalState& state, Eigen::Index k, MeasureGradient& gradient) const {
  const Measures<2> m = calc_measures<2>(state);
  const auto [e, v] = motion(state, m);
  const BearingLaw::Force force = law_->calc(e, v);
  const BearingSlopes slopes(m, force, pair_rate(state.node(0), state.node(1)));
  gradient.position().head<12>() = -slopes.by_position.row(k).transpose();
  gradient.rate().head<12>() = -slopes.by_rate.row(k).transpose();
  return -force.N[k];
}

PairMeasure ShaftBearing::calc_own_coordinate(std::size_t index, const LocalState& state) const {
  return calc_measures<2>(state)[index];
}

PairSlope ShaftBearing::calc_own_slope(std::size_t index, const LocalState& state) const {
  return calc_measures<1>(state)[index];
}

void ShaftBearing::describe(const LocalState& state, Description& description) const {
  Joint::describe(state, description);
  for (const std::string& fact : law_->describe()) description.add_line(fact);
}

void ShaftBearing::accept(const LocalState& state, Eigen::Ref<VectorX> memory) const {
  Joint::accept(state, memory);
  const Measures<1> measures = calc_measures<1>(state);
  constexpr std::size_t entry = 2;  // the memory holds [value, rate] of each coordinate
  const Vector3 tilt(measures[tilt_x].value, measures[tilt_y].value, 0),
      before(memory[entry * tilt_x], memory[entry * tilt_y], 0);
  check_half_turn(
      state, fmt::format("{} '{}'", type(), name()), tilt, before,
      "For a part that tilts freely, take a `spherical` joint, or a `bushing` without stiffness of rotations");
  memory[entry * tilt_x] = tilt.x();
  memory[entry * tilt_y] = tilt.y();
}

namespace {

/// "shaft.force.x"
class BearingForceMeasure final : public OwnMeasure {
 public:
  BearingForceMeasure(std::string name, const ShaftBearing& bearing, Eigen::Index k)
      : OwnMeasure(std::move(name), bearing), bearing_(bearing), k_(k) {}
  std::string units() const override { return k_ < 3 ? "N" : "N m"; }

 private:
  double calc_own(const LocalState& own, MeasureGradient& gradient) const override {
    return bearing_.calc_force(own, k_, gradient);
  }
  const ShaftBearing& bearing_;
  Eigen::Index k_;
};

}  // namespace

std::vector<std::string> ShaftBearing::measure_names() const {
  std::vector<std::string> names = Joint::measure_names();
  for (const char* each : bearing_forces) names.push_back(fmt::format("force.{}", each));
  return names;
}

std::unique_ptr<Measure> ShaftBearing::make_measure(const std::string& name, const std::string& measure) const {
  for (Eigen::Index k = 0; k < 5; ++k)
    if (measure == fmt::format("force.{}", bearing_forces[k]))
      return std::make_unique<BearingForceMeasure>(name, *this, k);
  return Joint::make_measure(name, measure);
}

}  // namespace bielle::mechanism

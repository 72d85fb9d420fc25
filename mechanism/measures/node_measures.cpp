#include "mechanism/measures/node_measures.hpp"

#include <cmath>

#include <fmt/format.h>

#include "mechanism/math/axes_along.hpp"
#include "mechanism/measures/orientation_measures.hpp"
#include "mechanism/measures/pair_measure.hpp"
#include "mechanism/measures/pair_rotation.hpp"
#include "mechanism/measures/turn_measure.hpp"
#include "mechanism/model/description.hpp"

namespace bielle::mechanism {
namespace {

class NodePairMeasure : public Measure {
 public:
  NodePairMeasure(std::string name, const NodePair& pair) : Measure(std::move(name)), pair_(pair) {}

 protected:
  const NodePair& pair() const { return pair_; }
  /// Returns "'pin'", or "'pin' relative to 'arm'".
  std::string nodes(const Description& description) const {
    const std::string second = description.node(pair_.second);
    return pair_.first == 0 ? second : second + " relative to " + description.node(pair_.first);
  }
  void declare_subjects(Declaration& declaration) const final { declaration.nodes = {pair_.first, pair_.second}; }

 private:
  NodePair pair_;
};

class PositionMeasure final : public NodePairMeasure {
 public:
  PositionMeasure(std::string name, const NodePair& pair, const Vector3& direction, bool rate)
      : NodePairMeasure(std::move(name), pair), e_(direction), rate_(rate) {}
  std::string units() const override { return rate_ ? "m/s" : "m"; }
  double value(const LocalState& state) const override {
    const auto [value, rate] =
        measure_position_rate(state.node(0), state.node(1), e_, pair().at_first, pair().at_second);
    return rate_ ? rate : value;
  }
  double calc(const LocalState& state, MeasureGradient& gradient) const override {
    gradient.prepare(state.slots().size());
    const PairMeasure m = measure_position(state.node(0), state.node(1), e_, pair().at_first, pair().at_second);
    if (!rate_) {
      gradient.position() = m.gradient;
      return m.value;
    }
    const Vector12 v = pair_rate(state.node(0), state.node(1));
    gradient.position() = m.second.transpose() * v;
    gradient.rate() = m.gradient;
    return m.rate(v);
  }
  void describe(const LocalState& /*state*/, Description& description) const override {
    description.add(fmt::format("{} of node {} along {} [{}]", rate_ ? "velocity" : "position", nodes(description),
                                format_vector(e_), units()));
  }

 private:
  Vector3 e_;
  bool rate_;
};

/// A component of the rotation vector along a direction. The axes are those of the first node at the start, rotated so
/// that the direction is the first axis, and the component is the first one.
class RotationMeasure final : public NodePairMeasure {
 public:
  RotationMeasure(std::string name, const NodePair& pair, const Matrix3& A, const Matrix3& B, bool rate)
      : NodePairMeasure(std::move(name), pair), A_(A), B_(B), rate_(rate) {}
  std::string units() const override { return rate_ ? "rad/s" : "rad"; }
  double value(const LocalState& state) const override {
    const PairRotation rotation(state.node(0), state.node(1), A_, B_);
    return rate_ ? rotation.omega(state.node(0), state.node(1)).x() : rotation.psi().x();
  }
  double calc(const LocalState& state, MeasureGradient& gradient) const override {
    thread_local CoordinateDerivatives jet;
    gradient.prepare(state.slots().size());
    jet.prepare(12);
    PairRotation(state.node(0), state.node(1), A_, B_).calc(0, state.node(0), state.node(1), jet);
    if (!rate_) {
      gradient.position() = jet.g();
      return jet.value;
    }
    gradient.position() = jet.W().transpose() * pair_rate(state.node(0), state.node(1));
    gradient.rate() = jet.w();
    return jet.rate;
  }
  void describe(const LocalState& /*state*/, Description& description) const override {
    description.add(fmt::format("{} of node {} about {} [{}]", rate_ ? "angular velocity" : "rotation",
                                nodes(description), format_vector(A_.col(0)), units()));
  }

 private:
  Matrix3 A_, B_;
  bool rate_;
};

class DistanceMeasure final : public NodePairMeasure {
 public:
  using NodePairMeasure::NodePairMeasure;
  std::string units() const override { return "m"; }
  double value(const LocalState& state) const override { return way(state).norm(); }
  double calc(const LocalState& state, MeasureGradient& gradient) const override {
    gradient.prepare(state.slots().size());
    const Vector3 s = way(state);
    const double length = s.norm();
    // The distance has no derivative if the points coincide.
    if (length > 0) {
      const Vector3 u = s / length;
      auto g = gradient.position();
      g.segment<3>(0) = -u;
      g.segment<3>(3) = -pair().at_first.cross(state.node(0).R.transpose() * u);
      g.segment<3>(6) = u;
      g.segment<3>(9) = pair().at_second.cross(state.node(1).R.transpose() * u);
    }
    return length;
  }

 private:
  Vector3 way(const LocalState& state) const {
    const NodeState &first = state.node(0), &second = state.node(1);
    return second.x - first.x + second.R * pair().at_second - first.R * pair().at_first;
  }
};

class AngleMeasure final : public NodePairMeasure {
 public:
  using NodePairMeasure::NodePairMeasure;
  std::string units() const override { return "rad"; }
  double value(const LocalState& state) const override { return psi(state).norm(); }
  double calc(const LocalState& state, MeasureGradient& gradient) const override {
    gradient.prepare(state.slots().size());
    const Vector3 rotation = psi(state);
    const double angle = rotation.norm();
    // d|psi| = e . dphi with the axis e: it is the same for rotations from the left and from the right. It is undefined
    // at zero.
    if (angle > 0) {
      const Vector3 e = rotation / angle;
      gradient.position().segment<3>(3) = -e;
      gradient.position().segment<3>(9) = state.node(1).R.transpose() * (state.node(0).R * e);
    }
    return angle;
  }

 private:
  static Vector3 psi(const LocalState& state) {
    return log_so3(Matrix3(state.node(0).R.transpose() * state.node(1).R));
  }
};

/// Returns axes with e as the first one.
Matrix3 axes_with_first(const Vector3& e) {
  Matrix3 axes;
  axes.col(0) = e;
  axes.col(1) = e.cross(most_normal_axis(e)).normalized();
  axes.col(2) = e.cross(axes.col(1));
  return axes;
}

}  // namespace

std::unique_ptr<Measure> make_node_measure(const std::string& name, const Model& model, const NodePair& pair,
                                           NodeQuantity quantity, const Vector3& direction) {
  if (quantity == NodeQuantity::position || quantity == NodeQuantity::velocity)
    return std::make_unique<PositionMeasure>(name, pair, direction, quantity == NodeQuantity::velocity);
  const Matrix3 A = axes_with_first(direction);
  const Matrix3 B = model.node(pair.second).frame.R.transpose() * model.node(pair.first).frame.R * A;
  if (quantity == NodeQuantity::turn || quantity == NodeQuantity::turn_rate)
    return std::make_unique<TurnMeasure>(name, pair, A, B, quantity == NodeQuantity::turn_rate);
  return std::make_unique<RotationMeasure>(name, pair, A, B, quantity == NodeQuantity::angular_velocity);
}

std::unique_ptr<Measure> make_distance(const std::string& name, const NodePair& pair) {
  return std::make_unique<DistanceMeasure>(name, pair);
}

std::unique_ptr<Measure> make_angle(const std::string& name, const NodePair& pair) {
  return std::make_unique<AngleMeasure>(name, pair);
}

namespace {

struct AlongAxis {
  std::string before, after;  ///< parts of the name before and after the axis
  NodeQuantity quantity;
};
const std::vector<AlongAxis> along_axes = {
    {"position.", "", NodeQuantity::position}, {"velocity.", "", NodeQuantity::velocity},
    {"rotation.", "", NodeQuantity::rotation}, {"angular_velocity.", "", NodeQuantity::angular_velocity},
    {"turn.", "", NodeQuantity::turn},         {"turn.", ".rate", NodeQuantity::turn_rate}};
constexpr const char* axis_names[] = {"x", "y", "z"};

}  // namespace

const std::vector<std::string>& node_measure_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const AlongAxis& each : along_axes)
      for (const char* axis : axis_names) all.push_back(each.before + axis + each.after);
    all.insert(all.end(), orientation_measure_names().begin(), orientation_measure_names().end());
    return all;
  }();
  return names;
}

std::unique_ptr<Measure> make_node_measure(const std::string& name, const Model& model, int node,
                                           const std::string& measure) {
  for (const AlongAxis& each : along_axes)
    for (int k = 0; k < 3; ++k)
      if (measure == each.before + axis_names[k] + each.after)
        return make_node_measure(name, model, {0, node, Vector3::Zero(), Vector3::Zero()}, each.quantity,
                                 Vector3::Unit(k));
  return make_orientation_measure(name, node, measure);
}

}  // namespace bielle::mechanism

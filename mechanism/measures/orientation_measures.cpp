#include "mechanism/measures/orientation_measures.hpp"

#include <fmt/format.h>

#include "mechanism/math/rotation_parameters.hpp"
#include "mechanism/model/description.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

/// Local row of the first rotation of a measure's only node.
constexpr int first_turn = 3;

/// The parameter p_k of P, or its rate (T^-1 Omega)_k. Rotation increments are those of Omega: dp = T^-1 dTheta.
template <class P>
class OrientationMeasure final : public Measure {
 public:
  OrientationMeasure(std::string name, int node, Eigen::Index component, bool rate)
      : Measure(std::move(name)), node_(node), component_(component), rate_(rate) {}
  std::string units() const override { return rate_ ? "rad/s" : "rad"; }
  double value(const LocalState& state) const override {
    const Vector3 p = P::parameters(state.node(0).R);
    return rate_ ? inverse(p).row(component_).dot(state.node(0).Omega) : p[component_];
  }
  double calc(const LocalState& state, MeasureGradient& gradient) const override {
    gradient.prepare(state.slots().size());
    const Vector3 p = P::parameters(state.node(0).R);
    const Matrix3 T_inverse = inverse(p);
    const Vector3 row = T_inverse.row(component_).transpose();
    if (!rate_) {
      gradient.position().segment<3>(first_turn) = row;
      return p[component_];
    }
    const Vector3& Omega = state.node(0).Omega;
    for (int k = 0; k < 3; ++k) {
      const Matrix3 turned = P::tangent_inverse_derivative(p, T_inverse.col(k));
      gradient.position()[first_turn + k] = turned.row(component_).dot(Omega);
    }
    gradient.rate().segment<3>(first_turn) = row;
    return row.dot(Omega);
  }
  void describe(const LocalState& /*state*/, Description& description) const override {
    description.add(fmt::format("orientation of node {} [{}]", description.node(node_), units()));
  }

 private:
  void declare_subjects(Declaration& declaration) const override { declaration.nodes = {node_}; }
  Matrix3 inverse(const Vector3& p) const {
    try {
      return P::tangent_inverse(p);
    } catch (const ComputationError& singular) {
      throw ComputationError(fmt::format("measure '{}': {}", name(), singular.what()));
    }
  }
  int node_;
  Eigen::Index component_;
  bool rate_;
};

struct Orientation {
  const char* name;
  const char* components;
};
constexpr Orientation orientations[] = {{"rotation_vector", "xyz"}, {"bryant", "abc"}, {"euler", "abc"}};

}  // namespace

const std::vector<std::string>& orientation_measure_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const auto& [quantity, components] : orientations)
      for (int k = 0; k < 3; ++k)
        for (const char* rate : {"", ".rate"}) all.push_back(fmt::format("{}.{}{}", quantity, components[k], rate));
    return all;
  }();
  return names;
}

std::unique_ptr<Measure> make_orientation_measure(const std::string& name, int node, const std::string& measure) {
  const std::size_t dot = measure.find('.');
  const std::string quantity = measure.substr(0, dot);
  const char component = measure[dot + 1];
  const bool rate = measure.size() > dot + 2;
  if (quantity == "rotation_vector")
    return std::make_unique<OrientationMeasure<RotationVector>>(name, node, component - 'x', rate);
  if (quantity == "bryant")
    return std::make_unique<OrientationMeasure<BryantAngles>>(name, node, component - 'a', rate);
  return std::make_unique<OrientationMeasure<EulerAngles>>(name, node, component - 'a', rate);
}

}  // namespace bielle::mechanism

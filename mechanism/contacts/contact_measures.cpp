#include "mechanism/contacts/contact_measures.hpp"

namespace bielle::mechanism {

/// d gap = n . (v_2 - v_1) of the material at the place: moving the place along n changes nothing.
double GapMeasure::calc(const LocalState& state, MeasureGradient& gradient) const {
  gradient.prepare(state.slots().size());
  const LocalState local = state.of(0);
  const Contact::NearestPair nearest = contact_.nearest_of_all(local);
  if (nearest.pair < 0) return nearest.found.gap;
  const int first_row = state.slots().reference_row(0);
  const auto nodes = contact_.nodes_of(nearest.pair);
  for (const std::size_t side : {0UL, 1UL}) {
    const NodeState& node = local.node(nodes[side]);
    const Vector3 n = side == 1 ? nearest.found.normal : Vector3(-nearest.found.normal);
    const int row = first_row + 6 * nodes[side];
    gradient.position().segment<3>(row) += n;
    gradient.position().segment<3>(row + 3) += node.R.transpose() * (nearest.found.place - node.x).cross(n);
  }
  return nearest.found.gap;
}

double ContactForceMeasure::part(const Vector3& force, Vector3& along) const {
  if (direction_ < 3) {
    along = Vector3::Unit(direction_);
    return force[direction_];
  }
  const double size = force.norm();
  along = size > 0 ? Vector3(force / size) : Vector3::Zero();
  return size;
}

double ContactForceMeasure::value(const LocalState& state) const {
  double sum = 0;
  Vector3 along;
  contact_.for_each_touching(state.of(0), [&](int, const Vector3& force) { sum += part(force, along); });
  return sum;
}

double ContactForceMeasure::calc(const LocalState& state, MeasureGradient& gradient) const {
  gradient.prepare(state.slots().size());
  const LocalState local = state.of(0);
  const int first_row = state.slots().reference_row(0);
  double sum = 0;
  Vector3 along;
  Matrix12 K, C;
  contact_.for_each_touching(local, [&](int pair, const Vector3& force) {
    sum += part(force, along);
    contact_.calc_tangent_of(local, pair, K, C);
    const auto nodes = contact_.nodes_of(pair);
    // The residual of the first node's translation is the force on the second.
    for (const std::size_t side : {0UL, 1UL}) {
      const int row = first_row + 6 * nodes[side];
      const auto column = static_cast<Eigen::Index>(6 * side);
      gradient.position().segment<6>(row) += K.block<3, 6>(0, column).transpose() * along;
      gradient.rate().segment<6>(row) += C.block<3, 6>(0, column).transpose() * along;
    }
  });
  return sum;
}

double TouchingMeasure::value(const LocalState& state) const {
  double count = 0;
  contact_.for_each_touching(state.of(0), [&](int, const Vector3&) { ++count; });
  return count;
}

double TouchingMeasure::calc(const LocalState& state, MeasureGradient& gradient) const {
  gradient.prepare(state.slots().size());
  return value(state);
}

std::vector<std::string> Contact::measure_names() const {
  std::vector<std::string> names = {"gap", "touching", "force"};
  if (divided_) names.insert(names.end(), {"force.x", "force.y", "force.z"});
  return names;
}

std::unique_ptr<Measure> Contact::make_measure(const std::string& name, const std::string& measure) const {
  if (measure == "gap") return std::make_unique<GapMeasure>(name, *this);
  if (measure == "touching") return std::make_unique<TouchingMeasure>(name, *this);
  const int direction = measure == "force" ? 3 : measure.back() - 'x';
  return std::make_unique<ContactForceMeasure>(name, *this, direction);
}

}  // namespace bielle::mechanism

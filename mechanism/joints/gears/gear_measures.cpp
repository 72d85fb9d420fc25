// Measures of a gear mesh: "teeth.approach", "teeth.transmission_error", "teeth.force", "teeth.deformation" and so on.
#include <functional>

#include "mechanism/joints/gears/gear_mesh.hpp"
#include "mechanism/measures/own_measure.hpp"

namespace bielle::mechanism {
namespace {

/// A function of the positions of the nodes.
class MeshPositionMeasure final : public OwnMeasure {
 public:
  using Function = std::function<MeshSlope(const LocalState& own)>;
  MeshPositionMeasure(std::string name, const GearMesh& mesh, const char* units, Function function)
      : OwnMeasure(std::move(name), mesh), units_(units), function_(std::move(function)) {}
  std::string units() const override { return units_; }

 private:
  double calc_own(const LocalState& own, MeasureGradient& gradient) const override {
    const MeshSlope m = function_(own);
    gradient.position().head<18>() = m.gradient;
    return m.value;
  }
  const char* units_;
  Function function_;
};

class ToothForceMeasure final : public OwnMeasure {
 public:
  ToothForceMeasure(std::string name, const GearMesh& mesh) : OwnMeasure(std::move(name), mesh), mesh_(mesh) {}
  std::string units() const override { return "N"; }
  bool reads_reactions() const override { return mesh_.force_is_reaction(); }

 private:
  double calc_own(const LocalState& own, MeasureGradient& gradient) const override {
    return mesh_.calc_force(own, gradient);
  }
  const GearMesh& mesh_;
};

}  // namespace

std::vector<std::string> GearMesh::measure_names() const {
  return {"approach", "transmission_error", "force", "angle_1", "angle_2"};
}

std::vector<std::string> ElasticGearMesh::measure_names() const {
  std::vector<std::string> names = GearMesh::measure_names();
  names.insert(names.end(), {"deformation", "stiffness"});
  return names;
}

std::unique_ptr<Measure> GearMesh::make_measure(const std::string& name, const std::string& measure) const {
  const auto of_position = [&](const char* units, MeshPositionMeasure::Function function) {
    return std::make_unique<MeshPositionMeasure>(name, *this, units, std::move(function));
  };
  if (measure == "force") return std::make_unique<ToothForceMeasure>(name, *this);
  if (measure == "approach")
    return of_position("m", [this](const LocalState& own) { return contact_.approach<1>(contact_.geometry().t, own); });
  if (measure == "transmission_error")
    return of_position("m", [this](const LocalState& own) { return transmission_error(own); });
  for (const int wheel : {0, 1})
    if (measure == (wheel == 0 ? "angle_1" : "angle_2"))
      return of_position("rad", [this, wheel](const LocalState& own) { return contact_.turned<1>(wheel, own); });
  return Component::make_measure(name, measure);
}

std::unique_ptr<Measure> ElasticGearMesh::make_measure(const std::string& name, const std::string& measure) const {
  if (measure == "deformation")
    return std::make_unique<MeshPositionMeasure>(name, *this, "m",
                                                 [this](const LocalState& own) { return deformation(own); });
  if (measure == "stiffness")
    return std::make_unique<MeshPositionMeasure>(name, *this, "N/m",
                                                 [this](const LocalState& own) { return stiffness<1>(own); });
  return GearMesh::make_measure(name, measure);
}

}  // namespace bielle::mechanism

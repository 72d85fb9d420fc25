#include "mechanism/joints/flexible/bushing.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "mechanism/joints/actions/joint_actions.hpp"
#include "mechanism/joints/actions/joint_spring.hpp"
#include "mechanism/laws/read_elastic_law.hpp"
#include "mechanism/measures/middle_frame.hpp"
#include "mechanism/measures/read_measure.hpp"

namespace bielle::mechanism {
namespace {

std::vector<JointCoordinate> bushing_coordinates() {
  using Kind = JointCoordinate::Kind;
  return {{"x", Kind::displacement, JointCoordinate::by_type},
          {"y", Kind::displacement, JointCoordinate::by_type},
          {"z", Kind::displacement, JointCoordinate::by_type},
          {"rx", Kind::rotation, 0},
          {"ry", Kind::rotation, 1},
          {"rz", Kind::rotation, 2}};
}

}  // namespace

Bushing::Bushing(std::string name, JointFrames frames, const Model& model)
    : ElasticPair("bushing", std::move(name), std::move(frames), bushing_coordinates(),
                  ElasticLaw({"x", "y", "z", "rx", "ry", "rz"}, {false, false, false, true, true, true}), model) {}

void Bushing::calc_measures(const LocalState& state, ElasticLaw::Measures& measures, bool second) const {
  MiddleFrame(state.node(0), state.node(1), frames().on_first, frames().on_second).calc(measures, second);
}

namespace {

/// Returns whether a component refers to another one, directly or through its references.
bool depends_on(const Component& component, const Component& other, std::set<const Component*>& seen) {
  Declaration declaration;
  component.declare(declaration);
  return std::any_of(declaration.references.begin(), declaration.references.end(), [&](const Component* each) {
    return each == &other || (seen.insert(each).second && depends_on(*each, other, seen));
  });
}

}  // namespace

void Bushing::read_film_speed(const YamlValue& formula, Model& model) {
  law().film->speed = read_state_formula(formula, {"t"}, model, references_);
  if (std::set<const Component*> seen; depends_on(*this, *this, seen))
    formula.fail(fmt::format("depends on the bushing '{}' itself: expected the speed of something else", name()));
}

void Bushing::declare(Declaration& declaration) const {
  ElasticPair::declare(declaration);
  references_.declare(declaration);
}

void Bushing::add_break_points(std::vector<double>& times) const {
  ElasticPair::add_break_points(times);
  if (law().film) law().film->speed.add_break_points(0, times);
}

std::vector<TimeDependent::Formula> Bushing::time_formulas() const {
  if (!law().film) return {};
  return time_formulas_of(law().film->speed, "speed of the film", "rad/s");
}

void Bushing::accept(const LocalState& state, Eigen::Ref<VectorX> memory) const {
  Joint::accept(state, memory);
  const Vector3 psi = PairRotation(state.node(0), state.node(1), frames().on_first.R, frames().on_second.R).psi();
  const auto kept = [&](int k) { return 2 * (3 + k); };  // [value, rate] of rx, ry, rz
  Vector3 before;
  for (int k = 0; k < 3; ++k) before[k] = memory[kept(k)];
  check_half_turn(state, fmt::format("bushing '{}'", name()), psi, before,
                  "For a part that turns freely about an axis, take a `bearing` or a hinge");
  for (int k = 0; k < 3; ++k) memory[kept(k)] = psi[k];
}

namespace {

/// Returns the keys of joints that a bushing reads itself, or does not have.
std::vector<std::string> own_keys() {
  std::vector<std::string> own = keys::names_of(keys_of_elastic_law());
  own.insert(own.end(), {"rest", "friction"});
  return own;
}

}  // namespace

const KeyTable& bushing_keys() {
  static const KeyTable table{"a bushing",
                              "An elastic connection of two nodes by six stiffnesses, damping, curves, coefficients "
                              "over a speed, and hysteresis.",
                              keys::joined({joint_frame_keys(AxisNeed::optional), keys_of_elastic_law(),
                                            joint_action_keys(Moves::both, own_keys())})};
  return table;
}

void read_bushing(const std::string& name, const YamlValue& entry, Model& model) {
  auto made = std::make_unique<Bushing>(name, read_joint_frames(entry, model, AxisNeed::optional), model);
  const ElasticFormulas formulas = read_elastic_law(entry, made->law());
  Bushing& bushing = *made;
  const Entry of_bushing{Section::joints, name};
  model.add(std::move(made), of_bushing);
  if (formulas.film_speed)
    model.when_read(Model::Stage::formulas,
                    [&bushing, speed = *formulas.film_speed, &model] { bushing.read_film_speed(speed, model); });
  // The formulas act as springs on the bushing's coordinates, so that they may depend on the bushing itself.
  for (const auto& [k, formula] : formulas.curves) {
    auto spring = std::make_unique<JointSpring>(name, bushing, k, 0, 0);
    model.when_read(Model::Stage::formulas,
                    [added = spring.get(), formula, &model] { added->read(formula, false, model); });
    model.add(std::move(spring), of_bushing);
  }
  read_joint_actions(entry, bushing, model, own_keys());
}

}  // namespace bielle::mechanism

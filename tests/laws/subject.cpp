#include "tests/laws/subject.hpp"

#include <cmath>

#include "tests/support/temporary_folder.hpp"

namespace bielle::laws {

using mechanism::exp_so3;
using mechanism::Matrix3;
using mechanism::NodeState;
using mechanism::Vector3;

std::unique_ptr<mechanism::MechanismFile> read_sample(const Sample& sample, const std::string& text) {
  const test::TemporaryFolder folder;
  if (sample.files) sample.files(folder.path());
  return std::make_unique<mechanism::MechanismFile>(mechanism::read_mechanism_file(folder.file("model.yaml", text)));
}

VectorX Subject::position_units() const {
  VectorX units = VectorX::Ones(dense->size());
  for (int node = 0; node < dense->nodes(); ++node) units.segment<3>(6 * node).setConstant(scales.length);
  units.segment(dense->amplitude_begin(), dense->first_order_begin() - dense->amplitude_begin())
      .setConstant(scales.amplitude);
  units.segment(dense->first_order_begin(), dense->multiplier_begin() - dense->first_order_begin())
      .setConstant(scales.first_order);
  units.tail(dense->size() - dense->multiplier_begin()).setConstant(scales.multiplier);
  return units;
}

VectorX Subject::rate_units() const {
  VectorX units = scales.rate * position_units();
  units.tail(dense->size() - dense->multiplier_begin()).setZero();
  return units;
}

State Subject::random_state(double size, unsigned seed) const {
  test::Random random(seed);
  State state = dense->start();
  VectorX step = size * random.vector(dense->size()).cwiseProduct(position_units());
  step.head(6 * dense->nodes()) *= scales.deformation;
  dense->move(state, step);
  dense->move_rates(state, size * random.vector(dense->size()).cwiseProduct(rate_units()));
  dense->move_accelerations(state, size * scales.rate * random.vector(dense->size()).cwiseProduct(rate_units()));
  state.time = size * random.uniform(0, 1);
  if (size == 1)
    state =
        moved_rigidly(state, exp_so3(random.vector_of_length(random.uniform(1, 3))), random.vector3(3 * scales.length));
  return state;
}

std::vector<Subject> subjects(const Sample& sample) {
  std::shared_ptr<mechanism::MechanismFile> file = read_sample(sample, sample.model);
  std::vector<Subject> list;
  const auto& members = file->model.members();
  for (std::size_t m = 0; m < members.size(); ++m)
    if (members[m].component->name() == "it")
      for (const bool carried_axes : {true, false}) {
        auto dense = std::make_unique<DenseModel>(file->model, m, carried_axes);
        if (carried_axes || dense->size() > dense->multiplier_begin())
          list.push_back({file, std::move(dense), sample.scales, carried_axes});
      }
  return list;
}

std::vector<NamedState> law_states(const Subject& subject) {
  std::vector<NamedState> states;
  if (!subject.scales.kinks_unloaded)
    states = {{"reference", subject.dense->start()}, {"1e-8", subject.random_state(1e-8, 1)}};
  for (unsigned seed : {2U, 3U, 4U})
    states.push_back({"random " + std::to_string(seed), subject.random_state(1, seed)});
  return states;
}

State moved_rigidly(const State& state, const Matrix3& Q, const Vector3& translation) {
  State moved = state;
  for (NodeState& n : moved.nodes) {
    n.x = Q * n.x + translation;
    n.R = Q * n.R;
    n.v = Q * n.v;
    n.a = Q * n.a;
  }
  return moved;
}

std::string title(const Sample& sample) {
  return sample.variant.empty() ? sample.type : sample.type + " (" + sample.variant + ")";
}

}  // namespace bielle::laws

// The cost of setting up a system and of evaluating it once, as models grow: chains of hinged links, made in memory.
//
//   performance_mechanism_system [LINKS ...]      default 1000 10000 100000
//
// For each phase it prints the processor time, and its ratio per link to that of the previous chain: 1 if it is
// proportional to the size of the model. Names are requested of one unknown and one equation per link, over the whole
// model. Memory is the heap memory of the system, per entry of the tangent's pattern, and the highest resident memory
// so far.
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <malloc.h>

#include "mechanism/elements/rigid_body/rigid_body.hpp"
#include "mechanism/joints/pairs/lower_pairs.hpp"
#include "mechanism/system/system.hpp"
#include "reduce/common/progress.hpp"
#include "tests/performance/processor_time.hpp"

namespace {

using namespace bielle;
using namespace bielle::mechanism;
using namespace bielle::performance;

/// Links of 1 m and 1 kg along x. A hinge about y connects each link with the previous one, and the first one with the
/// ground.
void add_chain(Model& model, int links) {
  MassProperties link;
  link.mass = 1;
  link.inertia.diagonal() << 1e-3, 1.0 / 12, 1.0 / 12;
  Matrix3 axes;  // z along the axis of the hinge
  axes.col(0) = Vector3::UnitZ();
  axes.col(1) = Vector3::UnitX();
  axes.col(2) = Vector3::UnitY();
  for (int k = 0, before = 0; k < links; ++k) {
    Node node;
    node.name = fmt::format("n{}", k);
    node.frame.x = {k + 0.5, 0, 0};
    const int index = model.add_node(node);
    const std::string body = fmt::format("e{}", k), joint = fmt::format("j{}", k);
    model.add(std::make_unique<RigidBody>("rigid_body", body, index, link, node.name), {Section::elements, body});
    JointFrames frames{before, index, {}, {}};
    frames.on_first.x = {before == 0 ? 0 : 0.5, 0, 0};
    frames.on_second.x = {-0.5, 0, 0};
    frames.on_first.R = frames.on_second.R = axes;
    model.add(std::make_unique<LowerPair>("hinge", joint, frames, std::vector<JointCoordinate>{},
                                          LockedMotions{{true, true, true}, LockedMotions::Rotation::tilt}, model),
              {Section::joints, joint});
    before = index;
  }
}

double heap_bytes() {
  const struct mallinfo2 heap = mallinfo2();
  return static_cast<double>(heap.uordblks + heap.hblkhd);
}

struct Phase {
  std::string name;
  double seconds;
};

class Phases {
 public:
  void measure(const std::string& name, const std::function<void()>& act) {
    const double start = processor_seconds();
    act();
    phases_.push_back({name, processor_seconds() - start});
  }
  const std::vector<Phase>& all() const { return phases_; }

 private:
  std::vector<Phase> phases_;
};

/// Returns the last row of each hinge.
std::vector<int> one_of_each(const System& system) {
  std::vector<int> result;
  for (const Slots& slots : system.slots())
    if (slots.multipliers > 0) result.push_back(slots.multiplier_begin + slots.multipliers - 1);
  return result;
}

void ask_names(const System& system, int count) {
  std::size_t letters = 0;
  for (int k = 0; k < count; ++k) {
    const auto unknown = static_cast<int>(static_cast<long>(system.size()) * k / count);
    letters += system.unknown_name(unknown).size() + system.equation_name(unknown).size() +
               system.equation_units(unknown).size();
  }
  if (letters == 0) std::abort();
}

void evaluate(const System& system, const Environment& environment, const State& state, Phases& phases) {
  VectorX r(system.size()), dq = VectorX::Constant(system.dofs(), 1e-3);
  ResidualScale scale;
  std::vector<double> values;
  const TangentWeights weights{1, 2e3, 4e6, 0, 1};
  for (int round = 0; round < 2; ++round) {  // the first call touches the memory
    phases.measure("residual", [&] { system.residual(state, environment, r, &scale); });
    phases.measure("tangent", [&] { system.tangent(state, environment, weights, &dq, values); });
  }
  phases.measure("energy", [&] { system.energy(state, environment); });
}

std::vector<Phase> measure(int links) {
  Phases phases;
  Model model;
  phases.measure("model", [&] { add_chain(model, links); });
  const double before = heap_bytes();
  std::unique_ptr<System> system;
  phases.measure("system", [&] { system = std::make_unique<System>(model); });
  phases.measure("nothing set aside", [&] { system->set_aside({}); });
  const double bytes = heap_bytes() - before;
  const int entries = system->pattern().entry_count();
  fmt::print("\n{} links: {} equations, {} entries, {:.1f} bytes each in {:.0f} MB; highest so far {:.0f} MB\n", links,
             system->size(), entries, bytes / entries, bytes / 1e6, peak_memory_MB());
  phases.measure("members of components", [&] {
    for (const Member& member : model.members())
      if (system->slots_of(*member.component).nodes.empty()) std::abort();
  });
  phases.measure("names", [&] { ask_names(*system, links); });
  State state;
  phases.measure("start", [&] { state = system->start(0); });
  evaluate(*system, model.environment, state, phases);
  const std::vector<int> rows = one_of_each(*system);
  phases.measure("one of each set aside", [&] { system->set_aside(rows); });
  std::vector<double> values;
  phases.measure("tangent with idle rows",
                 [&] { system->tangent(state, model.environment, TangentWeights{}, nullptr, values); });
  return phases.all();
}

}  // namespace

int main(int count, char** arguments) {
  std::vector<int> chains;
  for (int k = 1; k < count; ++k) chains.push_back(std::atoi(arguments[k]));
  if (chains.empty()) chains = {1000, 10000, 100000};
  std::vector<Phase> smaller;
  int smaller_links = 0;
  for (const int links : chains) {
    const std::vector<Phase> phases = measure(links);
    for (std::size_t k = 0; k < phases.size(); ++k) {
      const double per_link = phases[k].seconds / links;
      fmt::print("  {:<26} {:10.3f} ms {:9.1f} ns per link", phases[k].name, 1e3 * phases[k].seconds, 1e9 * per_link);
      if (!smaller.empty()) fmt::print(" {:7.2f}", per_link / (smaller[k].seconds / smaller_links));
      fmt::print("\n");
    }
    smaller = phases;
    smaller_links = links;
  }
  return 0;
}

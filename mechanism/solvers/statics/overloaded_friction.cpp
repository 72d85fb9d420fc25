#include "mechanism/solvers/statics/overloaded_friction.hpp"

#include <fmt/format.h>

#include "mechanism/model/sticking_part.hpp"

namespace bielle::mechanism {
namespace {

template <class Act>
void for_each_sticking(const System& system, const State& state, const Environment& environment, const Act& act) {
  const auto& members = system.model().members();
  for (std::size_t m = 0; m < members.size(); ++m)
    if (const auto* part = dynamic_cast<const StickingPart*>(members[m].component.get());
        part && system.is_active(state, m))
      act(members[m], *part, LocalState(state, system.slots()[m], environment));
}

}  // namespace

std::string describe_overloaded_friction(const LoadRamp& ramp, Equilibrium& equilibrium, double factor,
                                         const State& state) {
  const System& system = ramp.system();
  std::vector<char> held = state.held;
  held.resize(static_cast<std::size_t>(system.first_orders()), 0);
  bool any = false;
  for_each_sticking(system, state, ramp.environment(factor),
                    [&](const auto&, const StickingPart& part, const auto& own) {
                      part.hold(own, held);
                      any = true;
                    });
  if (!any) return {};
  for (const double load : {1.0, factor}) {
    State stuck = state;
    stuck.held = held;
    if (equilibrium.find(load, stuck) < 0 && equilibrium.search(load, stuck) < 0) continue;
    std::string text;
    for_each_sticking(system, stuck, ramp.environment(load),
                      [&](const auto& member, const auto& part, const auto& own) {
                        if (const std::string clause = part.describe_overload(own); !clause.empty())
                          text += fmt::format("; {} {}", describe(member), clause);
                      });
    return text;
  }
  return {};
}

}  // namespace bielle::mechanism

// The order of a scheme from a model's own solutions at h, h/2, h/4, ...: the difference of two neighbours is the error
// of the coarser one less a quarter of it, so that its quotients are those of the errors. Every step of the coarser run
// counts, the first one too.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/support/run_model.hpp"

namespace bielle::test {

/// The kinds of unknowns whose order is tested.
inline const std::vector<std::string> track_kinds = {"positions", "velocities", "multipliers", "first-order unknowns"};

/// The values of each kind of unknown in each step of a run.
using Track = std::vector<std::vector<mechanism::VectorX>>;

inline std::vector<mechanism::VectorX> values_by_kind(const mechanism::State& state) {
  const auto nodes = static_cast<Eigen::Index>(state.nodes.size());
  mechanism::VectorX position(12 * nodes), velocity(6 * nodes);
  for (Eigen::Index i = 0; i < nodes; ++i) {
    const mechanism::NodeState& node = state.nodes[static_cast<std::size_t>(i)];
    position.segment<12>(12 * i) << node.x, node.R.reshaped();
    velocity.segment<6>(6 * i) << node.v, node.Omega;
  }
  return {position, velocity, state.multiplier, state.first_order};
}

/// Returns a run of 2 `span` in steps of h, and from the middle on of `factor` h.
inline Track track(const ReadyModel& model, const mechanism::Scheme& scheme, mechanism::ConstraintForm form, double h,
                   double span, double factor) {
  mechanism::TimeIntegration integration(model.system, model.environment(), scheme, model.system.start(0), form);
  Track track = {values_by_kind(integration.state())};
  integration.start(h);
  const auto go = [&](double size) {
    for (long k = 0; k < std::lround(span / size); ++k) {
      integration.step(size);
      track.push_back(values_by_kind(integration.state()));
    }
  };
  go(h);
  integration.change_step(factor * h);
  go(factor * h);
  return track;
}

/// Returns the largest difference of two runs over the steps of the coarser one, by kind. The other has twice its
/// steps.
inline std::vector<double> largest_differences(const Track& coarse, const Track& fine) {
  REQUIRE(fine.size() == 2 * coarse.size() - 1);
  std::vector<double> largest(track_kinds.size(), 0.0);
  for (std::size_t kind = 0; kind < largest.size(); ++kind)
    for (std::size_t k = 0; k < coarse.size(); ++k)
      if (coarse[k][kind].size() > 0)
        largest[kind] = std::max(largest[kind], (coarse[k][kind] - fine[2 * k][kind]).cwiseAbs().maxCoeff());
  return largest;
}

/// Checks order 2 of every kind over four halvings.
/// @param margin  tolerance of the observed order: the next term of the error's series
inline void check_order_two(const ReadyModel& model, const mechanism::Scheme& scheme, mechanism::ConstraintForm form,
                            double h, double span, double factor, double margin) {
  const auto run = [&](double size) { return track(model, scheme, form, size, span, factor); };
  Track coarse = run(h), fine = run(h / 2);
  std::vector<double> before = largest_differences(coarse, fine);
  for (int halving = 0; halving < 4; ++halving) {
    h /= 2;
    coarse = std::move(fine);
    fine = run(h / 2);
    const std::vector<double> after = largest_differences(coarse, fine);
    for (std::size_t kind = 0; kind < after.size(); ++kind) {
      if (before[kind] == 0) continue;
      INFO(track_kinds[kind] << ", step change by " << factor << ", h = " << h << ": " << before[kind] << " -> "
                             << after[kind]);
      CHECK(std::log2(before[kind] / after[kind]) == Approx(2).margin(margin));
    }
    before = after;
  }
}

}  // namespace bielle::test

// Interface of components that act at instants of a clock, and not between them (sampled controllers).
//
// Steps of a motion end at these instants. The values that are due are computed from the state at the end of a step,
// and kept in memory until the next instant. If a value that others read changes, forces may jump: another branch of
// the motion begins there with it. The state at the end of the step, which is recorded, is the one just before. All
// other analyses keep the values.
#pragma once

#include <vector>

#include "mechanism/model/state.hpp"

namespace bielle::mechanism {

class Sampler {
 public:
  /// The times first + k*period, k = 0, 1, 2, ..
  struct Instants {
    double first = 0;   ///< [s] >= 0
    double period = 0;  ///< [s] > 0
  };
  virtual ~Sampler() = default;
  virtual std::vector<Instants> instants() const = 0;
  /// Computes the values that are due at the state's time, up to rounding, or overdue at the beginning of a motion.
  /// @param state   state of the component; it shows the values that samplers before this one have written already
  /// @param memory  memory of all components: the sampler writes its own, and that of components that it refers to
  /// @returns whether a value that others read has changed
  /// @throws ComputationError if a value is not a finite number
  virtual bool sample(const LocalState& state, Eigen::Ref<VectorX> memory) const = 0;
};

}  // namespace bielle::mechanism

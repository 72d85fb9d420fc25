// The echoes of a mechanism: components whose values repeat those of earlier times.
#pragma once

#include <vector>

#include "mechanism/model/echo.hpp"
#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// The system must outlive it.
class Echoes {
 public:
  explicit Echoes(const System& system);
  bool none() const { return echoes_.empty(); }
  /// Stores the values just after a discontinuity. @param state  consistent, just after it @param time  its time [s]
  void note_jump(State& state, const Environment& environment, double time) const;
  /// Returns the first time after `after` at which an earlier jump comes back [s]; infinity if none does.
  double next(const State& state, const Environment& environment, double after) const;
  /// Makes all echoes return present values, for small motions about a state.
  void forget(State& state) const;

 private:
  struct Placed {
    const Echo* echo;
    std::size_t member;
  };
  template <class Change>
  void change_memory(State& state, const Change& change) const;
  const System& system_;
  std::vector<Placed> echoes_;
};

}  // namespace bielle::mechanism

// Between steps of a computation without Python's lock: Ctrl-C is heard, callbacks are called.
#pragma once

#include <chrono>

#include <pybind11/pybind11.h>

#include "mechanism/python/gate.hpp"

namespace bielle::python {

/// What Python wants to be told of while something computes; None: nothing.
struct Callbacks {
  pybind11::object on_step = pybind11::none();   ///< called without arguments
  pybind11::object on_event = pybind11::none();  ///< called with time and name
};

class Interruptible {
 public:
  /// @param gate  of the session that computes, or nullptr @param callbacks  nullptr: none; must outlive this object
  explicit Interruptible(Gate* gate = nullptr, const Callbacks* callbacks = nullptr)
      : gate_(gate), callbacks_(callbacks) {}

  /// Called without the lock, which is taken only for callbacks and now and then for signals.
  /// @throws pybind11::error_already_set what a callback or the handler of a signal raises (KeyboardInterrupt)
  void step();
  void event(double time, const std::string& name);

 private:
  Gate* gate_;
  const Callbacks* callbacks_;
  std::chrono::steady_clock::time_point heard_ = std::chrono::steady_clock::now();
};

}  // namespace bielle::python

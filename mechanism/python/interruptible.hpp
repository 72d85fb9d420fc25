// Handles signals (Ctrl-C) and callbacks between steps of a computation without Python's lock.
#pragma once

#include <chrono>

#include <pybind11/pybind11.h>

#include "mechanism/python/gate.hpp"

namespace bielle::python {

/// Callbacks of Python during a computation; None: no callback.
struct Callbacks {
  pybind11::object on_step = pybind11::none();   ///< called without arguments
  pybind11::object on_event = pybind11::none();  ///< called with time and name
};

class Interruptible {
 public:
  /// @param gate  gate of the session that computes, or nullptr @param callbacks  nullptr: none; must outlive this
  ///              object
  explicit Interruptible(Gate* gate = nullptr, const Callbacks* callbacks = nullptr)
      : gate_(gate), callbacks_(callbacks) {}

  /// Call it without the lock, which is taken only for callbacks and at intervals for signals.
  /// @throws pybind11::error_already_set the exception of a callback or of a signal handler (KeyboardInterrupt)
  void step();
  void event(double time, const std::string& name);

 private:
  Gate* gate_;
  const Callbacks* callbacks_;
  std::chrono::steady_clock::time_point heard_ = std::chrono::steady_clock::now();
};

}  // namespace bielle::python

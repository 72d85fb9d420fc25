#include "mechanism/python/interruptible.hpp"

#include <optional>

#include "mechanism/python/without_lock.hpp"

namespace bielle::python {
namespace {

constexpr std::chrono::milliseconds hearing_period{20};

}  // namespace

void Interruptible::step() {
  end_with_program();
  const bool call = callbacks_ && !callbacks_->on_step.is_none();
  const auto now = std::chrono::steady_clock::now();
  const bool hear = now - heard_ >= hearing_period;
  if (!call && !hear) return;
  const pybind11::gil_scoped_acquire lock;
  std::optional<Gate::Calling> calling;
  if (gate_) calling.emplace(*gate_);
  if (hear) {
    heard_ = now;
    if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
  }
  if (call) callbacks_->on_step();
}

void Interruptible::event(double time, const std::string& name) {
  end_with_program();
  if (!callbacks_ || callbacks_->on_event.is_none()) return;
  const pybind11::gil_scoped_acquire lock;
  std::optional<Gate::Calling> calling;
  if (gate_) calling.emplace(*gate_);
  callbacks_->on_event(time, name);
}

}  // namespace bielle::python

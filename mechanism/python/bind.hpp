// The parts of the module `bielle._core`, each in its own source. The package bielle/ defines their interface for
// users.
#pragma once

#include <pybind11/pybind11.h>

namespace bielle::python {

void bind_errors(pybind11::module_& module);
void bind_model(pybind11::module_& module);
void bind_state(pybind11::module_& module);
void bind_recorder(pybind11::module_& module);
void bind_session(pybind11::module_& module);
void bind_motion(pybind11::module_& module);
void bind_run(pybind11::module_& module);
void bind_rotations(pybind11::module_& module);

}  // namespace bielle::python

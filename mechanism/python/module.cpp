// bielle._core: the functions that the package `bielle` calls.
#include "mechanism/python/bind.hpp"
#include "mechanism/python/without_lock.hpp"

PYBIND11_MODULE(_core, module) {
  using namespace bielle::python;
  module.doc() = "The compiled part of the package bielle, which is to be used in its place.";
  module.attr("version") = BIELLE_VERSION;
  bind_errors(module);
  bind_model(module);
  bind_state(module);
  bind_recorder(module);
  bind_session(module);
  bind_motion(module);
  bind_run(module);
  bind_rotations(module);
  bind_end(module);
}

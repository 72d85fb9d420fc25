// bielle._core: the functions that the package `bielle` calls.
#include "mechanism/python/bind.hpp"
#include "mechanism/python/without_lock.hpp"
#include "reduce/common/build.hpp"
#include "reduce/common/explanations.hpp"

PYBIND11_MODULE(_core, module) {
  using namespace bielle::python;
  module.doc() = "The compiled part of the package bielle, which is to be used in its place.";
  module.attr("version") = BIELLE_VERSION;
  module.attr("commit") = bielle::commit();
  module.def(
      "explain",
      [](const std::string& text) {
        return bielle::explain(bielle::read_explanations(bielle::explanation_pages()), text);
      },
      "Cause and cure of a message: its name, the message itself, or words; `all` lists the names.",
      pybind11::arg("text"));
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

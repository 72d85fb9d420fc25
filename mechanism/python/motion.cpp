// Motions: steps, and their cost.
#include <pybind11/stl.h>

#include "mechanism/analyses/summary_text.hpp"
#include "mechanism/python/bind.hpp"
#include "mechanism/python/held_motion.hpp"

namespace bielle::python {
namespace {

namespace py = pybind11;
using namespace mechanism;

py::dict log_of(HeldMotion& held) {
  const MarchLog& log = held.readable().log();
  py::dict found;
  found["steps"] = log.steps;
  found["iterations"] = log.iterations;
  found["factorisations"] = log.factorisations;
  found["shortened"] = log.shortened;
  found["refused_by_error"] = log.refused_by_error;
  found["refused_by_newton"] = log.refused_by_newton;
  found["crossings"] = log.crossings;
  found["smallest_step"] = log.smallest;
  found["largest_step"] = log.largest;
  found["hardest"] = log.hardest;
  return found;
}

}  // namespace

void bind_motion(py::module_& module) {
  py::class_<HeldMotion>(module, "Motion")
      .def("step",
           [](HeldMotion& held, const Callbacks& callbacks) {
             return held.compute(callbacks, [](Motion& motion) { return motion.step(); });
           })
      .def("advance_to",
           [](HeldMotion& held, double time, const Callbacks& callbacks) {
             return held.compute(callbacks, [time](Motion& motion) { return motion.advance_to(time); });
           })
      .def("finish",
           [](HeldMotion& held, const Callbacks& callbacks) {
             return held.compute(callbacks, [](Motion& motion) { return motion.finish(); });
           })
      .def("done", [](HeldMotion& held) { return held.readable().done(); })
      .def("stopped_by_event", [](HeldMotion& held) { return held.readable().stopped_by_event(); })
      .def("last_event", [](HeldMotion& held) { return held.readable().last_event(); })
      .def("begin", [](HeldMotion& held) { return held.readable().begin(); })
      .def("end", [](HeldMotion& held) { return held.readable().end(); })
      .def("time", [](HeldMotion& held) { return held.readable().time(); })
      .def("state", [](HeldMotion& held) { return std::make_shared<State>(held.readable().state()); })
      .def("interpolated",
           [](HeldMotion& held, double time) { return std::make_shared<State>(held.readable().interpolated(time)); })
      .def("balance", [](HeldMotion& held) { return held.readable().balance(); })
      .def("start", [](HeldMotion& held) { return format_start(held.readable().start()); })
      .def("log", log_of);
}

}  // namespace bielle::python

// The exceptions of the package, with the messages of the programs.
#include <typeinfo>

#include <pybind11/stl.h>

#include "mechanism/python/bind.hpp"
#include "mechanism/python/texts.hpp"
#include "reduce/common/error.hpp"

namespace bielle::python {
namespace {

// The references are borrowed from the module, which is never destroyed.
PyObject *any_error = nullptr, *input_error = nullptr, *computation_error = nullptr;

void set(PyObject* type, const std::exception& thrown) {
  PyErr_SetString(type, without_unseen_lines(thrown.what()).c_str());
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const InputError& wrong) {
    set(input_error, wrong);
  } catch (const ComputationError& failed) {
    set(computation_error, failed);
  } catch (const std::logic_error& refused) {
    // std::out_of_range and similar ones become exceptions of Python.
    if (typeid(refused) != typeid(std::logic_error)) throw;
    set(any_error, refused);
  }
}

PyObject* add(pybind11::module_& module, const char* name, const char* doc, PyObject* base) {
  PyObject* type = PyErr_NewExceptionWithDoc((std::string("bielle.") + name).c_str(), doc, base, nullptr);
  if (!type) throw pybind11::error_already_set();
  module.add_object(name, type);
  return type;
}

}  // namespace

void bind_errors(pybind11::module_& module) {
  any_error =
      add(module, "Error", "Base of the errors of Bielle: InputError, ComputationError, and calls at the wrong time.",
          PyExc_Exception);
  input_error =
      add(module, "InputError",
          "The input is wrong. The sentence names the file or text, the line and key, what was expected and the "
          "nearest valid name.",
          any_error);
  computation_error =
      add(module, "ComputationError",
          "A correct input led to a computation that failed. The sentence names the cause: which joint, "
          "which element, which time.",
          any_error);
  pybind11::register_local_exception_translator(translate);
  module.def("did_you_mean", [](const std::string& name, const std::vector<std::string>& candidates) {
    return did_you_mean(name, candidates);
  });
}

}  // namespace bielle::python

// Reading of recorded results.
#include "mechanism/python/recorder.hpp"

#include <pybind11/stl.h>

#include "mechanism/python/arrays.hpp"
#include "mechanism/python/bind.hpp"
#include "reduce/common/error.hpp"

namespace bielle::python {
namespace {

namespace py = pybind11;
using namespace mechanism;
using Recorded = MemorySink::Recorded;
using HeldRecorder = std::shared_ptr<Recorder>;

const Recorded& recorded(const Recorder& recorder, std::size_t analysis) {
  if (recorder.gate) recorder.gate->check_readable();
  return recorder.memory.analyses().at(analysis);
}

std::vector<std::string> names_of(const Recorder& recorder, const Recorded& analysis) {
  std::vector<std::string> names = {"time"};
  for (const ResultsColumn& column : recorder.memory.columns()) names.push_back(column.dataset);
  for (const auto& [name, array] : analysis.arrays) names.push_back(name);
  for (const auto& [name, texts] : analysis.names) names.push_back(name);
  return names;
}

/// Returns a view of complete data, or a copy of data that still grow. @param shape  shape of all rows @param strides
/// in numbers
py::array_t<double> rows(const HeldRecorder& recorder, std::size_t analysis, const double* data,
                         const std::vector<std::size_t>& shape, const std::vector<std::size_t>& strides) {
  py::array_t<double> view = view_array(data, shape, strides, py::cast(recorder), false);
  if (recorder->memory.stays(analysis)) return view;
  return view.attr("copy")().cast<py::array_t<double>>();
}

py::object read(const HeldRecorder& recorder, std::size_t k, const std::string& dataset) {
  const Recorded& analysis = recorded(*recorder, k);
  const std::size_t count = analysis.time.size();
  if (dataset == "time") return rows(recorder, k, analysis.time.data(), {count}, {1});
  if (const auto array = analysis.arrays.find(dataset); array != analysis.arrays.end())
    return number_or_array(std::vector<double>(array->second.values), array->second.shape);
  if (const auto names = analysis.names.find(dataset); names != analysis.names.end()) return py::cast(names->second);
  const std::optional<ResultsColumn> column = recorder->memory.find(dataset);
  if (!column)
    throw InputError("nothing was recorded as '" + dataset + "'" +
                     did_you_mean(dataset, names_of(*recorder, analysis)));
  std::vector<std::size_t> shape = column->shape, strides = packed_strides(column->shape);
  shape.insert(shape.begin(), count);
  strides.insert(strides.begin(), recorder->memory.row_size());
  return rows(recorder, k, count == 0 ? nullptr : analysis.values.data() + column->begin, shape, strides);
}

/// Maps name -> (shape of a row or array, units, description, whether it has rows).
py::dict datasets(const Recorder& recorder, std::size_t k) {
  const Recorded& analysis = recorded(recorder, k);
  py::dict found;
  for (const ResultsColumn& column : recorder.memory.columns())
    found[py::str(column.dataset)] =
        py::make_tuple(py::tuple(py::cast(column.shape)), column.units, column.description, true);
  for (const auto& [name, array] : analysis.arrays)
    found[py::str(name)] = py::make_tuple(py::tuple(py::cast(array.shape)), array.units, array.description, false);
  for (const auto& [name, names] : analysis.names)
    found[py::str(name)] = py::make_tuple(py::make_tuple(names.size()), "-", "texts", false);
  return found;
}

std::vector<std::pair<double, std::string>> events(const Recorder& recorder, std::size_t k) {
  std::vector<std::pair<double, std::string>> found;
  for (const Event& event : recorded(recorder, k).events) found.emplace_back(event.time, event.name);
  return found;
}

}  // namespace

void bind_recorder(py::module_& module) {
  py::class_<Recorder, HeldRecorder>(module, "Recorder")
      .def("__len__",
           [](const Recorder& recorder) {
             if (recorder.gate) recorder.gate->check_readable();
             return recorder.memory.analyses().size();
           })
      .def("type", [](const Recorder& recorder, std::size_t k) { return recorded(recorder, k).type; })
      .def("rows", [](const Recorder& recorder, std::size_t k) { return recorded(recorder, k).time.size(); })
      .def("read", read)
      .def("datasets", datasets)
      .def("events", events);
}

}  // namespace bielle::python

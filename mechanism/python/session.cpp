// Sessions: analyses, reading, inputs, saving, recording.
#include <pybind11/stl.h>

#include "mechanism/analyses/analysis_table.hpp"
#include "mechanism/analyses/dynamic_analysis.hpp"
#include "mechanism/io/run_analyses.hpp"
#include "mechanism/python/arrays.hpp"
#include "mechanism/python/bind.hpp"
#include "mechanism/python/held_motion.hpp"
#include "mechanism/python/texts.hpp"
#include "reduce/common/error.hpp"
#include "reduce/common/files/file_checks.hpp"

namespace bielle::python {
namespace {

namespace py = pybind11;
using namespace mechanism;
using HeldSession = std::shared_ptr<WorkingSession>;
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

std::vector<double> to_vector(const Numbers& numbers) { return {numbers.data(), numbers.data() + numbers.size()}; }

std::unique_ptr<Analysis> read_keys(const std::string& text, const std::string& name, const MechanismFile& file) {
  YamlValue entry = YamlValue::parse(text, name + unseen);
  entry.set_parameters(file.model.parameters);
  std::unique_ptr<Analysis> analysis = read_analysis(entry, file.model);
  analysis->set_maker(file.maker);
  return analysis;
}

/// Returns summary, numbers, rows.
py::tuple run(WorkingSession& working, const Analysis& analysis, const Callbacks& callbacks) {
  const AnalysisSummary summary = working.compute(callbacks, [&](Session& session) {
    working.close_motion(session);
    try {
      return analysis.run(session);
    } catch (...) {
      working.abandon(session);
      throw;
    }
  });
  return py::make_tuple(without_unseen_lines(summary.text), summary.numbers, summary.records);
}

std::unique_ptr<HeldMotion> start_motion(const HeldSession& working, const std::string& text,
                                         const std::optional<Numbers>& saved, const Callbacks& callbacks) {
  const std::vector<double> numbers = saved ? to_vector(*saved) : std::vector<double>();
  const std::unique_ptr<Analysis> analysis = read_keys(text, "Session.dynamics", *working->model());
  const auto& dynamic = dynamic_cast<const DynamicAnalysis&>(*analysis);
  std::unique_ptr<Motion> motion = working->compute(callbacks, [&](Session& session) {
    working->close_motion(session);
    working->open_motion(session, dynamic.expected_rows(session.recording()));
    try {
      // (A motion cannot be moved.)
      return saved ? std::unique_ptr<Motion>(new Motion(session.dynamics(dynamic.options(), numbers)))
                   : std::unique_ptr<Motion>(new Motion(session.dynamics(dynamic.options())));
    } catch (...) {
      working->abandon(session);
      throw;
    }
  });
  return std::make_unique<HeldMotion>(working, std::move(motion));
}

py::object read_dataset(WorkingSession& working, const std::string& dataset) {
  const Session& session = working.readable();
  if (dataset == "time") return py::float_(session.read(dataset).at(0));
  const ResultsColumn column = session.column(dataset);
  return number_or_array(session.read(column), column.shape);
}

py::dict datasets_of(WorkingSession& working) {
  py::dict found;
  for (const ResultsColumn& column : working.readable().datasets())
    found[py::str(column.dataset)] =
        py::make_tuple(py::tuple(py::cast(column.shape)), column.units, column.description, true);
  return found;
}

void set_state(WorkingSession& working, const State& state) {
  Session& session = working.idle();
  const State& now = session.state();
  const auto alike = [](const auto& a, const auto& b) { return a.size() == b.size(); };
  if (!alike(state.nodes, now.nodes) || !alike(state.amplitude, now.amplitude) ||
      !alike(state.first_order, now.first_order) || !alike(state.multiplier, now.multiplier) ||
      !alike(state.memory, now.memory) || !alike(state.idle, now.idle))
    throw InputError("the state is one of another model");
  session.set_state(state);
}

py::dict energies(const Energy& energy) {
  py::dict found;
  found["kinetic"] = energy.kinetic;
  found["elastic"] = energy.elastic;
  found["gravity"] = energy.gravity;
  found["dissipated"] = energy.dissipation;
  found["input"] = energy.input;
  return found;
}

py::dict mobility_of(WorkingSession& working) {
  const Mobility& mobility = working.readable().mobility();
  py::dict found;
  found["degrees"] = mobility.degrees;
  found["independent"] = mobility.independent;
  found["nearly_redundant"] = mobility.nearly_redundant;
  return found;
}

void restore(WorkingSession& working, const Numbers& saved) {
  const Callbacks none;
  const std::vector<double> numbers = to_vector(saved);
  working.compute(none, [&](Session& session) { session.restore(numbers); });
}

std::shared_ptr<Recorder> record(WorkingSession& working, const std::string& path, std::optional<int> every,
                                 std::optional<std::vector<double>> times, bool memory) {
  Session& session = working.idle();
  Recording recording = session.recording();
  if (every) {
    if (*every < 1) throw InputError("rows are recorded every 1, 2, ... steps");
    recording.every = *every;
    recording.times.clear();
  }
  if (times) {
    if (!std::is_sorted(times->begin(), times->end())) throw InputError("times of rows are given in ascending order");
    recording.times = std::move(*times);
  }
  auto recorder = std::make_shared<Recorder>(working.model(), working.gate());
  if (!path.empty()) {
    check_output_file(path);
    check_may_be_replaced(path);
    const MechanismFile& file = *working.model();
    recorder->file = std::make_unique<ResultsFile>(path, file.model, file.text, file.output.layout);
    recorder->file->name_equations(session.system());
  }
  working.attach(recorder, std::move(recording), memory);
  return recorder;
}

}  // namespace

void bind_session(py::module_& module) {
  py::class_<Callbacks>(module, "Callbacks").def(py::init<py::object, py::object>());

  py::class_<WorkingSession, HeldSession>(module, "Session")
      .def(py::init([](std::shared_ptr<MechanismFile> model, int threads) {
        if (threads < 1) throw InputError("threads: expected a whole number of at least 1");
        return std::make_shared<WorkingSession>(std::move(model), threads);
      }))
      .def("run_keys",
           [](WorkingSession& working, const std::string& text, const std::string& name, const Callbacks& callbacks) {
             return run(working, *read_keys(text, name, *working.model()), callbacks);
           })
      .def("run_listed",
           [](WorkingSession& working, std::size_t k, const Callbacks& callbacks) {
             return run(working, *working.model()->analyses.at(k), callbacks);
           })
      .def("dynamics", start_motion)
      .def("read", read_dataset)
      .def("measure", [](WorkingSession& working, const std::string& name) { return working.readable().measure(name); })
      .def("set_input", [](WorkingSession& working, const std::string& name, double value,
                           bool smooth) { working.readable().set_input(name, value, smooth); })
      .def("datasets", datasets_of)
      .def("state", [](WorkingSession& working) { return std::make_shared<State>(working.readable().state()); })
      .def("set_state", set_state)
      .def("node",
           [](WorkingSession& working, const std::string& name) { return NodeState(working.readable().node(name)); })
      .def("energy", [](WorkingSession& working) { return energies(working.readable().energy()); })
      .def("balance", [](WorkingSession& working) { return working.readable().balance(); })
      .def("time", [](WorkingSession& working) { return working.readable().time(); })
      .def("moving", [](WorkingSession& working) { return working.readable().moving(); })
      .def("stop", [](WorkingSession& working) { working.readable().stop(); })
      .def("save",
           [](WorkingSession& working) {
             std::vector<double> saved = working.readable().save();
             const std::size_t size = saved.size();
             return take_array(std::move(saved), {size});
           })
      .def("restore", restore)
      .def("redundant", [](WorkingSession& working) { return working.readable().redundant(); })
      .def("mobility", mobility_of)
      .def("notes", &WorkingSession::said)
      .def("forget_notes", &WorkingSession::forget_said)
      .def("record", record)
      .def("end_record", &WorkingSession::detach);
}

}  // namespace bielle::python

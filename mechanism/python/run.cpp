// Runs all analyses of a model, as the program does.
#include <pybind11/stl.h>

#include "mechanism/io/run_analyses.hpp"
#include "mechanism/python/bind.hpp"
#include "mechanism/python/interruptible.hpp"
#include "mechanism/python/recorder.hpp"
#include "mechanism/python/single_blas_thread.hpp"
#include "mechanism/python/texts.hpp"
#include "mechanism/python/without_lock.hpp"
#include "reduce/common/error.hpp"

namespace bielle::python {
namespace {

namespace py = pybind11;
using namespace mechanism;

struct KeptNotes : Notes {
  void note(const std::string& sentence) override { sentences.push_back(without_unseen_lines(sentence)); }
  std::vector<std::string> sentences;
};

/// Returns recorder, [(summary, numbers, rows) of each analysis], notes.
py::tuple run_file(const std::shared_ptr<MechanismFile>& file, const std::string& output, const std::string& restart,
                   int threads, bool progress, bool memory) {
  if (file->analyses.empty()) throw InputError("nothing to do: the model has no `analysis`");
  if (threads < 1) throw InputError("threads: expected a whole number of at least 1");
  const auto recorder = std::make_shared<Recorder>(file, nullptr);
  KeptNotes notes;
  Interruptible interruptible;
  const RunListener listener{memory ? &recorder->memory : nullptr, &notes, [&](Session&) { interruptible.step(); }};
  std::vector<AnalysisSummary> summaries;
  {
    const SingleBlasThread one;
    const WithoutLock free;
    Progress shown(!progress);
    summaries = run_analyses(*file, output, shown, restart, threads, listener);
  }
  py::list found;
  for (const AnalysisSummary& summary : summaries)
    found.append(py::make_tuple(without_unseen_lines(summary.text), summary.numbers, summary.records));
  return py::make_tuple(recorder, found, notes.sentences);
}

}  // namespace

void bind_run(py::module_& module) { module.def("run", run_file); }

}  // namespace bielle::python

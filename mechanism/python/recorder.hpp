// Results that a session passes on: to memory, and to a file if requested.
#pragma once

#include <memory>
#include <string>

#include "mechanism/python/gate.hpp"
#include "mechanism/python/held_model.hpp"
#include "mechanism/results/memory_sink.hpp"
#include "mechanism/results/results_file.hpp"

namespace bielle::python {

/// The object knows which of its analyses are complete: only their numbers do not move any more.
class RecorderMemory final : public mechanism::MemorySink {
 public:
  using MemorySink::MemorySink;
  void end_analysis() override { ended_ = analyses().size(); }
  bool stays(std::size_t analysis) const { return analysis < ended_ || analysis + 1 < analyses().size(); }

 private:
  std::size_t ended_ = 0;
};

struct Recorder {
  Recorder(HeldModel of, std::shared_ptr<const Gate> by)
      : model(std::move(of)), gate(std::move(by)), memory(model->model) {}
  HeldModel model;
  std::shared_ptr<const Gate> gate;  ///< gate of the session that writes; nullptr: no session writes any more
  RecorderMemory memory;
  std::unique_ptr<mechanism::ResultsFile> file;
};

}  // namespace bielle::python

#include "mechanism/io/step_log.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

std::string quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += c;
    quoted += c;
  }
  return quoted + '"';
}

const char* name_of(Attempt::Outcome outcome) {
  switch (outcome) {
    case Attempt::Outcome::accepted:
      return "accepted";
    case Attempt::Outcome::refused_by_error:
      return "local error too large";
    case Attempt::Outcome::refused_by_newton:
      break;
  }
  return "not solved";
}

}  // namespace

StepLog::StepLog(const std::string& results_path, const System& system, bool go_on)
    : system_(system),
      path_(std::filesystem::path(results_path).replace_extension(".steps.csv").string()),
      file_(path_, go_on ? std::ios::app : std::ios::trunc),
      flushed_(std::chrono::steady_clock::now()) {
  if (!file_) throw ComputationError(fmt::format("{}: cannot be written", path_));
  if (file_.tellp() == 0)
    file_ << "time [s],step [s],outcome,iterations,factorisations,shortened,error over tolerance,"
             "residual over tolerance,worst residual,units,equation,reason\n";
}

void StepLog::write(const Attempt& attempt) {
  const StepReport& r = attempt.report;
  const bool any = r.worst_equation >= 0;
  file_ << fmt::format("{:.12g},{:.6g},{},{},{},{},{:.3g},{:.3g},{:.3g},{},{},{}\n", attempt.time, r.size,
                       name_of(attempt.outcome), r.iterations, r.factorisations, r.shortened, attempt.error,
                       r.worst_ratio, r.worst_residual, any ? system_.equation_units(r.worst_equation) : "",
                       any ? quoted(system_.equation_name(r.worst_equation)) : "",
                       r.refusal.empty() ? "" : quoted(r.refusal));
  const auto now = std::chrono::steady_clock::now();
  if (now - flushed_ > std::chrono::milliseconds(500)) {
    file_.flush();
    flushed_ = now;
  }
  if (!file_) throw ComputationError(fmt::format("{}: cannot be written (is the disk full?)", path_));
}

}  // namespace bielle::mechanism

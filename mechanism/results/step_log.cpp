#include "mechanism/results/step_log.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

std::string quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += c;
    quoted += c == '\n' || c == '\r' ? ' ' : c;  // a step has only one line
  }
  return quoted + '"';
}

/// Returns the path of the table, next to the results.
std::string table_of(const std::string& results_path) {
  return std::filesystem::path(results_path).replace_extension(".steps.csv").string();
}

constexpr const char* head =
    "time [s],step [s],outcome,iterations,factorisations,shortened,error over tolerance,"
    "residual over tolerance,worst residual,units,equation,reason\n";

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

StepLog::StepLog(const std::string& results_path, const System& system, const std::string& goes_on_from)
    : system_(system), path_(table_of(results_path)), flushed_(std::chrono::steady_clock::now()) {
  namespace fs = std::filesystem;
  bool anew = true;
  if (!goes_on_from.empty()) {
    const std::string before = table_of(goes_on_from);
    std::error_code none;
    anew = !fs::is_regular_file(before, none);
    if (!anew && !fs::equivalent(before, path_, none))
      anew = !fs::copy_file(before, path_, fs::copy_options::overwrite_existing, none);
  }
  open(anew);
}

void StepLog::open(bool anew) {
  file_.open(path_, anew ? std::ios::trunc : std::ios::app);
  if (file_ && file_.tellp() == 0) file_ << head;
  check();
}

void StepLog::check() const {
  if (!file_) throw ComputationError(fmt::format("{}: cannot be written (is the disk full?)", path_));
}

long StepLog::lines() {
  file_.flush();
  check();
  return lines_;
}

void StepLog::go_on_after(long lines) {
  file_.close();
  std::uintmax_t size = 0;
  lines_ = -1;  // the header is not counted
  {
    std::ifstream written(path_, std::ios::binary);
    for (std::string line; lines_ < lines && std::getline(written, line) && !written.eof(); ++lines_)
      size += line.size() + 1;
  }
  std::error_code failed;
  std::filesystem::resize_file(path_, size, failed);
  if (failed) throw ComputationError(fmt::format("{}: cannot be cut: {}", path_, failed.message()));
  lines_ = std::max(lines_, 0L);
  open(false);
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
  ++lines_;
  check();
}

}  // namespace bielle::mechanism

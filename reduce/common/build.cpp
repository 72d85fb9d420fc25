#include "reduce/common/build.hpp"

#include <fmt/format.h>

namespace bielle {

// The programs and the Python module replace these functions by those of generated sources (ProgramFacts.cmake). Tests
// keep these: otherwise each commit would link all of them anew.
[[gnu::weak]] const char* commit() { return "unknown"; }
[[gnu::weak]] const char* build_facts() { return ""; }

std::string version_text(const std::string& program) {
  std::string text = fmt::format("{} {}\ncommit     {}\n{}", program, BIELLE_VERSION, commit(), build_facts());
  text.pop_back();  // the end of the last line
  return text;
}

std::string created_by(const std::string& program) {
  return fmt::format("{} {} (commit {})", program, BIELLE_VERSION, commit());
}

}  // namespace bielle

#include "reduce/common/atomic_output.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "reduce/common/error.hpp"

namespace bielle {

AtomicOutput::AtomicOutput(std::string path) : path_(std::move(path)), temporary_path_(path_ + ".partial") {}

AtomicOutput::~AtomicOutput() {
  std::error_code ignored;
  if (!committed_) std::filesystem::remove(temporary_path_, ignored);
}

void AtomicOutput::commit() {
  std::error_code error;
  std::filesystem::rename(temporary_path_, path_, error);
  if (error)
    throw ComputationError(
        fmt::format("{}: cannot take its name from '{}': {}", path_, temporary_path_, error.message()));
  committed_ = true;
}

}  // namespace bielle

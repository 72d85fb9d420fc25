// Output files that appear when they are complete.
#pragma once

#include <string>

namespace bielle {

/// A file that is written as `<path>.partial` in the same folder, renamed by `commit()` when it is complete, and
/// removed if it is destroyed before. An earlier file of that name is replaced only by a complete one. If another run
/// writes the same file at the same time, this one writes `<path>.2.partial`: both files become complete, and the one
/// that is committed last stays.
class AtomicOutput {
 public:
  explicit AtomicOutput(std::string path);
  ~AtomicOutput();
  AtomicOutput(const AtomicOutput&) = delete;
  AtomicOutput& operator=(const AtomicOutput&) = delete;
  const std::string& temporary_path() const { return temporary_path_; }
  void commit();  ///< @throws ComputationError when the rename fails

 private:
  std::string path_, temporary_path_;
  int lock_ = -1;  ///< file descriptor that holds the temporary file
  bool committed_ = false;
};

}  // namespace bielle

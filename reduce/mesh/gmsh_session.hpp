// gmsh's library: one session at a time, silent, and with errors turned into our exceptions.
#pragma once

#include <functional>
#include <memory>
#include <string>

namespace bielle::reduce {

/// gmsh initialised for as long as the object lives.
///
/// gmsh is one global object: a second session waits until the first has ended. It throws std::string, and after a
/// throw every later `open` silently does nothing until it is finalised: `run` translates and the session is then to be
/// left. OpenCASCADE always prints on standard output, which is therefore redirected meanwhile. No
/// configuration file of the user is read.
class GmshSession {
 public:
  GmshSession();
  ~GmshSession();
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;

  /// Calls `work`, which may call gmsh, to read something.
  /// @param what  what was being done, as the beginning of a message: "'rod.geo' cannot be read"
  /// @throws InputError "<what>: <gmsh's reason>"
  void read(const std::string& what, const std::function<void()>& work);

  /// The same where not the user's input but gmsh fails. @throws ComputationError
  void compute(const std::string& what, const std::function<void()>& work);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bielle::reduce

// gmsh's library: one session at a time, without output, and with its errors translated to exceptions of Bielle.
#pragma once

#include <functional>
#include <memory>
#include <string>

namespace bielle::reduce {

/// gmsh initialised for as long as the object lives.
///
/// gmsh is one global object: a second session waits until the first has ended. It throws std::string, and after a
/// throw every later `open` silently does nothing until gmsh is finalised: `run` translates the exception, and the
/// session must then be ended. OpenCASCADE always prints on standard output, which is therefore redirected during the
/// session. The user's configuration file is not read.
class GmshSession {
 public:
  GmshSession();
  ~GmshSession();
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;

  /// Calls `work`, which may call gmsh, to read something.
  /// @param what  beginning of an error message: "'rod.geo' cannot be read"
  /// @throws InputError "<what>: <gmsh's reason>"
  void read(const std::string& what, const std::function<void()>& work);

  /// Does the same if an error is not the user's but a failure of gmsh. @throws ComputationError
  void compute(const std::string& what, const std::function<void()>& work);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bielle::reduce

// The connection between bielle-reduce and the ranks: a pair of sockets on one machine, through which numbers are sent
// in their binary form in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace bielle::reduce {

/// Commands to the ranks. A command is sent with two numbers and the data in parentheses; the answer is an Outcome and,
/// after success, the data behind the arrow. "Per part" means the length as a 64-bit number, then the block, for one
/// part of the mesh after the other.
enum class Command : std::int64_t {
  keep,       ///< a: threads; (per part: MeshShare packed)
  stiffness,  ///< a: columns; (per part: rows of u) -> per part: rows of K u
  mass,       ///< a: columns, b: rows per node; (per part: rows of u) -> per part: rows of M u
  diagonal,   ///< -> per part: diagonal of K
  geometric,  ///< a: fields f, b: shapes n; (per part: rows of both) -> f matrices (n,n)
  factorise,  ///< a: unknowns; (per part: InteriorShare packed; the first unknowns of blocks) -> statistics
  solve,      ///< a: columns; (right-hand sides) -> solutions
  modes,      ///< a: size, b: count; (tolerance, most restarts) -> count found, values, vectors; before: questions
  answer,     ///< (vector): to a question of `modes`
  forget,     ///< matrices and factor
  leave,      ///< a: exit status; among the ranks alone
};

/// Requests of the ranks during the search for modes; a vector is sent with each.
enum class Question : std::int64_t { mass_times, solution, none };

/// The result of a command.
struct Outcome {
  enum Kind : std::int64_t { good, out_of_memory, failed, singular };
  Kind kind = good;
  std::string message;
};

/// One end of the connection. Whole messages are written and read; neither end closes the other's.
class Channel {
 public:
  /// @param peer  name of the other end, for the message: "the ranks"
  Channel(int descriptor, std::string peer);
  ~Channel();
  Channel(const Channel&) = delete;
  Channel& operator=(const Channel&) = delete;

  /// @throws ComputationError when the other end is gone
  void send(const void* data, std::size_t bytes);
  void receive(void* data, std::size_t bytes);
  /// Returns false if the other end has closed the connection between two messages.
  bool receive_if_any(void* data, std::size_t bytes);

  template <class Number>
  void send_number(const Number& number) {
    send(&number, sizeof number);
  }
  template <class Number>
  Number receive_number() {
    Number number{};
    receive(&number, sizeof number);
    return number;
  }
  void send_text(const std::string& text);
  std::string receive_text();
  void send_outcome(const Outcome& outcome);
  Outcome receive_outcome();

 private:
  int descriptor_;
  std::string peer_;
};

}  // namespace bielle::reduce

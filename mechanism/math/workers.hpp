// Threads that share work which has been divided into pieces beforehand: results do not depend on the number of
// threads.
#pragma once

#include <cstddef>
#include <memory>

namespace bielle::mechanism {

/// A team of threads, including the calling one. The other threads are started on first use and sleep between uses.
class Workers {
 public:
  explicit Workers(int threads = 1);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  int threads() const { return threads_; }
  /// Calls piece(k) once for each k below `count`, in any order, by any thread; returns when all are done. Pieces are
  /// begun in ascending order. Pieces must not throw, and must not write data that other pieces read or write. If the
  /// team is already working for another caller, the calling thread does all pieces itself.
  template <class Piece>
  void for_each(std::size_t count, const Piece& piece) {
    for_each(count, piece, [] {});
  }
  /// Does the same; the calling thread runs `meanwhile` before it takes part.
  template <class Piece, class Meanwhile>
  void for_each(std::size_t count, const Piece& piece, const Meanwhile& meanwhile) {
    const Ended ended(*this, count > 0 && threads_ > 1 && begin({&call<Piece>, &piece, count}));
    meanwhile();
    if (ended.shared)
      take_part();
    else
      for (std::size_t k = 0; k < count; ++k) piece(k);
  }

 private:
  struct Work {
    void (*call)(const void*, std::size_t);
    const void* piece;
    std::size_t count;
  };
  template <class Piece>
  static void call(const void* piece, std::size_t k) {
    (*static_cast<const Piece*>(piece))(k);
  }
  /// Waits for the other threads, also if `meanwhile` throws: pieces refer to data of the caller.
  struct Ended {
    Workers& workers;
    bool shared;
    Ended(Workers& of, bool is_shared) : workers(of), shared(is_shared) {}
    Ended(const Ended&) = delete;
    Ended& operator=(const Ended&) = delete;
    ~Ended() {
      if (shared) workers.end();
    }
  };
  bool begin(const Work& work);  ///< false if the team is already at work
  void start_threads();
  void take_part();
  void end();

  struct Team;
  int threads_;
  std::unique_ptr<Team> team_;
};

}  // namespace bielle::mechanism

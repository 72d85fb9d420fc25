// Threads that share work which was cut into pieces before: results do not depend on how many there are.
#pragma once

#include <cstddef>
#include <memory>

namespace bielle::mechanism {

/// A team of threads, the calling one among them. Others are started when they are first wanted and sleep in between.
class Workers {
 public:
  explicit Workers(int threads = 1);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  int threads() const { return threads_; }
  /// Calls piece(k) once for each k below `count`, in any order, by any thread; returns when all are done. What comes
  /// first is begun first. Pieces must not throw, and write where no other piece reads or writes. Where the team is at
  /// work for another caller already, the calling thread does all by itself.
  template <class Piece>
  void for_each(std::size_t count, const Piece& piece) {
    for_each(count, piece, [] {});
  }
  /// The same; the calling thread does `meanwhile` before it takes its part.
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
  /// Waits for the others, also where `meanwhile` throws: pieces refer to what the caller holds.
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
  bool begin(const Work& work);  ///< false where the team is at work already
  void start_threads();
  void take_part();
  void end();

  struct Team;
  int threads_;
  std::unique_ptr<Team> team_;
};

}  // namespace bielle::mechanism

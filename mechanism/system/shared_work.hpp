// Distribution of the evaluation of members over several threads.
//
// A member with a large dense tangent (a superelement with its modes) takes as long as hundreds of joints. Such members
// are separate pieces of work, the most costly first; meanwhile the calling thread evaluates the small members one
// after the other, and then helps. The contributions are always added in the same order: those of the small members,
// then those of the pieces. Therefore no result depends on the number of threads.
#pragma once

#include <exception>
#include <limits>
#include <memory>
#include <mutex>
#include <vector>

#include "mechanism/math/workers.hpp"
#include "mechanism/system/unknowns.hpp"

namespace bielle::mechanism {

/// Size of the local equations of a model's members: what an evaluation costs is in proportion to it.
struct EvaluationSize {
  double block_rows = 0;     ///< local rows of the members that write blocks (Declaration::in_blocks)
  double dense_entries = 0;  ///< entries of the local matrices of the other members
};

class SharedWork {
 public:
  /// The object keeps a reference.
  explicit SharedWork(const Unknowns& unknowns) : unknowns_(unknowns) {}
  SharedWork(const SharedWork&) = delete;
  SharedWork& operator=(const SharedWork&) = delete;

  /// Adds the properties that the next member of the model declares.
  void add(const Declaration& declaration) { acting_.push_back({!declaration.passive, declaration.in_blocks}); }
  /// Call it when all members are numbered.
  void complete();
  void use_threads(int threads) { workers_ = std::make_unique<Workers>(threads); }
  Workers& workers() const { return *workers_; }

  const EvaluationSize& evaluation_size() const { return evaluation_size_; }
  /// Members that are pieces of work, the most costly first; members of equal cost are in the order of the model.
  const std::vector<std::size_t>& costly() const { return costly_; }
  bool is_costly(std::size_t member) const { return is_costly_[member]; }
  /// Number of local rows of the costly members before the k-th; k = costly().size() gives the number of all.
  int row_begin(std::size_t k) const { return row_begin_[k]; }

  /// Calls piece(k) for each costly member and `small`, which may throw. An exception of `small` has priority;
  /// otherwise that of the piece of the lowest member is rethrown.
  template <class Piece, class Small>
  void share(const Piece& piece, const Small& small) const {
    if (costly_.empty()) {
      small();
      return;
    }
    Failure failure;
    const auto guarded = [&](std::size_t k) {
      try {
        piece(k);
      } catch (...) {
        failure.note(costly_[k], std::current_exception());
      }
    };
    if (worthwhile_) {
      workers_->for_each(costly_.size(), guarded, small);
    } else {
      small();
      for (std::size_t k = 0; k < costly_.size(); ++k) guarded(k);
    }
    if (failure.what) std::rethrow_exception(failure.what);
  }

 private:
  struct Failure {
    std::mutex mutex;
    std::size_t member = std::numeric_limits<std::size_t>::max();
    std::exception_ptr what;
    void note(std::size_t of, std::exception_ptr thrown) {
      const std::lock_guard lock(mutex);
      if (of >= member) return;
      member = of;
      what = std::move(thrown);
    }
  };
  struct Acting {
    bool acts, in_blocks;
  };

  const Unknowns& unknowns_;
  std::vector<Acting> acting_;  ///< properties of each member
  std::vector<bool> is_costly_;
  std::vector<std::size_t> costly_;
  std::vector<int> row_begin_;
  EvaluationSize evaluation_size_;
  bool worthwhile_ = false;  ///< waking the other threads takes less time than they save
  std::unique_ptr<Workers> workers_ = std::make_unique<Workers>();
};

}  // namespace bielle::mechanism

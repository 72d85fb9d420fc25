// Where the update matrices of a multifrontal elimination live.
//
// A supernode with n rows below its own columns leaves an update matrix (n,n), lower triangle, which its parent takes
// up. It is held in panels of columns, each with the rows from its own diagonal on, so that about half of the square is
// stored. Where supernodes are eliminated in postorder, those that are still needed are a stack. The parent's is made
// while its children's are still read: supernodes of even and of odd depth therefore have a stack each, and nothing
// needs to be moved.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "reduce/spectral/elimination_tree.hpp"

namespace bielle {

struct SupernodalFactor;

/// The panels of an update matrix with `below` rows.
struct UpdatePanels {
  std::int64_t below = 0;

  std::int64_t width() const { return below <= undivided ? below : panel; }  ///< of all panels but the last
  std::int64_t count() const { return below == 0 ? 0 : (below + width() - 1) / width(); }
  std::int64_t columns(std::int64_t k) const { return below - k * width() < width() ? below - k * width() : width(); }
  std::int64_t rows(std::int64_t k) const { return below - k * width(); }  ///< and the stride of its columns
  std::int64_t offset(std::int64_t k) const { return width() * (k * below - width() * (k * (k - 1) / 2)); }
  std::int64_t size() const {
    return count() == 0 ? 0 : offset(count() - 1) + rows(count() - 1) * columns(count() - 1);
  }

 private:
  static constexpr std::int64_t panel = 256, undivided = 384;
};

/// In which order the supernodes of each subtree are eliminated, in which those above, and where each update matrix is
/// meanwhile: on the stacks of whoever eliminates the subtree, or apart, where it is passed on to those above.
class UpdatePlan {
 public:
  UpdatePlan(const SupernodalFactor& structure, const EliminationTree& tree, const TreeShares& shares);

  std::size_t subtrees() const { return orders_.size() - 1; }
  const std::vector<std::int64_t>& of_subtree(std::size_t k) const { return orders_[k]; }
  const std::vector<std::int64_t>& above() const { return orders_.back(); }
  const std::vector<std::int64_t>& children(std::int64_t s) const { return children_[static_cast<std::size_t>(s)]; }
  /// Of all update matrices that live at the same time, while `threads` eliminate subtrees [numbers].
  std::int64_t numbers(int threads) const;

 private:
  friend class UpdateMemory;
  using StackSizes = std::array<std::int64_t, 2>;
  struct Place {
    int parity;  ///< of the stack; -1: apart
    std::int64_t offset;
  };

  /// @param is_own  whether a supernode belongs to what is eliminated now
  template <class IsOwn>
  StackSizes plan(std::int64_t root, const EliminationTree& tree, const IsOwn& is_own,
                  std::vector<std::int64_t>& order);

  std::vector<std::int64_t> sizes_;                  // of the update matrix of each supernode
  std::vector<std::vector<std::int64_t>> orders_;    // of each subtree; at last of those above
  std::vector<std::vector<std::int64_t>> children_;  // of each supernode, as they are eliminated
  std::vector<int> parities_;                        // of the depth of each supernode
  std::vector<Place> places_;                        // of the update matrix of each supernode
  std::vector<std::int64_t> apart_;                  // supernodes whose update matrices are passed on
  StackSizes of_subtrees_{}, of_above_{};            // stacks that suffice for each subtree, and for those above
};

/// The memory that a plan asks for.
class UpdateMemory {
 public:
  /// For the subtrees. @throws std::bad_alloc
  UpdateMemory(const UpdatePlan& plan, int threads);
  /// For those above, when the subtrees are done. @throws std::bad_alloc
  void leave_subtrees();

  /// @param worker  whose stacks: the number of a thread; 0 above the subtrees
  double* of(std::int64_t s, int worker) const;
  /// Not needed any more.
  void free(std::int64_t s);

 private:
  struct Freed {
    void operator()(double* memory) const;
  };
  using Block = std::unique_ptr<double, Freed>;
  using Stacks = std::array<Block, 2>;

  static Block take(std::int64_t numbers);
  static Stacks take(const UpdatePlan::StackSizes& sizes) { return {take(sizes[0]), take(sizes[1])}; }

  const UpdatePlan& plan_;
  std::vector<Stacks> stacks_;
  std::vector<Block> apart_;  // of each supernode; most have none
};

}  // namespace bielle

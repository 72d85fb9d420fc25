// On which side of singular positions a mechanism stands whose every motion is prescribed.
//
// The constraints' matrix B is square there. Its determinant is continuous along a motion, and vanishes where the
// mechanism is singular (a dead centre) alone: of two positions between which it has changed its sign, either the
// motion has passed a singular one, or they are of different branches. One sign tells of all loops together: two that
// change at once go unnoticed, and mechanisms with elastic parts, whose B is not square, are not judged.
#pragma once

#include <memory>
#include <vector>

#include "mechanism/math/sparse.hpp"
#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

class BranchSign {
 public:
  explicit BranchSign(const System& system) : system_(system) {}
  /// Whether the determinants of two positions have the same sign, or are not to be compared: B is not square or
  /// singular, or other constraints are switched on.
  bool same(const Environment& environment, const State& one, const State& other);

 private:
  /// -1 or 1; 0: none. @param state  whose constraints are those that the factors were made for
  int sign_at(const Environment& environment, const State& state);
  bool is_known(const State& state) const;
  void choose_rows(const State& state);

  const System& system_;
  std::vector<char> idle_;                  ///< as `State::idle` was when the pattern was made
  std::vector<int> places_;                 ///< of the entries of B in the system's pattern, in the order of its own
  std::unique_ptr<SparsePattern> pattern_;  ///< nullptr: B is not square
  std::unique_ptr<SparseLU> factors_;
  std::vector<double> tangent_, values_;
  bool chosen_ = false;
  double known_time_ = 0;  ///< the last position, and its sign
  std::vector<Vector3> known_at_;
  int known_sign_ = 0;
};

}  // namespace bielle::mechanism

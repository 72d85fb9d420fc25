// Side of singular positions of a mechanism whose motions are all prescribed.
//
// The constraints' matrix B is then square. Its determinant is continuous along a motion, and is zero only if the
// mechanism is singular (a dead centre): if it has opposite signs at two positions, either the motion has passed a
// singular one, or the positions belong to different branches. One sign represents all loops together: two simultaneous
// changes are not noticed, and mechanisms with elastic parts, whose B is not square, are not judged.
#pragma once

#include <memory>
#include <vector>

#include "mechanism/math/sparse_factors.hpp"
#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

class BranchSign {
 public:
  explicit BranchSign(const System& system) : system_(system) {}
  /// Returns whether the determinants of two positions have the same sign, or cannot be compared: B is not square or is
  /// singular, or other constraints are switched on.
  bool same(const Environment& environment, const State& one, const State& other);

 private:
  /// Returns -1 or 1; 0: no sign. @param state  must have the constraints for which the factors were created
  int sign_at(const Environment& environment, const State& state);
  bool is_known(const State& state) const;
  void choose_rows(const State& state);

  const System& system_;
  std::vector<char> idle_;                    ///< `State::idle` when the pattern was created
  std::shared_ptr<const TangentPattern> of_;  ///< the system's pattern then
  std::vector<int> places_;                   ///< places of B in the system's pattern, in the order of its own entries
  std::unique_ptr<SparsePattern> pattern_;    ///< nullptr if B is not square
  std::unique_ptr<SparseLU> factors_;
  std::vector<double> tangent_, values_;
  bool chosen_ = false;
  double known_time_ = 0;  ///< the last position, and its sign
  std::vector<Vector3> known_at_;
  int known_sign_ = 0;
};

}  // namespace bielle::mechanism

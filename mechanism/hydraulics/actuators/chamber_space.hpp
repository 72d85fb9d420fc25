// The volume of a cylinder's chamber as a function of its length, V(l): for a piston of one area, or of several stages
// that extend one after the other.
//
// dV/dl changes from one stage to the next by 10 x^3 - 15 x^4 + 6 x^5 over a short distance. Beyond the stroke dV/dl is
// constant.
#pragma once

#include <vector>

namespace bielle::mechanism {

class ChamberSpace {
 public:
  struct Stage {
    double area;    ///< [m^2], not negative
    double length;  ///< length of its stroke [m]
  };
  /// @param begin   length l at which the stroke begins [m] @param dead  smallest V [m^3]
  /// @param grows   +1: V grows with l, smallest at the begin; -1: V decreases, smallest at the end
  /// @param stages  stages in the order in which they extend
  ChamberSpace(double begin, double dead, double grows, std::vector<Stage> stages);
  struct Value {
    double V;     ///< [m^3]
    double V_l;   ///< [m^2], negative if V decreases
    double V_ll;  ///< [m]
  };
  Value at(double l) const;
  double largest_area() const;

 private:
  struct Border {
    double begin, width, rise;  ///< begin and width of the transition in length [m]; change of the area [m^2]
  };
  double begin_, first_area_, at_begin_ = 0, grows_;
  std::vector<Border> borders_;
  double largest_ = 0;
};

}  // namespace bielle::mechanism

// The space of a cylinder's chamber by its length, V(l): a piston of one area, or of several stages one after the
// other.
//
// dV/dl goes over from one stage to the next along 10 x^3 - 15 x^4 + 6 x^5 over a short way. Beyond the stroke it
// stays.
#pragma once

#include <vector>

namespace bielle::mechanism {

class ChamberSpace {
 public:
  struct Stage {
    double area;    ///< [m^2], not negative
    double length;  ///< of its stroke [m]
  };
  /// @param begin   length l at which the stroke begins [m] @param dead  V where the chamber is smallest [m^3]
  /// @param grows   +1: V grows with l, smallest at the begin; -1: V falls, smallest at the end
  /// @param stages  in the order in which they extend
  ChamberSpace(double begin, double dead, double grows, std::vector<Stage> stages);
  struct Value {
    double V;     ///< [m^3]
    double V_l;   ///< [m^2], negative where it falls
    double V_ll;  ///< [m]
  };
  Value at(double l) const;
  double largest_area() const;

 private:
  struct Border {
    double begin, width, rise;  ///< of the length [m], [m]; of the area [m^2]
  };
  double begin_, first_area_, at_begin_ = 0, grows_;
  std::vector<Border> borders_;
  double largest_ = 0;
};

}  // namespace bielle::mechanism

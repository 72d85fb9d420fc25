// Cushion of a cylinder: the outlet of a chamber becomes narrow near the end of the stroke.
//
//     A = A_c + (A_port - A_c) s(x/x_c),     x: remaining distance to the end, x_c: length of the cushion
// with s = 10 u^3 - 15 u^4 + 6 u^5. Fluid that flows in opens a check valve with the area of the port, over 0.5 bar.
#pragma once

#include "mechanism/hydraulics/actuators/cylinder.hpp"
#include "mechanism/hydraulics/lines/line.hpp"
#include "mechanism/hydraulics/lines/orifice_law.hpp"

namespace bielle::mechanism {

class Cushion final : public Line {
 public:
  struct Data {
    double port_area, area;  ///< A_port, A_c [m^2]
    double length;           ///< x_c [m]; 0: none
    double end;              ///< length of the cylinder with the smallest chamber [m]
    double side;             ///< +1: the remaining distance is l - end, -1: end - l
  };
  /// @param chamber,port  positive flow is out of the chamber
  Cushion(std::string name, const Cylinder& cylinder, const PressureNode& chamber, const PressureNode& port,
          const OrificeLaw& law, const Data& data);
  void calc_flow(const LocalState& state, std::size_t path, FlowDerivatives& flow) const override;

 private:
  std::string describe_law() const override;
  const Cylinder& cylinder_;
  int reference_;  ///< index of the reference to the cylinder
  OrificeLaw law_;
  Data data_;
};

}  // namespace bielle::mechanism

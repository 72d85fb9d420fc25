// A place of a circuit with a pressure, to which lines and chambers are connected.
//
// Its pressure p is a first-order unknown. Flows are added to one of its equations, its balance; components with a
// volume in it (a chamber, an accumulator) add to another equation, if it has one. Connected components do not depend
// on the kind of place: a volume, a junction without volume, a given pressure.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mechanism/hydraulics/circuit/fluid.hpp"
#include "mechanism/model/component.hpp"

namespace bielle::mechanism {

class PressureNode : public Component {
 public:
  /// Indices of its pressure and its equations among its first-order unknowns. `space` is -1 if the place has no
  /// equation of its own for volumes.
  struct Rows {
    int pressure, balance, space;
  };
  PressureNode(std::string type, std::string name, const Fluid& fluid, Rows rows)
      : Component(std::move(type), std::move(name)), fluid_(fluid), rows_(rows) {}
  const Fluid& fluid() const { return fluid_; }
  const Rows& rows() const { return rows_; }

  /// @param own  its own local state
  double pressure(const LocalState& own) const { return own.first_order()[rows_.pressure]; }
  /// Returns whether its pressure is given independently of the flow. The power of flows is then that of a source.
  virtual bool is_given() const { return false; }
  /// Returns whether it is a part of a component, and cannot be named by the user.
  virtual bool is_part() const { return false; }
  /// Returns whether flows contribute to its balance. A static analysis keeps the fluid of volumes constant, because
  /// time does not advance.
  virtual bool balances(const LocalState& /*own*/) const { return true; }
  /// The factor of a flow in its balance, and its derivatives by its own first-order unknowns. (See Fluid::content.)
  struct Exchange {
    double factor = 1;
    double by[3] = {0, 0, 0};
  };
  virtual Exchange exchange(const LocalState& /*own*/) const { return {}; }

  std::vector<std::string> measure_names() const override { return {"pressure"}; }
  std::unique_ptr<Measure> make_measure(const std::string& name, const std::string& measure) const override;

 private:
  Fluid fluid_;
  Rows rows_;
};

}  // namespace bielle::mechanism

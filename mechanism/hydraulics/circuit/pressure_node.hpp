// A place of a circuit that has a pressure: what lines and chambers are joined to.
//
// Its pressure p is a first-order unknown. What flows in is added to one of its equations, its balance; who has space
// in it (a chamber, an accumulator) adds to another, if it has one. Nobody needs to know what stands behind: a volume,
// a junction without volume, a given pressure.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mechanism/hydraulics/circuit/fluid.hpp"
#include "mechanism/model/component.hpp"

namespace bielle::mechanism {

class PressureNode : public Component {
 public:
  /// Where its unknown pressure and its equations stand among its first-order unknowns. `space`: -1 where it has none.
  struct Rows {
    int pressure, balance, space;
  };
  PressureNode(std::string type, std::string name, const Fluid& fluid, Rows rows)
      : Component(std::move(type), std::move(name)), fluid_(fluid), rows_(rows) {}
  const Fluid& fluid() const { return fluid_; }
  const Rows& rows() const { return rows_; }

  /// @param own  its own local state
  double pressure(const LocalState& own) const { return own.first_order()[rows_.pressure]; }
  /// Whether its pressure is given, whatever flows: what flows in or out is then work of a source.
  virtual bool is_given() const { return false; }
  /// Whether it is a part of something, and no place that the user can name.
  virtual bool is_part() const { return false; }
  /// Whether flows have a part in its balance. A static analysis holds the fluid of volumes: time stands.
  virtual bool balances(const LocalState& /*own*/) const { return true; }
  /// The factor by which a flow counts in its balance, and its derivatives by its own first-order unknowns. (See
  /// Fluid::content.)
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

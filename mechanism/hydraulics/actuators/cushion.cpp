#include "mechanism/hydraulics/actuators/cushion.hpp"

#include <fmt/format.h>

#include "mechanism/hydraulics/lines/opening.hpp"

namespace bielle::mechanism {

Cushion::Cushion(std::string name, const Cylinder& cylinder, const PressureNode& chamber, const PressureNode& port,
                 const OrificeLaw& law, const Data& data)
    : Line("cushion", std::move(name)), cylinder_(cylinder), law_(law), data_(data) {
  const int a = add_port(chamber), b = add_port(port);
  add_path(a, b);
  reference_ = references().add(cylinder);
}

void Cushion::calc_flow(const LocalState& state, std::size_t /*path*/, FlowDerivatives& flow) const {
  constexpr double check_range = 0.5e5;  // [Pa]
  const PairMeasure l = cylinder_.length(state.of(reference_));
  const double D = ports().pressure(state, 0) - ports().pressure(state, 1), rest = data_.port_area - data_.area;
  const Opening cushion = data_.length > 0 ? poppet_opening(data_.side * (l.value - data_.end) / data_.length)
                                           : Opening{1, 0},
                check = poppet_opening(-D / check_range);
  // The fraction of the port that neither the cushion nor the check valve opens.
  const double closed = (1 - cushion.value) * (1 - check.value);
  const OrificeLaw::Flow law = law_.calc(data_.port_area - rest * closed, D);
  flow.Q = law.Q;
  const double by_difference = law.Q_D - law.Q_A * rest * (1 - cushion.value) * check.slope / check_range;
  add_by_pressure(state, 0, by_difference, flow);
  add_by_pressure(state, 1, -by_difference, flow);
  if (data_.length == 0) return;
  flow.by.position().segment<12>(state.slots().reference_row(reference_)) +=
      law.Q_A * rest * (1 - check.value) * cushion.slope * data_.side / data_.length * l.gradient;
}

std::string Cushion::describe_law() const {
  return fmt::format("port of {:.6g} m^2, over the last {:.6g} m down to {:.6g} m^2, {}", data_.port_area, data_.length,
                     data_.area, law_.describe());
}

}  // namespace bielle::mechanism

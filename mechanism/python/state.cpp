// States as arrays: views of one copy.
#include "mechanism/model/state.hpp"

#include "mechanism/python/arrays.hpp"
#include "mechanism/python/bind.hpp"

namespace bielle::python {
namespace {

namespace py = pybind11;
using mechanism::NodeState;
using mechanism::State;

constexpr std::size_t node_stride = sizeof(NodeState) / sizeof(double);
static_assert(sizeof(NodeState) == 24 * sizeof(double), "a node is nothing but its numbers");

/// Returns a vector of each node as an array (nodes, 3).
template <class Member>
auto vectors_of_nodes(Member member) {
  return [member](const py::object& self) {
    const State& state = self.cast<const State&>();
    const double* data = state.nodes.empty() ? nullptr : (state.nodes.front().*member).data();
    return view_array(data, {state.nodes.size(), 3}, {node_stride, 1}, self, true);
  };
}

/// Returns (nodes, 3, 3); Eigen stores columns.
py::array_t<double> axes_of_nodes(const py::object& self) {
  const State& state = self.cast<const State&>();
  const double* data = state.nodes.empty() ? nullptr : state.nodes.front().R.data();
  return view_array(data, {state.nodes.size(), 3, 3}, {node_stride, 1, 3}, self, true);
}

template <class Member>
auto numbers_of(Member member) {
  return [member](const py::object& self) {
    const State& state = self.cast<const State&>();
    const auto& numbers = state.*member;
    return view_array(numbers.data(), {static_cast<std::size_t>(numbers.size())}, {1}, self, true);
  };
}

template <class Member>
auto vector_of_node(Member member) {
  return [member](const py::object& self) {
    return view_array((self.cast<const NodeState&>().*member).data(), {3}, {1}, self, true);
  };
}

}  // namespace

void bind_state(py::module_& module) {
  py::class_<State, std::shared_ptr<State>>(
      module, "State",
      "State of the mechanism at one instant: a copy, whose arrays are views of it and may be written "
      "(Session.set_state).\n\nNodes stand in the order of Model.nodes; the first is the ground.")
      .def(py::init<const State&>(), "A copy of another state.")
      .def_readwrite("time", &State::time, "[s]")
      .def_property_readonly("positions", vectors_of_nodes(&NodeState::x), "(nodes, 3) [m], inertial.")
      .def_property_readonly(
          "axes", axes_of_nodes,
          "(nodes, 3, 3) rotation matrices: node axes -> inertial axes; they have to stay rotations.")
      .def_property_readonly("velocities", vectors_of_nodes(&NodeState::v), "(nodes, 3) [m/s], inertial.")
      .def_property_readonly("angular_velocities", vectors_of_nodes(&NodeState::Omega),
                             "(nodes, 3) [rad/s], node axes.")
      .def_property_readonly("accelerations", vectors_of_nodes(&NodeState::a), "(nodes, 3) [m/s^2], inertial.")
      .def_property_readonly("angular_accelerations", vectors_of_nodes(&NodeState::Omegadot),
                             "(nodes, 3) [rad/s^2], node axes.")
      .def_property_readonly("amplitudes", numbers_of(&State::amplitude), "Amplitudes of superelements' modes.")
      .def_property_readonly("amplitude_rates", numbers_of(&State::amplitude_rate), "Their rates.")
      .def_property_readonly("first_order", numbers_of(&State::first_order),
                             "First-order unknowns: pressures, states of controllers.")
      .def_property_readonly("first_order_rates", numbers_of(&State::first_order_rate), "Their rates.")
      .def_property_readonly("multipliers", numbers_of(&State::multiplier), "Reactions of constraints [N], [N m].")
      .def_property_readonly("memory", numbers_of(&State::memory),
                             "What components keep from step to step: inputs, turns of angles, bristles.");

  py::class_<NodeState>(module, "Node", "Position and motion of one node: a copy.")
      .def_property_readonly("position", vector_of_node(&NodeState::x), "(3) [m], inertial.")
      .def_property_readonly(
          "axes",
          [](const py::object& self) {
            return view_array(self.cast<const NodeState&>().R.data(), {3, 3}, {1, 3}, self, true);
          },
          "(3, 3) rotation matrix: node axes -> inertial axes.")
      .def_property_readonly("velocity", vector_of_node(&NodeState::v), "(3) [m/s], inertial.")
      .def_property_readonly("angular_velocity", vector_of_node(&NodeState::Omega), "(3) [rad/s], node axes.")
      .def_property_readonly("acceleration", vector_of_node(&NodeState::a), "(3) [m/s^2], inertial.")
      .def_property_readonly("angular_acceleration", vector_of_node(&NodeState::Omegadot), "(3) [rad/s^2], node axes.");
}

}  // namespace bielle::python

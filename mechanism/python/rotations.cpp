// Functions of the rotation parametrisations on arrays: one call for all items, whose leading dimensions are kept.
#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "mechanism/math/nearest_rotation.hpp"
#include "mechanism/math/rotation_parameters.hpp"
#include "mechanism/python/arrays.hpp"
#include "mechanism/python/bind.hpp"
#include "reduce/common/error.hpp"

namespace bielle::python {
namespace {

namespace py = pybind11;
using mechanism::Matrix3;

using Items = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Shape = std::vector<std::size_t>;
using OnArrays = std::function<py::array_t<double>(const std::vector<Items>&)>;

/// A vector or matrix as NumPy stores it, row by row.
template <class M>
using ByRows = Eigen::Matrix<double, M::RowsAtCompileTime, M::ColsAtCompileTime,
                             M::ColsAtCompileTime == 1 ? Eigen::ColMajor : Eigen::RowMajor>;

template <class M>
constexpr std::size_t size_of = static_cast<std::size_t>(M::SizeAtCompileTime);

/// Returns the dimensions of one item.
template <class M>
Shape item_shape() {
  if (M::ColsAtCompileTime == 1) return {M::RowsAtCompileTime};
  return {M::RowsAtCompileTime, M::ColsAtCompileTime};
}

/// "item (2, 0): ", or an empty text if there is only one item.
std::string place_of_item(std::size_t item, const Shape& leading) {
  if (leading.empty()) return "";
  std::string text;
  for (std::size_t k = leading.size(); k-- > 0; item /= leading[k])
    text = fmt::format("{}{}{}", item % leading[k], text.empty() ? "" : ", ", text);
  return fmt::format("item ({}): ", text);
}

/// Returns the dimensions before those of an item of the first array. All arrays must have as many items.
template <class First, class... Rest>
Shape leading_shape(const std::vector<Items>& arrays) {
  if (arrays.size() != 1 + sizeof...(Rest)) throw py::value_error("another number of arrays is expected");
  const Items& first = arrays.front();
  const Shape of_item = item_shape<First>();
  Shape leading(first.shape(), first.shape() + first.ndim());
  if (leading.size() < of_item.size() || !std::equal(of_item.rbegin(), of_item.rend(), leading.rbegin()))
    throw py::value_error("the array has items of another shape");
  leading.resize(leading.size() - of_item.size());
  const std::array<std::size_t, 1 + sizeof...(Rest)> sizes = {size_of<First>, size_of<Rest>...};
  std::size_t items = 1;
  for (const std::size_t count : leading) items *= count;
  for (std::size_t k = 0; k < sizes.size(); ++k)
    if (static_cast<std::size_t>(arrays[k].size()) != items * sizes[k])
      throw py::value_error("the arrays have different numbers of items");
  return leading;
}

template <class Out, class... In, std::size_t... k>
py::array_t<double> on_each(Out (*function)(const In&...), const std::vector<Items>& arrays,
                            std::index_sequence<k...>) {
  Shape shape = leading_shape<In...>(arrays);
  std::size_t items = 1;
  for (const std::size_t count : shape) items *= count;
  std::vector<double> values(items * size_of<Out>);
  for (std::size_t item = 0; item < items; ++item) {
    try {
      const Out result = function(In(Eigen::Map<const ByRows<In>>(arrays[k].data() + item * size_of<In>))...);
      Eigen::Map<ByRows<Out>>(values.data() + item * size_of<Out>) = result;
    } catch (const ComputationError& failed) {
      throw ComputationError(place_of_item(item, shape) + failed.what());
    } catch (const InputError& wrong) {
      throw InputError(place_of_item(item, shape) + wrong.what());
    }
  }
  const Shape of_item = item_shape<Out>();
  shape.insert(shape.end(), of_item.begin(), of_item.end());
  return take_array(std::move(values), shape);
}

template <class Out, class... In>
OnArrays on_arrays(Out (*function)(const In&...)) {
  return [function](const std::vector<Items>& arrays) {
    return on_each(function, arrays, std::index_sequence_for<In...>());
  };
}

/// Returns the parameters of a rotation matrix, whose rounding is corrected as that of matrices in model files.
template <class P>
typename P::Parameters parameters_of(const Matrix3& R) {
  if (const auto fault = mechanism::rotation_fault(R))
    throw InputError(fmt::format(
        "expected a rotation matrix, whose columns are of length one, orthogonal and right-handed; {}", *fault));
  return P::parameters(mechanism::nearest_rotation(R));
}

using Functions = std::map<std::string, OnArrays>;

template <class P>
Functions functions_of() {
  return {{"rotation", on_arrays(&P::rotation)},
          {"parameters", on_arrays(&parameters_of<P>)},
          {"principal", on_arrays(&P::principal)},
          {"complement", on_arrays(&P::complement)},
          {"compose", on_arrays(&P::compose)},
          {"tangent", on_arrays(&P::tangent)},
          {"tangent_inverse", on_arrays(&P::tangent_inverse)},
          {"tangent_derivative", on_arrays(&P::tangent_derivative)},
          {"tangent_inverse_derivative", on_arrays(&P::tangent_inverse_derivative)},
          {"angular_velocity", on_arrays(&mechanism::angular_velocity<P>)},
          {"angular_acceleration", on_arrays(&mechanism::angular_acceleration<P>)},
          {"parameter_rate", on_arrays(&mechanism::parameter_rate<P>)},
          {"parameter_acceleration", on_arrays(&mechanism::parameter_acceleration<P>)}};
}

const std::map<std::string, Functions>& parametrisations() {
  using namespace mechanism;
  static const std::map<std::string, Functions> all = {{"rotation_vector", functions_of<RotationVector>()},
                                                       {"quaternion", functions_of<UnitQuaternion>()},
                                                       {"rodrigues", functions_of<RodriguesVector>()},
                                                       {"conformal", functions_of<ConformalVector>()},
                                                       {"euler", functions_of<EulerAngles>()},
                                                       {"bryant", functions_of<BryantAngles>()}};
  return all;
}

}  // namespace

void bind_rotations(py::module_& module) {
  module.def("rotations",
             [](const std::string& parametrisation, const std::string& function, const std::vector<Items>& arrays) {
               return parametrisations().at(parametrisation).at(function)(arrays);
             });
}

}  // namespace bielle::python

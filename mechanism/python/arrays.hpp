// Numbers as NumPy arrays, without copies if another object keeps them.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>

namespace bielle::python {

/// Returns an array that takes ownership of the numbers. @param shape  shape with the same number of entries
inline pybind11::array_t<double> take_array(std::vector<double>&& values, const std::vector<std::size_t>& shape) {
  auto held = std::make_unique<std::vector<double>>(std::move(values));
  const double* data = held->data();
  const pybind11::capsule owner(held.get(), [](void* pointer) { delete static_cast<std::vector<double>*>(pointer); });
  held.release();
  return pybind11::array_t<double>(shape, data, owner);
}

/// Returns a number if the shape is {}, otherwise an array.
inline pybind11::object number_or_array(std::vector<double>&& values, const std::vector<std::size_t>& shape) {
  if (shape.empty() && values.size() == 1) return pybind11::float_(values[0]);
  return take_array(std::move(values), shape);
}

/// Returns a view of numbers that `owner` keeps alive. @param strides  in numbers, not in bytes
inline pybind11::array_t<double> view_array(const double* data, const std::vector<std::size_t>& shape,
                                            std::vector<std::size_t> strides, const pybind11::handle& owner,
                                            bool writeable) {
  for (std::size_t& stride : strides) stride *= sizeof(double);
  pybind11::array_t<double> view(shape, strides, data, owner);
  if (!writeable) view.attr("flags").attr("writeable") = false;
  return view;
}

/// Returns strides of contiguous numbers, with the last index running fastest.
inline std::vector<std::size_t> packed_strides(const std::vector<std::size_t>& shape) {
  std::vector<std::size_t> strides(shape.size(), 1);
  for (std::size_t k = shape.size(); k-- > 1;) strides[k - 1] = strides[k] * shape[k];
  return strides;
}

}  // namespace bielle::python

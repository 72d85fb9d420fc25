// Lists of numbers as sets.
#pragma once

#include <algorithm>
#include <vector>

namespace bielle {

/// Sorts the values and leaves each of them once.
template <class Value>
void sort_unique(std::vector<Value>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace bielle

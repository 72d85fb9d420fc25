// The components that a component refers to, numbered in the order of its declaration.
#pragma once

#include <algorithm>
#include <vector>

#include "mechanism/model/component.hpp"

namespace bielle::mechanism {

class References {
 public:
  /// @returns the number of the component among those referred to: for LocalState::of and Slots::reference_row
  int add(const Component& component) {
    const auto found = std::find(components_.begin(), components_.end(), &component);
    if (found != components_.end()) return static_cast<int>(found - components_.begin());
    components_.push_back(&component);
    return static_cast<int>(components_.size()) - 1;
  }
  bool empty() const { return components_.empty(); }
  void declare(Declaration& declaration) const { declaration.references = components_; }

 private:
  std::vector<const Component*> components_;
};

}  // namespace bielle::mechanism

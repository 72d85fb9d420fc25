// The prescribed motions of a node, as formulas of time.
#pragma once

#include "mechanism/model/model.hpp"
#include "mechanism/model/time_dependent.hpp"
#include "reduce/common/direction_words.hpp"

namespace bielle::mechanism {

class PrescribedNode final : public TimeDependent {
 public:
  explicit PrescribedNode(const Node& node) : node_(node) {}
  std::vector<Formula> time_formulas() const override {
    std::vector<Formula> formulas;
    for (std::size_t k = 0; k < 6; ++k)
      if (node_.freedom[k] == Freedom::prescribed)
        formulas.push_back({std::string("motion ") + direction_words[k], k < 3 ? "m" : "rad", Part::position, k >= 3});
    return formulas;
  }
  void calc_time_formulas(const LocalState& state, std::span<double> values) const override {
    std::size_t next = 0;
    for (std::size_t k = 0; k < 6; ++k)
      if (node_.freedom[k] == Freedom::prescribed) values[next++] = node_.motion[k](state.time());
  }

 private:
  const Node& node_;
};

}  // namespace bielle::mechanism

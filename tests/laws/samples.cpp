#include "tests/laws/sample.hpp"

namespace bielle::laws {

const std::vector<Sample>& samples() {
  static const std::vector<Sample> all = [] {
    std::vector<Sample> list = element_samples();
    for (std::vector<Sample>& more : std::vector{joint_samples(), drive_samples(), state_samples()})
      for (Sample& sample : more) list.push_back(std::move(sample));
    return list;
  }();
  return all;
}

}  // namespace bielle::laws

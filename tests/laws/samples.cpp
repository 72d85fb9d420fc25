#include "tests/laws/sample.hpp"

namespace bielle::laws {

const std::vector<Sample>& samples() {
  static const std::vector<Sample> all = [] {
    std::vector<Sample> list = element_samples();
    for (const auto& more : {joint_samples, higher_pair_samples, contact_samples, coupling_samples, flexible_samples,
                             friction_samples, drive_samples, state_samples, hydraulic_samples})
      for (Sample& sample : more()) list.push_back(std::move(sample));
    return list;
  }();
  return all;
}

}  // namespace bielle::laws

#include "reduce/spectral/bordered_part.hpp"

namespace bielle {

std::vector<double> BorderedPart::diagonal() const {
  std::vector<double> result;
  result.reserve(static_cast<std::size_t>(size()));
  for (const std::int64_t j : kept)
    result.push_back(whole.values[static_cast<std::size_t>(whole.starts[static_cast<std::size_t>(j)])]);
  for (Eigen::Index c = 0; c < corner.cols(); ++c) result.push_back(corner(c, c));
  return result;
}

}  // namespace bielle

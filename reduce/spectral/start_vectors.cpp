#include "reduce/spectral/start_vectors.hpp"

namespace bielle {

Eigen::MatrixXd StartVectors::draw(Eigen::Index count) {
  Eigen::MatrixXd result(size_, count);
  for (double& value : result.reshaped()) {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    value = static_cast<double>(static_cast<std::int64_t>(state_)) * 0x1p-63;
  }
  return result;
}

}  // namespace bielle

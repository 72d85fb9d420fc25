#include "mechanism/solvers/linearised/residual_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bielle::mechanism {

VectorX residual_sizes(const System& system, const LinearisedEquations::Sparse& K, ResidualScale scale, double length,
                       double share) {
  double stiffest = 0;
  for (Eigen::Index k = 0; k < K.nonZeros(); ++k) stiffest = std::max(stiffest, std::abs(K.valuePtr()[k]));
  const double rounding = 16 * std::numeric_limits<double>::epsilon() * stiffest * length / share;
  double& force = scale[Kind::translation];
  double& moment = scale[Kind::rotation];
  force = std::max({force, rounding, moment / length});
  moment = std::max(moment, length * force);
  VectorX sizes(K.rows());
  for (int i = 0; i < static_cast<int>(sizes.size()); ++i) {
    const Kind kind = system.kind(i);
    sizes[i] = scale[kind];
    if (kind == Kind::amplitude && stiffest > 0)
      sizes[i] = std::max(sizes[i], force * std::sqrt(std::abs(K.coeff(i, i)) / stiffest));
  }
  return sizes;
}

}  // namespace bielle::mechanism

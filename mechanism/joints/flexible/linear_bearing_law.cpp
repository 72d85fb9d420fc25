#include "mechanism/joints/flexible/linear_bearing_law.hpp"

#include <fmt/format.h>

namespace bielle::mechanism {

BearingLaw::Force LinearBearingLaw::calc(const Vector6& e, const Vector6& v) const {
  Force force{K * e + D * v, K, D};
  if (film) {
    const FilmCoefficients::At at = (*film)(v[5]);
    force.N += at.K * e + at.D * v;
    force.by_e += at.K;
    force.by_v += at.D;
    force.by_v.col(5) += at.K_slope * e + at.D_slope * v;
  }
  return force;
}

BearingLaw::Potential LinearBearingLaw::potential(const Vector6& e) const {
  const Vector6 N = 0.5 * (K + K.transpose()) * e;
  return {0.5 * e.dot(N), N};
}

std::vector<std::string> LinearBearingLaw::describe() const {
  const auto words = [](const Matrix6& A, const char* along, const char* about) {
    const std::string text = fmt::format("[{:.6g}, {:.6g}, {:.6g}] {}, [{:.6g}, {:.6g}] {}", A(0, 0), A(1, 1), A(2, 2),
                                         along, A(3, 3), A(4, 4), about);
    return A.isDiagonal(0) ? text : "a full matrix, diagonal " + text;
  };
  std::vector<std::string> facts;
  if (!K.isZero(0)) facts.push_back("stiffness " + words(K, "N/m", "N m/rad"));
  if (!D.isZero(0)) facts.push_back("damping " + words(D, "N s/m", "N m s/rad"));
  if (film) facts.push_back(film->describe());
  return facts;
}

}  // namespace bielle::mechanism

#include "mechanism/joints/cams/cam_contour.hpp"

#include <cmath>

#include <fmt/format.h>

#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

MatrixX cartesian(const Eigen::Ref<const MatrixX>& polar, const std::string& name) {
  MatrixX points(polar.rows(), 3);
  for (Eigen::Index k = 0; k < polar.rows(); ++k) {
    if (!(polar(k, 1) > 0))
      throw InputError(fmt::format("{}: a cam's radius is greater than 0, row {} has {}", name, k + 1, polar(k, 1)));
    if (k > 0 && !(polar(k, 0) > polar(k - 1, 0)))
      throw InputError(
          fmt::format("{}: the angles must ascend, but {} follows {}", name, polar(k, 0), polar(k - 1, 0)));
    points.row(k) << polar(k, 1) * std::cos(polar(k, 0)), polar(k, 1) * std::sin(polar(k, 0)), 0;
  }
  if (polar.rows() > 0 && polar(polar.rows() - 1, 0) - polar(0, 0) >= 2 * M_PI * (1 - 1e-9))
    throw InputError(fmt::format(
        "{}: the angles of a contour run over less than a turn (2 pi); the first point is not repeated", name));
  return points;
}

}  // namespace

CamContour::CamContour(const Eigen::Ref<const MatrixX>& polar, std::string name)
    : name_(std::move(name)), points_(polar.rows()), contour_(cartesian(polar, name_), true, name_) {}

std::vector<CamContour::Sample> CamContour::sample(int per_piece) const {
  std::vector<Sample> samples;
  const auto count = static_cast<std::size_t>(per_piece) * static_cast<std::size_t>(points_);
  for (std::size_t k = 0; k < count; ++k) {
    const Curve::Place c = contour_(contour_.end() * static_cast<double>(k) / static_cast<double>(count));
    const double speed = c.first.norm();
    samples.push_back({c.point, Vector3(c.first.y(), -c.first.x(), 0) / speed,
                       (c.first.x() * c.second.y() - c.first.y() * c.second.x()) / (speed * speed * speed)});
  }
  return samples;
}

std::vector<Vector3> CamContour::points() const {
  constexpr Eigen::Index enough = 360;
  std::vector<Vector3> points;
  for (const Sample& each : sample(static_cast<int>(std::max<Eigen::Index>(1, enough / points_))))
    points.push_back(each.point);
  return points;
}

Curve CamContour::pitch_curve(double radius) const {
  if (radius == 0) return contour_;
  const std::vector<Sample> samples = sample(8);
  MatrixX points(static_cast<Eigen::Index>(samples.size()), 3);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (1 + radius * samples[k].curvature <= 0)
      throw InputError(fmt::format(
          "{}: a roller of {:.6g} m does not fit into the hollow at ({:.6g}, {:.6g}) m, whose radius is {:.6g} m",
          name_, radius, samples[k].point.x(), samples[k].point.y(), -1 / samples[k].curvature));
    points.row(static_cast<Eigen::Index>(k)) = (samples[k].point + radius * samples[k].normal).transpose();
  }
  return {points, true, name_};
}

Interpolation CamContour::support() const {
  // Each point of a convex contour touches the face with its own normal; (psi, H) therefore follow without a search.
  const std::vector<Sample> samples = sample(8);
  VectorX psi = VectorX::Zero(static_cast<Eigen::Index>(samples.size()) + 1), H = psi;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const Sample& each = samples[k];
    if (!(each.curvature > 0))
      throw InputError(
          fmt::format("{}: the contour is hollow at ({:.6g}, {:.6g}) m: a flat follower does not reach it; "
                      "take a roller",
                      name_, each.point.x(), each.point.y()));
    const auto row = static_cast<Eigen::Index>(k);
    psi[row] = std::atan2(each.normal.y(), each.normal.x());
    if (k > 0) psi[row] += 2 * M_PI * std::round((psi[row - 1] - psi[row]) / (2 * M_PI));
    H[row] = each.normal.dot(each.point);
  }
  const Eigen::Index last = psi.size() - 1;
  psi[last] = psi[0] + 2 * M_PI;
  H[last] = H[0];
  return {psi, H, Interpolation::Kind::periodic, name_};
}

}  // namespace bielle::mechanism

#include "mechanism/joints/flexible/film_map.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

#include <Eigen/LU>

#include "mechanism/joints/flexible/journal_film.hpp"
#include "mechanism/joints/flexible/reynolds_film.hpp"

namespace bielle::mechanism {
namespace {

constexpr int nodes_per_side = 12, node_count = 2 * nodes_per_side + 1;
constexpr double last_eccentricity = 0.995;  ///< eccentricity of the last nodes on the axes

double node_distance() {
  return std::asinh(last_eccentricity / std::sqrt(1 - last_eccentricity * last_eccentricity)) / nodes_per_side;
}

/// Index of a coefficient, mirrored at the ends: the slope of the spline is zero there.
int mirrored_node(int k) { return k < 0 ? -k : k < node_count ? k : 2 * (node_count - 1) - k; }

/// Weights of the four B-splines that are not zero at a place, and their slopes.
struct SplineBlend {
  int first = 0;
  std::array<double, 4> weight, slope;
  explicit SplineBlend(double place) {
    constexpr double end = node_count - 1;
    const bool outside = place <= 0 || place >= end;
    const double inside = std::min(std::max(place, 0.0), end);
    const int cell = std::min(static_cast<int>(inside), node_count - 2);
    const double t = inside - cell, r = 1 - t;
    first = cell - 1;
    weight = {r * r * r / 6, (4 - 6 * t * t + 3 * t * t * t) / 6, (4 - 6 * r * r + 3 * r * r * r) / 6, t * t * t / 6};
    slope = {-r * r / 2, -2 * t + 1.5 * t * t, 2 * r - 1.5 * r * r, t * t / 2};
    if (outside) slope.fill(0);
  }
};

}  // namespace

FilmMap::FilmMap(double slenderness) {
  const JournalFilm half_film(slenderness);
  const double step = node_distance();
  std::array<MatrixX, 2> values;
  values.fill(MatrixX::Zero(node_count, node_count));
  for (int i = 0; i < node_count; ++i)
    for (int j = nodes_per_side; j < node_count; ++j) {
      const double X = std::sinh((i - nodes_per_side) * step), Y = std::sinh((j - nodes_per_side) * step),
                   size = std::sqrt(1 + X * X + Y * Y);
      const Vector2 W = half_film.shape(X / size, Y / size).W;
      const Vector2 D = (reynolds_film(X / size, Y / size, slenderness) - W) / W.norm();
      const int opposite = node_count - 1 - j;  // at -d
      values[0](i, j) = values[0](i, opposite) = D[0];
      if (j == nodes_per_side) continue;
      values[1](i, j) = D[1];
      values[1](i, opposite) = -D[1];
    }
  MatrixX spline = MatrixX::Zero(node_count, node_count);
  for (int k = 0; k < node_count; ++k) {
    spline(k, k) += 4.0 / 6;
    spline(k, mirrored_node(k - 1)) += 1.0 / 6;
    spline(k, mirrored_node(k + 1)) += 1.0 / 6;
  }
  const Eigen::PartialPivLU<MatrixX> factor(spline);
  for (std::size_t k = 0; k < 2; ++k) {
    const MatrixX rows = factor.solve(values[k]);
    coefficients_[k] = factor.solve(rows.transpose()).transpose();
  }
}

std::array<FilmMap::Jet, 2> FilmMap::difference(double a_value, double d_value) const {
  const Jet a(a_value, Jet::Gradient(1, 0)), d(d_value, Jet::Gradient(0, 1));
  const double e = std::hypot(a_value, d_value), gap = (1 - e) * (1 + e);
  const Jet scale(1 / std::sqrt(gap), Jet::Gradient(a_value, d_value) / (gap * std::sqrt(gap)));
  const auto place = [&](const Jet& x) {
    const Jet X = x * scale;
    const double step = node_distance();
    return compose(X, std::asinh(X.value) / step + nodes_per_side, 1 / (step * std::sqrt(1 + X.value * X.value)));
  };
  const Jet u = place(a), v = place(d);
  const SplineBlend along_a(u.value), along_d(v.value);
  std::array<Jet, 2> D;
  for (std::size_t k = 0; k < 2; ++k) {
    double value = 0, by_u = 0, by_v = 0;
    for (int p = 0; p < 4; ++p)
      for (int q = 0; q < 4; ++q) {
        const double c = coefficients_[k](mirrored_node(along_a.first + p), mirrored_node(along_d.first + q));
        const auto i = static_cast<std::size_t>(p), j = static_cast<std::size_t>(q);
        value += c * along_a.weight[i] * along_d.weight[j];
        by_u += c * along_a.slope[i] * along_d.weight[j];
        by_v += c * along_a.weight[i] * along_d.slope[j];
      }
    D[k] = Jet(value, by_u * u.gradient + by_v * v.gradient);
  }
  return D;
}

std::shared_ptr<const FilmMap> FilmMap::of(double slenderness) {
  static std::mutex guard;
  static std::map<double, std::shared_ptr<const FilmMap>> made;
  const std::lock_guard<std::mutex> lock(guard);
  std::shared_ptr<const FilmMap>& map = made[slenderness];
  if (!map) map = std::make_shared<const FilmMap>(slenderness);
  return map;
}

}  // namespace bielle::mechanism

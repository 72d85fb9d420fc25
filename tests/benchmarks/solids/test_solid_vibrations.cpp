// Free vibrations of solids: a benchmark of NAFEMS, and a thick plate in closed form.
#include <cmath>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/support/cell_box.hpp"
#include "tests/support/solid_model.hpp"

using namespace bielle;
using namespace bielle::reduce;
using test::cell_box;

namespace test_solid_vibrations {

constexpr double young = 200e9, poisson = 0.3, density = 8000;
const Material steel = Material::isotropic(young, poisson, density);

TEST_CASE("A tapered membrane (NAFEMS FV32) has the frequencies of plane stress") {
  // 10 m long, 5 m high at the clamped end and 1 m at the other; one half of its thickness of 0.05 m. Source: F.
  // Abbassian, D. J. Dawswell, N. C. Knowles, Selected Benchmarks for Natural Frequency Analysis, NAFEMS 1987, test 32.
  const auto tapered = [](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(x.x(), (x.y() - 0.5) * (5 - 0.4 * x.x()), x.z());
  };
  const auto held = [](const Eigen::Vector3d& x, int i) { return i == 2 ? x.z() < 1e-9 : x.x() < 1e-9; };
  const test::SolidModel model(cell_box(CellType::hex20, {10, 1, 0.025}, {16, 8, 1}, tapered), steel, held);
  const std::vector<double> target = {44.623, 130.03, 162.70, 246.05, 379.90, 391.44};
  const Eigen::VectorXd found = model.frequencies(6);
  INFO(found.transpose());
  for (std::size_t k = 0; k < target.size(); ++k)
    CHECK(found(static_cast<Eigen::Index>(k)) == Approx(target[k]).epsilon(2e-4));
}

/// Returns the frequency [Hz] of Lamb's lowest antisymmetric wave of wavenumber k in a plate of thickness h.
double lamb(double k, double h) {
  const double ct2 = young / (2 * (1 + poisson)) / density;
  const double cl2 = young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson)) / density;
  const auto excess = [&](double omega) {
    const double a = std::sqrt(k * k - omega * omega / cl2), b = std::sqrt(k * k - omega * omega / ct2);
    return 4 * k * k * a * b * std::tanh(b * h / 2) - std::pow(k * k + b * b, 2) * std::tanh(a * h / 2);
  };
  // The function is zero at omega = 0 and at the wave, and negative in between.
  double low = 1e-3 * k * std::sqrt(ct2), high = (1 - 1e-12) * k * std::sqrt(ct2);
  const bool sign = excess(low) > 0;
  for (int step = 0; step < 200; ++step) {
    const double middle = (low + high) / 2;
    (excess(middle) > 0) == sign ? low = middle : high = middle;
  }
  return low / (2 * std::numbers::pi);
}

TEST_CASE("A thick plate on simple supports vibrates as Lamb's waves") {
  // 10 m x 10 m x 1 m; the whole edges keep their height and do not slide along themselves. Then waves of bending fit
  // with k^2 = (m pi/a)^2 + (n pi/a)^2, and waves of shear in its plane with c_t k. NAFEMS FV52 has 45.897, 109.44 and
  // 167.89 Hz for the former.
  const auto held = [](const Eigen::Vector3d& x, int i) {
    const bool x_edge = x.x() < 1e-9 || x.x() > 10 - 1e-9, y_edge = x.y() < 1e-9 || x.y() > 10 - 1e-9;
    return (i == 2 && (x_edge || y_edge)) || (i == 1 && x_edge) || (i == 0 && y_edge);
  };
  const double step = std::numbers::pi / 10, shear = std::sqrt(young / 2.6 / density) * step / (2 * std::numbers::pi);
  const double bending[] = {lamb(std::sqrt(2.0) * step, 1), lamb(std::sqrt(5.0) * step, 1),
                            lamb(std::sqrt(8.0) * step, 1)};
  CHECK(bending[0] == Approx(45.897).epsilon(0.003));
  CHECK(bending[1] == Approx(109.44).epsilon(0.005));
  CHECK(bending[2] == Approx(167.89).epsilon(0.006));
  const std::vector<double> exact = {bending[0], bending[1], bending[1], shear, shear, bending[2]};
  Eigen::MatrixXd errors(2, 6);
  for (int level = 0; level < 2; ++level) {
    const int n = 4 << level;
    const test::SolidModel model(cell_box(CellType::hex20, {10, 10, 1}, {n, n, level + 1}), steel, held);
    const Eigen::VectorXd found = model.frequencies(6);
    for (Eigen::Index k = 0; k < 6; ++k) errors(level, k) = found(k) / exact[static_cast<std::size_t>(k)] - 1;
  }
  INFO(errors);
  CHECK(errors.minCoeff() > 0);
  CHECK((errors.row(0).array() / errors.row(1).array()).minCoeff() > 10);  // order 4: 16
  CHECK(errors.row(1).maxCoeff() < 3e-3);
}

}  // namespace test_solid_vibrations

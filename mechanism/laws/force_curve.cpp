#include "mechanism/laws/force_curve.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "reduce/common/files/table_file.hpp"

namespace bielle::mechanism {

ForceCurve ForceCurve::from_file(const std::string& path) {
  const Eigen::MatrixXd table = read_table(path, 2);
  if (table.rows() < 2) throw InputError(fmt::format("{}: a curve needs at least two points", path));
  for (Eigen::Index k = 1; k < table.rows(); ++k)
    if (!(table(k, 0) > table(k - 1, 0)))
      throw InputError(
          fmt::format("{}: displacements must ascend: {:.9g} follows {:.9g}", path, table(k, 0), table(k - 1, 0)));
  const auto column = [&](Eigen::Index c) {
    return std::vector<double>(table.col(c).data(), table.col(c).data() + table.rows());
  };
  return {column(0), column(1)};
}

ForceCurve::ForceCurve(std::vector<double> x, std::vector<double> force)
    : x_(std::move(x)), force_(std::move(force)), area_{0} {
  for (std::size_t k = 1; k < x_.size(); ++k) {
    const double width = x_[k] - x_[k - 1];
    slope_.push_back((force_[k] - force_[k - 1]) / width);
    area_.push_back(area_.back() + 0.5 * width * (force_[k] + force_[k - 1]));
  }
  at_zero_ = integral(0);
}

std::size_t ForceCurve::piece(double x) const {
  const auto after = static_cast<std::size_t>(std::upper_bound(x_.begin(), x_.end(), x) - x_.begin());
  return std::clamp<std::size_t>(after, 1, x_.size() - 1) - 1;
}

ForceCurve::Values ForceCurve::operator()(double x) const {
  const std::size_t k = piece(x);
  return {force_[k] + slope_[k] * (x - x_[k]), slope_[k]};
}

double ForceCurve::integral(double x) const {
  const std::size_t k = piece(x);
  const double s = x - x_[k];
  return area_[k] + s * (force_[k] + 0.5 * slope_[k] * s);
}

}  // namespace bielle::mechanism

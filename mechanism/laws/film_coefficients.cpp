#include "mechanism/laws/film_coefficients.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "mechanism/reading/read_file.hpp"
#include "reduce/common/files/table_file.hpp"

namespace bielle::mechanism {

FilmCoefficients::FilmCoefficients(Eigen::Index measures, const Eigen::MatrixXd& table, const std::string& name)
    : measures_(measures), first_(table(0, 0)), last_(table(table.rows() - 1, 0)) {
  for (Eigen::Index k = 1; k < table.cols(); ++k)
    coefficients_.emplace_back(table.col(0), table.col(k), Interpolation::Kind::linear, name);
}

FilmCoefficients::At FilmCoefficients::operator()(double speed) const {
  At at;
  const bool inside = speed > first_ && speed < last_;
  const double held = std::clamp(speed, first_, last_);
  const auto set = [&](std::size_t k, double& value, double& slope) {
    const Interpolation::Values found = coefficients_[k](held);
    value = found.value;
    slope = inside ? found.slope : 0;
  };
  std::size_t k = 0;
  for (Matrix6* const matrix : {&at.K, &at.D}) {
    Matrix6& slopes = matrix == &at.K ? at.K_slope : at.D_slope;
    for (Eigen::Index row = 0; row < measures_; ++row)
      for (Eigen::Index column = 0; column < measures_; ++column) set(k++, (*matrix)(row, column), slopes(row, column));
  }
  return at;
}

std::string FilmCoefficients::describe() const {
  return fmt::format("film coefficients from {:.6g} to {:.6g} rad/s", first_, last_);
}

FilmCoefficients read_film_coefficients(const YamlValue& given, Eigen::Index all) {
  const auto radial = given.find("table"), matrices = given.find("matrices");
  if (radial.has_value() == matrices.has_value()) given.fail("expected either `table` or `matrices`");
  const Eigen::Index measures = radial ? 2 : all;
  return read_named_file(radial ? *radial : *matrices, [&](const std::string& path) {
    return FilmCoefficients(measures, read_table(path, FilmCoefficients::columns(measures)), path);
  });
}

}  // namespace bielle::mechanism

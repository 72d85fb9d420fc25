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

Eigen::MatrixXd BorderedPart::multiply(const Eigen::MatrixXd& x, int threads) const {
  const auto inside = static_cast<Eigen::Index>(kept.size());
  RowMatrix of_whole = RowMatrix::Zero(whole.size, x.cols());
#pragma omp parallel for num_threads(threads)
  for (Eigen::Index k = 0; k < inside; ++k) of_whole.row(kept[static_cast<std::size_t>(k)]) = x.row(k);
  const RowMatrix product = whole.multiply(of_whole, threads);
  Eigen::MatrixXd y(x.rows(), x.cols());
#pragma omp parallel for num_threads(threads)
  for (Eigen::Index k = 0; k < inside; ++k) y.row(k) = product.row(kept[static_cast<std::size_t>(k)]);
  if (const Eigen::Index c = corner.cols(); c > 0) {
    y.topRows(inside) += border * x.bottomRows(c);
    y.bottomRows(c) = border.transpose() * x.topRows(inside);
    y.bottomRows(c) += corner.selfadjointView<Eigen::Lower>() * x.bottomRows(c);
  }
  return y;
}

}  // namespace bielle

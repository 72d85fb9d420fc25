#include "mechanism/solvers/linearised/equation_rounding.hpp"

#include <cmath>
#include <limits>
#include <numeric>

namespace bielle::mechanism {
namespace {

/// This is the relative rounding of an entry that is the sum of some tens of terms.
constexpr double rounding_of_entries = 64 * std::numeric_limits<double>::epsilon();

}  // namespace

EquationRounding::EquationRounding(const LinearisedEquations& equations)
    : equations_(equations), group_(equations.group) {
  if (group_.empty()) {
    group_.resize(static_cast<std::size_t>(equations.unknowns()));
    std::iota(group_.begin(), group_.end(), 0);
  }
  for (const int group : group_) groups_ = std::max(groups_, group + 1);
  moments_ = VectorX::Zero(groups_);
  const Sparse C = norms(equations.C), M = norms(equations.M), W = norms(equations.W);
  M_ = M;
  C_ = C + Sparse(M * W);
  K_ = norms(equations.K) + Sparse(C * W);
}

EquationRounding::Sparse EquationRounding::norms(const Sparse& A) const {
  std::vector<Eigen::Triplet<double>> squares;
  squares.reserve(static_cast<std::size_t>(A.nonZeros()));
  for (int j = 0; j < A.outerSize(); ++j)
    for (Sparse::InnerIterator it(A, j); it; ++it)
      squares.emplace_back(group_[static_cast<std::size_t>(it.row())], group_[static_cast<std::size_t>(j)],
                           it.value() * it.value());
  Sparse result(groups_, groups_);
  result.setFromTriplets(squares.begin(), squares.end());
  for (int j = 0; j < result.outerSize(); ++j)
    for (Sparse::InnerIterator it(result, j); it; ++it) it.valueRef() = std::sqrt(it.value());
  return result;
}

VectorX EquationRounding::norms(const Eigen::VectorXcd& x) const {
  VectorX result = VectorX::Zero(groups_);
  for (Eigen::Index i = 0; i < x.size(); ++i) result[group_[static_cast<std::size_t>(i)]] += std::norm(x[i]);
  return result.cwiseSqrt();
}

void EquationRounding::set_uncertain_reactions(const VectorX& reactions) {
  const Sparse& B = equations_.B;
  moments_.setZero();
  for (int j = 0; j < B.outerSize(); ++j) {
    if (!equations_.turns[static_cast<std::size_t>(j)]) continue;
    double square = 0;
    for (Sparse::InnerIterator it(B, j); it; ++it) square += std::pow(it.value() * reactions[it.row()], 2);
    moments_[group_[static_cast<std::size_t>(j)]] += square;
  }
  moments_ = moments_.cwiseSqrt().eval();
}

double EquationRounding::operator()(const Eigen::VectorXcd& y, std::complex<double> s,
                                    const Eigen::VectorXcd& x) const {
  const VectorX left = norms(y), right = norms(x);
  const double rate = std::abs(s);
  double sum = 0;
  const auto add = [&](const Sparse& A, double factor) {
    if (factor == 0) return;
    for (int j = 0; j < A.outerSize(); ++j)
      for (Sparse::InnerIterator it(A, j); it; ++it)
        sum += std::pow(rounding_of_entries * factor * left[it.row()] * it.value() * right[j], 2);
  };
  add(K_, 1);
  add(C_, rate);
  add(M_, rate * rate);
  sum += left.cwiseProduct(moments_).cwiseProduct(right).squaredNorm();
  return std::sqrt(sum);
}

}  // namespace bielle::mechanism

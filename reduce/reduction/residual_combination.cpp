#include "reduce/reduction/residual_combination.hpp"

#include "reduce/common/error.hpp"
#include "reduce/common/leading_component.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "reduce/reduction/reduced_matrices.hpp"

namespace bielle::reduce {

namespace {

/// Fields that are combined, with the weights that made them.
class CombinedFields {
 public:
  CombinedFields(const RowMatrix& answers, const RowMatrix& modes, const BodyProducts& body)
      : modes_(modes), body_(body) {
    result_.fields = answers;
    result_.of_answers.setIdentity(answers.cols(), answers.cols());
    result_.of_modes.setZero(modes.cols(), answers.cols());
  }
  void combine(const Eigen::MatrixXd& weights) {
    result_.fields = RowMatrix(result_.fields * weights);
    result_.of_answers = Eigen::MatrixXd(result_.of_answers * weights);
    result_.of_modes = Eigen::MatrixXd(result_.of_modes * weights);
  }
  /// Computes r = u - Phi Phi^T M u.
  void remove_modes() {
    if (modes_.cols() == 0) return;
    const Eigen::MatrixXd amplitudes = inner_products(modes_, body_.mass(result_.fields));
    result_.fields -= modes_ * amplitudes;
    result_.of_modes += amplitudes;
  }
  /// Makes leading components positive, whatever the signs of the eigenvectors.
  void choose_signs() {
    Eigen::VectorXd signs = Eigen::VectorXd::Ones(result_.fields.cols());
    for (Eigen::Index k = 0; k < signs.size(); ++k)
      if (leading_component(result_.fields.col(k)) < 0) signs(k) = -1;
    combine(signs.asDiagonal());
  }
  Eigen::MatrixXd stiffness() const { return inner_products(result_.fields, body_.stiffness(result_.fields)); }
  Eigen::MatrixXd mass() const { return inner_products(result_.fields, body_.mass(result_.fields)); }
  Eigen::VectorXd twice_energies() const {
    return result_.fields.cwiseProduct(body_.stiffness(result_.fields)).colwise().sum().transpose();
  }
  ResidualCombination& result() { return result_; }

 private:
  const RowMatrix& modes_;
  const BodyProducts& body_;
  ResidualCombination result_;
};

/// Returns combinations of unit energy that are orthogonal in K; linearly dependent ones are left out.
Eigen::MatrixXd independent_fields(const Eigen::MatrixXd& energies) {
  const SymmetricEigenpairs pairs = symmetric_eigenpairs(energies);
  const Eigen::Index rank = (pairs.values.array() > negligible_energy * pairs.values.maxCoeff()).count();
  const Eigen::VectorXd scale = pairs.values.tail(rank).cwiseSqrt().cwiseInverse();
  return pairs.vectors.rightCols(rank) * scale.asDiagonal();
}

}  // namespace

ResidualCombination combine_residuals(const RowMatrix& answers, const RowMatrix& modes,
                                      const Eigen::VectorXd& least_energies, const BodyProducts& body) {
  CombinedFields fields(answers, modes, body);
  const Eigen::VectorXd whole = fields.twice_energies().cwiseMax(least_energies);
  fields.remove_modes();
  const Eigen::VectorXd rest = fields.twice_energies();
  std::vector<Eigen::Index> left;
  for (Eigen::Index k = 0; k < rest.size(); ++k) {
    const bool is_left = rest(k) > negligible_energy * whole(k);
    fields.result().is_left.push_back(is_left);
    if (is_left) left.push_back(k);
  }
  const Eigen::VectorXd unit = rest.cwiseSqrt().cwiseInverse();
  fields.combine(Eigen::MatrixXd(unit.asDiagonal())(Eigen::all, left));
  if (left.empty()) return std::move(fields.result());

  fields.combine(independent_fields(fields.stiffness()));
  // Remainders of the modes after cancellation become visible in small vectors, so the modes are removed once more.
  fields.remove_modes();
  const auto pairs = symmetric_eigenpairs(fields.mass(), fields.stiffness());
  if (!pairs || pairs->values.minCoeff() <= 0)
    throw ComputationError(
        "the residual vectors have no positive mass and stiffness: a very distorted mesh may be the cause");
  const Eigen::VectorXd flexibilities = pairs->values.reverse();  // 1 / omega^2
  const Eigen::MatrixXd vectors = pairs->vectors.rowwise().reverse();
  fields.combine(vectors * flexibilities.cwiseSqrt().cwiseInverse().asDiagonal());
  fields.choose_signs();
  fields.result().eigenvalues = flexibilities.cwiseInverse();
  return std::move(fields.result());
}

}  // namespace bielle::reduce

#include "reduce/reduction/fixed_interface_body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/dense/dense_products.hpp"
#include "reduce/dense/dense_solves.hpp"
#include "reduce/dense/tall_products.hpp"

namespace bielle::reduce {

FixedInterfaceBody::~FixedInterfaceBody() = default;

const FactorStatistics& FixedInterfaceBody::statistics() const {
  return factor_ ? factor_->statistics() : no_statistics_;
}

FixedInterfaceBody::FixedInterfaceBody(HeldFreedoms freedoms, const Solid& solid, const BodyMatrices& matrices,
                                       const Ties& ties, int threads)
    : threads_(threads), freedoms_(std::move(freedoms)) {
  factorise(matrices, solid);
  close_conditions(ties);
}

RowMatrix FixedInterfaceBody::expand(const Eigen::MatrixXd& z) const {
  RowMatrix u(freedoms_.carry_released.rows(), z.cols());
  freedoms_.expand_into(z, u, threads_);
  return u;
}

Eigen::MatrixXd FixedInterfaceBody::restrict(const RowMatrix& forces) const {
  Eigen::MatrixXd f(freedoms_.size, forces.cols());
  freedoms_.restrict_into(forces, f, threads_);
  return f;
}

Eigen::MatrixXd FixedInterfaceBody::inertia(const BodyMatrices& matrices, const Eigen::MatrixXd& z) const {
  constexpr Eigen::Index few = 16;  // columns at a time: fields on all points are large
  Eigen::MatrixXd forces(freedoms_.size, z.cols());
  for (Eigen::Index first = 0; first < z.cols(); first += few) {
    const Eigen::Index width = std::min(few, z.cols() - first);
    RowMatrix u(freedoms_.carry_released.rows(), width);
    freedoms_.expand_into(z.middleCols(first, width), u, threads_);
    freedoms_.restrict_into(matrices.mass_times(u), forces.middleCols(first, width), threads_);
  }
  return forces;
}

void FixedInterfaceBody::factorise(const BodyMatrices& matrices, const Solid& solid) {
  const InteriorUnknowns interior = freedoms_.interior();
  try {
    factor_ = matrices.factorise(interior);
  } catch (const NotPositiveDefinite& error) {
    if (error.unknown() < static_cast<std::int64_t>(interior.kept.size())) {
      const Eigen::Vector3d x = solid.mesh.points.col(interior.kept[error.unknown()] / 3);
      const char* reduced = "reduced integration leaves hourglass modes, leave 'integration: reduced' out; or ";
      throw ComputationError(
          fmt::format("the stiffness of the body is singular at the point ({:.4g}, {:.4g}, {:.4g}) m: {}a part of the "
                      "mesh is attached there at a point or an edge only, or its cells are degenerate",
                      x.x(), x.y(), x.z(), solid.integration == Integration::reduced ? reduced : ""));
    }
    throw ComputationError("the stiffness of the body is singular in a released direction of an interface");
  }
}

Eigen::MatrixXd FixedInterfaceBody::pseudo_solve(const Eigen::MatrixXd& f) const {
  if (!factor_) return Eigen::MatrixXd::Zero(freedoms_.size, f.cols());
  if (freedoms_.supports.empty()) return factor_->solve(f);
  Eigen::MatrixXd inside(static_cast<Eigen::Index>(freedoms_.not_supports.size()), f.cols()),
      z(freedoms_.size, f.cols());
  freedoms_.leave_supports_out(f, inside, threads_);
  freedoms_.put_supports_in(factor_->solve(inside), z, threads_);
  return z;
}

void FixedInterfaceBody::close_conditions(const Ties& ties) {
  const Eigen::Index a = freedoms_.conditions.cols(), r = freedoms_.rigid.cols();
  if (a == 0) {
    return;
  }
  const Eigen::MatrixXd flexibility = pseudo_solve(freedoms_.conditions);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(a + r, a + r);
  matrix.topLeftCorner(a, a) = transposed_product(freedoms_.conditions, flexibility);
  matrix.topRightCorner(a, r) = -transposed_product(freedoms_.conditions, freedoms_.rigid);
  matrix.bottomLeftCorner(r, a) = transposed_product(freedoms_.rigid, freedoms_.conditions);
  corrections_.resize(freedoms_.size, a + r);
  corrections_ << flexibility, -freedoms_.rigid;
  // The system is scaled to comparable entries before it is inverted, since multipliers are forces and moments.
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(a + r);
  for (Eigen::Index k = 0; k < a; ++k) {
    scale(k) = 1 / std::sqrt(std::max(matrix(k, k), std::numeric_limits<double>::min()));
  }
  for (Eigen::Index k = 0; k < r; ++k) {
    scale(a + k) = 1 / (scale.head(a).asDiagonal() * matrix.col(a + k).head(a)).norm();
  }
  const std::optional<Eigen::MatrixXd> inverse = regular_inverse(scale.asDiagonal() * matrix * scale.asDiagonal());
  if (!inverse) {
    throw ComputationError(ties.surfaces[ties.kept[ties.averages.front()].interface].subject,
                           "the average ties of the body depend on each other");
  }
  small_ = scale.asDiagonal() * *inverse * scale.asDiagonal();
}

Eigen::MatrixXd FixedInterfaceBody::solve(const Eigen::MatrixXd& f, const Eigen::MatrixXd& averages) const {
  Eigen::MatrixXd z = pseudo_solve(f);
  const Eigen::Index a = freedoms_.conditions.cols(), r = freedoms_.rigid.cols();
  if (a == 0) {
    return z;
  }
  Eigen::MatrixXd right(a + r, f.cols());
  right.topRows(a) = tall_inner_products(freedoms_.conditions, z, threads_);
  if (averages.size() > 0) {
    right.topRows(a) -= averages;
  }
  right.bottomRows(r) = tall_inner_products(freedoms_.rigid, f, threads_);
  add_tall_product(z, corrections_, product(small_, right), -1, threads_);
  return z;
}

}  // namespace bielle::reduce

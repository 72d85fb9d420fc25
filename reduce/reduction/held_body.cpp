#include "reduce/reduction/held_body.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "reduce/common/dense_solves.hpp"
#include "reduce/common/error.hpp"
#include "reduce/common/orthogonal_factors.hpp"
#include "reduce/reduction/rigid_motions.hpp"
#include "reduce/spectral/dense_products.hpp"
#include "reduce/spectral/few_vectors.hpp"
#include "reduce/spectral/tall_products.hpp"

namespace bielle::reduce {

namespace {

/// Singular values below this, relative to the largest, belong to motions that nothing resists. Geometry decides here,
/// not stiffness: a hold that is 1e-8 of the body's size wide holds nothing.
constexpr double free_motion = 1e-8;

std::string words(const Eigen::Vector3d& x) { return fmt::format("({:.4g}, {:.4g}, {:.4g})", x.x(), x.y(), x.z()); }

/// "turn about the axis (0, 0, 1) through (0.1, 0, 0) m" for a velocity v of `centre` and an angular velocity omega.
std::string describe_motion(Eigen::Vector3d v, Eigen::Vector3d omega, const Eigen::Vector3d& centre, double length) {
  if (omega.norm() * length < 1e-6 * v.norm()) {
    return fmt::format("move along {}", words(v.normalized()));
  }
  const Eigen::Vector3d through = centre + omega.cross(v) / omega.squaredNorm();
  const auto cleaned = [&](const Eigen::Vector3d& x, double scale) {
    return Eigen::Vector3d((x.array().abs() < 1e-9 * scale).select(0.0, x.array()));
  };
  return fmt::format("turn about the axis {} through {} m", words(cleaned(omega.normalized(), 1)),
                     words(cleaned(through, length)));
}

/// Basis of the vectors x with A x = 0, columns of A being of comparable size.
Eigen::MatrixXd null_space(const Eigen::MatrixXd& a) {
  if (a.rows() == 0) {
    return Eigen::MatrixXd::Identity(a.cols(), a.cols());
  }
  const RightSingularVectors svd = right_singular_vectors(a);
  const double scale = std::sqrt(static_cast<double>(a.rows()));  // a column of ones has this norm
  const Eigen::Index rank = (svd.values.array() > free_motion * scale).count();
  return svd.vectors.rightCols(a.cols() - rank);
}

}  // namespace

HeldBody::~HeldBody() = default;

const FactorStatistics& HeldBody::statistics() const { return factor_ ? factor_->statistics() : no_statistics_; }

HeldBody::HeldBody(const Solid& solid, const BodyMatrices& matrices, const Ties& ties, int threads)
    : HeldBody(
          solid, ties,
          [&](const std::vector<std::int64_t>& kept, const SparseRows& carried) {
            return matrices.factorise(kept, carried);
          },
          threads) {}

HeldBody::HeldBody(const Solid& solid, const SymmetricMatrix& stiffness, const Ties& ties, int threads)
    : HeldBody(
          solid, ties,
          [&](const std::vector<std::int64_t>& kept, const SparseRows& carried) {
            return factorise_inside(stiffness, kept, carried, threads);
          },
          threads) {}

HeldBody::HeldBody(const Solid& solid, const Ties& ties, const Factorisation& factorisation, int threads)
    : threads_(threads), points_(solid.mesh.points), carry_released_(ties.carry_released) {
  const std::vector<bool> inside = points_of_solid(solid);
  for (std::int64_t a = 0; a < solid.points(); ++a) {
    if (inside[a] && !ties.tied[a]) {
      free_.insert(free_.end(), {3 * a, 3 * a + 1, 3 * a + 2});
    } else {
      not_free_.insert(not_free_.end(), {3 * a, 3 * a + 1, 3 * a + 2});
    }
  }
  size_ = static_cast<Eigen::Index>(free_.size()) + carry_released_.cols();
  conditions_ = restrict(RowMatrix(ties.spread));
  find_rigid_motions(solid, ties);
  choose_supports();
  factorise(factorisation);
  close_conditions(ties);
}

RowMatrix HeldBody::expand(const Eigen::MatrixXd& z) const {
  RowMatrix u(carry_released_.rows(), z.cols());
  expand_into(z, u);
  return u;
}

Eigen::MatrixXd HeldBody::restrict(const RowMatrix& forces) const {
  Eigen::MatrixXd f(size_, forces.cols());
  restrict_into(forces, f);
  return f;
}

void HeldBody::expand_into(const Eigen::Ref<const Eigen::MatrixXd>& z, RowMatrix& u) const {
  const auto free = static_cast<Eigen::Index>(free_.size()), columns = z.cols(), blank = u.cols() - columns;
#pragma omp parallel num_threads(threads_)
  {
#pragma omp for schedule(static) nowait
    for (Eigen::Index k = 0; k < free; ++k) {
      auto row = u.row(free_[static_cast<std::size_t>(k)]);
      for (Eigen::Index c = 0; c < columns; ++c) row(c) = z(k, c);
      row.tail(blank).setZero();
    }
#pragma omp for schedule(static)
    for (std::size_t k = 0; k < not_free_.size(); ++k) {
      auto row = u.row(not_free_[k]);
      row.setZero();
      for (SparseRows::InnerIterator carried(carry_released_, not_free_[k]); carried; ++carried)
        row.head(columns) += carried.value() * z.row(free + carried.col());
    }
  }
}

void HeldBody::restrict_into(const RowMatrix& forces, Eigen::Ref<Eigen::MatrixXd> f) const {
  const auto free = static_cast<Eigen::Index>(free_.size()), columns = f.cols();
#pragma omp parallel for num_threads(threads_) schedule(static)
  for (Eigen::Index k = 0; k < free; ++k) {
    const auto row = forces.row(free_[static_cast<std::size_t>(k)]);
    for (Eigen::Index c = 0; c < columns; ++c) f(k, c) = row(c);
  }
  f.bottomRows(carry_released_.cols()).setZero();
  for (const std::int64_t row : not_free_)
    for (SparseRows::InnerIterator carried(carry_released_, row); carried; ++carried)
      f.row(free + carried.col()) += carried.value() * forces.row(row).head(columns);
}

Eigen::MatrixXd HeldBody::inertia(const NodeMatrix& mass, const Eigen::MatrixXd& z, int threads) const {
  constexpr Eigen::Index few = 16;
  Eigen::MatrixXd forces(size_, z.cols());
  RowMatrix u, of_points;
  for (Eigen::Index first = 0; first < z.cols(); first += few) {
    const Eigen::Index width = std::min(few, z.cols() - first);
    // Products with several vectors are fastest for a multiple of so many.
    const Eigen::Index columns = width == 1 ? 1 : (width + vectors_abreast - 1) / vectors_abreast * vectors_abreast;
    u.resize(carry_released_.rows(), columns);
    of_points.resize(u.rows(), columns);
    expand_into(z.middleCols(first, width), u);
    mass.multiply_into(u, 3, of_points, threads);
    restrict_into(of_points, forces.middleCols(first, width));
  }
  return forces;
}

Eigen::MatrixXd HeldBody::inertia(const BodyMatrices& matrices, const Eigen::MatrixXd& z, int threads) const {
  if (const NodeMatrix* mass = matrices.mass_here()) return inertia(*mass, z, threads);
  return restrict(matrices.mass_times(expand(z)));
}

void HeldBody::find_rigid_motions(const Solid& solid, const Ties& ties) {
  const std::vector<bool> inside = points_of_solid(solid);
  Eigen::AlignedBox3d box;
  for (Eigen::Index a = 0; a < solid.points(); ++a) {
    if (inside[a]) {
      box.extend(Eigen::Vector3d(points_.col(a)));
    }
  }
  // Unknowns: six amplitudes of the body, rotations by displacements at its size, and the released directions likewise.
  // A motion is free when every tied point moves with the body and as its interface says.
  const double length = box.diagonal().norm() / 2;
  const Eigen::Index released = carry_released_.cols();
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(6 + released);
  scale.segment<3>(3).setConstant(1 / length);
  for (Eigen::Index c = 0; c < released; ++c) {
    scale(6 + c) = ties.released[c].axis < 3 ? 1 : 1 / length;
  }
  const RowMatrix motions = rigid_motions(points_, box.center());
  std::vector<Eigen::Index> tied_rows;
  for (Eigen::Index a = 0; a < solid.points(); ++a) {
    if (ties.tied[a]) {
      tied_rows.insert(tied_rows.end(), {3 * a, 3 * a + 1, 3 * a + 2});
    }
  }
  Eigen::MatrixXd mismatch(tied_rows.size(), 6 + released);
  mismatch << motions(tied_rows, Eigen::all), -RowMatrix(carry_released_)(tied_rows, Eigen::all);
  const Eigen::MatrixXd amplitudes = scale.asDiagonal() * null_space(mismatch * scale.asDiagonal());

  rigid_.resize(size_, amplitudes.cols());
  for (std::size_t k = 0; k < free_.size(); ++k) {
    rigid_.row(static_cast<Eigen::Index>(k)) = motions.row(free_[k]) * amplitudes.topRows<6>();
  }
  rigid_.bottomRows(released) = amplitudes.bottomRows(released);
  if (rigid_.cols() == 0) {
    return;
  }
  // Do the averages hold what the missing freedoms do not?
  Eigen::MatrixXd held = transposed_product(conditions_, rigid_);
  for (Eigen::Index k = 0; k < held.rows(); ++k) {
    held.row(k) *= ties.kept[ties.averages[k]].axis < 3 ? 1 : length;
  }
  if (const Eigen::MatrixXd loose = null_space(held); loose.cols() > 0) {
    const Eigen::VectorXd motion = amplitudes * loose.col(0);
    throw InputError(fmt::format(
        "{}: with every kept direction of the interfaces held, the body can still {}; keep more directions or add an "
        "interface that holds it",
        ties.surfaces.front().located, describe_motion(motion.head<3>(), motion.segment<3>(3), box.center(), length)));
  }
}

void HeldBody::choose_supports() {
  const Eigen::Index r = rigid_.cols();
  if (r > 0) {
    // Pivoted columns of N^T: freedoms of points far apart, in which the motions differ most.
    const Eigen::Index count = static_cast<Eigen::Index>(free_.size());
    supports_ = pivoted_columns(rigid_.topRows(count).transpose());
    supports_.resize(static_cast<std::size_t>(r));
    std::sort(supports_.begin(), supports_.end());
  }
  std::vector<Eigen::Index> all(size_);
  std::iota(all.begin(), all.end(), 0);
  std::set_difference(all.begin(), all.end(), supports_.begin(), supports_.end(), std::back_inserter(not_supports_));
}

void HeldBody::factorise(const Factorisation& factorisation) {
  const auto count = static_cast<Eigen::Index>(free_.size());
  std::vector<std::int64_t> kept;
  for (const Eigen::Index k : not_supports_) {
    if (k >= count) break;
    kept.push_back(free_[k]);
  }
  try {
    factor_ = factorisation(kept, carry_released_);
  } catch (const NotPositiveDefinite& error) {
    if (error.unknown() < static_cast<std::int64_t>(kept.size())) {
      throw ComputationError(
          fmt::format("the stiffness of the body is singular at the point {} m: a part of the mesh hangs on there by a "
                      "point or an edge only, or its cells are degenerate",
                      words(points_.col(kept[error.unknown()] / 3))));
    }
    throw ComputationError("the stiffness of the body is singular in a released direction of an interface");
  }
}

Eigen::MatrixXd HeldBody::pseudo_solve(const Eigen::MatrixXd& f) const {
  if (!factor_) return Eigen::MatrixXd::Zero(size_, f.cols());
  if (supports_.empty()) return factor_->solve(f);
  Eigen::MatrixXd inside(static_cast<Eigen::Index>(not_supports_.size()), f.cols()), z(size_, f.cols());
  leave_supports_out(f, inside);
  put_supports_in(factor_->solve(inside), z);
  return z;
}

void HeldBody::leave_supports_out(const Eigen::MatrixXd& f, Eigen::MatrixXd& inside) const {
#pragma omp parallel for num_threads(threads_)
  for (Eigen::Index c = 0; c < f.cols(); ++c) {
    Eigen::Index begin = 0, done = 0;
    for (const Eigen::Index support : supports_) {
      inside.col(c).segment(done, support - begin) = f.col(c).segment(begin, support - begin);
      done += support - begin;
      begin = support + 1;
    }
    inside.col(c).tail(size_ - begin) = f.col(c).tail(size_ - begin);
  }
}

void HeldBody::put_supports_in(const Eigen::MatrixXd& inside, Eigen::MatrixXd& z) const {
#pragma omp parallel for num_threads(threads_)
  for (Eigen::Index c = 0; c < z.cols(); ++c) {
    Eigen::Index begin = 0, done = 0;
    for (const Eigen::Index support : supports_) {
      z.col(c).segment(begin, support - begin) = inside.col(c).segment(done, support - begin);
      done += support - begin;
      begin = support + 1;
      z(support, c) = 0;
    }
    z.col(c).tail(size_ - begin) = inside.col(c).tail(size_ - begin);
  }
}

void HeldBody::close_conditions(const Ties& ties) {
  const Eigen::Index a = conditions_.cols(), r = rigid_.cols();
  if (a == 0) {
    return;
  }
  const Eigen::MatrixXd flexibility = pseudo_solve(conditions_);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(a + r, a + r);
  matrix.topLeftCorner(a, a) = transposed_product(conditions_, flexibility);
  matrix.topRightCorner(a, r) = -transposed_product(conditions_, rigid_);
  matrix.bottomLeftCorner(r, a) = transposed_product(rigid_, conditions_);
  corrections_.resize(size_, a + r);
  corrections_ << flexibility, -rigid_;
  // Scaled to comparable entries before it is inverted: multipliers are forces and moments.
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(a + r);
  for (Eigen::Index k = 0; k < a; ++k) {
    scale(k) = 1 / std::sqrt(std::max(matrix(k, k), std::numeric_limits<double>::min()));
  }
  for (Eigen::Index k = 0; k < r; ++k) {
    scale(a + k) = 1 / (scale.head(a).asDiagonal() * matrix.col(a + k).head(a)).norm();
  }
  const std::optional<Eigen::MatrixXd> inverse = regular_inverse(scale.asDiagonal() * matrix * scale.asDiagonal());
  if (!inverse) {
    throw ComputationError(fmt::format("{}: the average ties of the body depend on each other",
                                       ties.surfaces[ties.kept[ties.averages.front()].interface].located));
  }
  small_ = scale.asDiagonal() * *inverse * scale.asDiagonal();
}

Eigen::MatrixXd HeldBody::solve(const Eigen::MatrixXd& f, const Eigen::MatrixXd& averages) const {
  Eigen::MatrixXd z = pseudo_solve(f);
  const Eigen::Index a = conditions_.cols(), r = rigid_.cols();
  if (a == 0) {
    return z;
  }
  Eigen::MatrixXd right(a + r, f.cols());
  right.topRows(a) = tall_inner_products(conditions_, z, threads_);
  if (averages.size() > 0) {
    right.topRows(a) -= averages;
  }
  right.bottomRows(r) = tall_inner_products(rigid_, f, threads_);
  add_tall_product(z, corrections_, product(small_, right), -1, threads_);
  return z;
}

}  // namespace bielle::reduce

#include "reduce/reduction/held_freedoms.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/dense/dense_products.hpp"
#include "reduce/dense/orthogonal_factors.hpp"
#include "reduce/reduction/rigid_motions.hpp"

namespace bielle::reduce {

namespace {

/// Singular values below this, relative to the largest, belong to motions without resistance. The decision depends on
/// geometry, not on stiffness: a support whose width is 1e-8 of the body's size has no effect.
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

/// Returns a basis of the vectors x with A x = 0; the columns of A are of comparable size.
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

HeldFreedoms::HeldFreedoms(const Solid& solid, const Ties& ties) : carry_released(ties.carry_released) {
  const std::vector<bool> inside = points_of_solid(solid);
  for (std::int64_t a = 0; a < solid.points(); ++a) {
    if (inside[a] && !ties.tied[a]) {
      free.insert(free.end(), {3 * a, 3 * a + 1, 3 * a + 2});
    } else {
      not_free.insert(not_free.end(), {3 * a, 3 * a + 1, 3 * a + 2});
    }
  }
  size = static_cast<Eigen::Index>(free.size()) + carry_released.cols();
  conditions.resize(size, ties.spread.cols());
  restrict_into(RowMatrix(ties.spread), conditions, 1);
  find_rigid_motions(solid, ties, inside);
  choose_supports();
}

InteriorUnknowns HeldFreedoms::interior() const {
  InteriorUnknowns result{{}, carry_released};
  for (const Eigen::Index k : not_supports) {
    if (k >= static_cast<Eigen::Index>(free.size())) break;
    result.kept.push_back(free[static_cast<std::size_t>(k)]);
  }
  return result;
}

void HeldFreedoms::expand_into(const Eigen::Ref<const Eigen::MatrixXd>& z, RowMatrix& u, int threads) const {
  const auto count = static_cast<Eigen::Index>(free.size()), columns = z.cols();
#pragma omp parallel num_threads(threads)
  {
#pragma omp for schedule(static) nowait
    for (Eigen::Index k = 0; k < count; ++k) {
      auto row = u.row(free[static_cast<std::size_t>(k)]);
      for (Eigen::Index c = 0; c < columns; ++c) row(c) = z(k, c);
    }
#pragma omp for schedule(static)
    for (std::size_t k = 0; k < not_free.size(); ++k) {
      auto row = u.row(not_free[k]);
      row.setZero();
      for (SparseRows::InnerIterator carried(carry_released, not_free[k]); carried; ++carried)
        row += carried.value() * z.row(count + carried.col());
    }
  }
}

void HeldFreedoms::restrict_into(const RowMatrix& forces, Eigen::Ref<Eigen::MatrixXd> f, int threads) const {
  const auto count = static_cast<Eigen::Index>(free.size()), columns = f.cols();
#pragma omp parallel for num_threads(threads) schedule(static)
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto row = forces.row(free[static_cast<std::size_t>(k)]);
    for (Eigen::Index c = 0; c < columns; ++c) f(k, c) = row(c);
  }
  f.bottomRows(carry_released.cols()).setZero();
  for (const std::int64_t row : not_free)
    for (SparseRows::InnerIterator carried(carry_released, row); carried; ++carried)
      f.row(count + carried.col()) += carried.value() * forces.row(row).head(columns);
}

/// Calls work(position in z, position without the supports, count) for the ranges of z between supports.
template <class Work>
void HeldFreedoms::for_stretches(const Work& work) const {
  Eigen::Index begin = 0, done = 0;
  for (const Eigen::Index support : supports) {
    work(begin, done, support - begin);
    done += support - begin;
    begin = support + 1;
  }
  work(begin, done, size - begin);
}

void HeldFreedoms::leave_supports_out(const Eigen::MatrixXd& f, Eigen::MatrixXd& inside, int threads) const {
#pragma omp parallel for num_threads(threads)
  for (Eigen::Index c = 0; c < f.cols(); ++c)
    for_stretches([&](Eigen::Index whole, Eigen::Index own, Eigen::Index count) {
      inside.col(c).segment(own, count) = f.col(c).segment(whole, count);
    });
}

void HeldFreedoms::put_supports_in(const Eigen::MatrixXd& inside, Eigen::MatrixXd& z, int threads) const {
#pragma omp parallel for num_threads(threads)
  for (Eigen::Index c = 0; c < z.cols(); ++c) {
    for_stretches([&](Eigen::Index whole, Eigen::Index own, Eigen::Index count) {
      z.col(c).segment(whole, count) = inside.col(c).segment(own, count);
    });
    for (const Eigen::Index support : supports) z(support, c) = 0;
  }
}

void HeldFreedoms::find_rigid_motions(const Solid& solid, const Ties& ties, const std::vector<bool>& inside) {
  Eigen::AlignedBox3d box;
  for (Eigen::Index a = 0; a < solid.points(); ++a) {
    if (inside[a]) {
      box.extend(Eigen::Vector3d(solid.mesh.points.col(a)));
    }
  }
  // Unknowns: six amplitudes of the body, with rotations scaled to displacements at its size, and the released
  // directions, scaled likewise. A motion is free if every tied point moves with the body and with its interface.
  const double length = box.diagonal().norm() / 2;
  const Eigen::Index released = carry_released.cols();
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(6 + released);
  scale.segment<3>(3).setConstant(1 / length);
  for (Eigen::Index c = 0; c < released; ++c) {
    scale(6 + c) = ties.released[c].axis < 3 ? 1 : 1 / length;
  }
  const RowMatrix motions = rigid_motions(solid.mesh.points, box.center());
  std::vector<Eigen::Index> tied_rows;
  for (Eigen::Index a = 0; a < solid.points(); ++a) {
    if (ties.tied[a]) {
      tied_rows.insert(tied_rows.end(), {3 * a, 3 * a + 1, 3 * a + 2});
    }
  }
  Eigen::MatrixXd mismatch(tied_rows.size(), 6 + released);
  mismatch << motions(tied_rows, Eigen::all), -RowMatrix(carry_released)(tied_rows, Eigen::all);
  const Eigen::MatrixXd amplitudes = scale.asDiagonal() * null_space(mismatch * scale.asDiagonal());

  rigid.resize(size, amplitudes.cols());
  for (std::size_t k = 0; k < free.size(); ++k) {
    rigid.row(static_cast<Eigen::Index>(k)) = motions.row(free[k]) * amplitudes.topRows<6>();
  }
  rigid.bottomRows(released) = amplitudes.bottomRows(released);
  if (rigid.cols() == 0) {
    return;
  }
  // Check that the averages hold the motions that the removed degrees of freedom do not hold.
  Eigen::MatrixXd held = transposed_product(conditions, rigid);
  for (Eigen::Index k = 0; k < held.rows(); ++k) {
    held.row(k) *= ties.kept[ties.averages[k]].axis < 3 ? 1 : length;
  }
  if (const Eigen::MatrixXd loose = null_space(held); loose.cols() > 0) {
    const Eigen::VectorXd motion = amplitudes * loose.col(0);
    throw InputError(
        ties.surfaces.front().subject,
        fmt::format(
            "with every kept direction of the interfaces held, the body can still {}; keep more directions or add an "
            "interface that holds it",
            describe_motion(motion.head<3>(), motion.segment<3>(3), box.center(), length)));
  }
}

void HeldFreedoms::choose_supports() {
  const Eigen::Index r = rigid.cols();
  if (r > 0) {
    // The pivot columns of N^T are degrees of freedom of points far apart, in which the motions differ most.
    const Eigen::Index count = static_cast<Eigen::Index>(free.size());
    supports = pivoted_columns(rigid.topRows(count).transpose());
    supports.resize(static_cast<std::size_t>(r));
    std::sort(supports.begin(), supports.end());
  }
  std::vector<Eigen::Index> all(size);
  std::iota(all.begin(), all.end(), 0);
  std::set_difference(all.begin(), all.end(), supports.begin(), supports.end(), std::back_inserter(not_supports));
}

}  // namespace bielle::reduce

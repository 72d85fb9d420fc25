#include "reduce/distributed/distributed_matrices.hpp"

#include <algorithm>
#include <cmath>
#include <new>

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/distributed/distributed_modes.hpp"
#include "reduce/distributed/partition.hpp"
#include "reduce/distributed/regularity.hpp"

namespace bielle::reduce {

namespace {

constexpr Eigen::Index columns_at_a_time = 16;  // columns of a field that are sent at a time, which limits the memory
                                                // of messages

void order(Channel& channel, Command command, std::int64_t a = 0, std::int64_t b = 0) {
  channel.send_number(command);
  channel.send_number(a);
  channel.send_number(b);
}

void expect_good(Channel& channel) {
  const Outcome outcome = channel.receive_outcome();
  if (outcome.kind == Outcome::out_of_memory) throw std::bad_alloc();
  if (outcome.kind != Outcome::good) throw ComputationError(outcome.message);
}

template <class Share>
void send_packed(Channel& channel, Share& share) {
  Packing packing;
  packing(share);
  channel.send_text(packing.bytes());
}

/// Returns the rows of some columns of a field that belong to the given points, `per_point` for each.
RowMatrix rows_of(const std::vector<int>& points, Eigen::Index per_point, const RowMatrix& u, Eigen::Index first,
                  Eigen::Index width) {
  RowMatrix rows(per_point * static_cast<Eigen::Index>(points.size()), width);
  for (std::size_t a = 0; a < points.size(); ++a)
    rows.middleRows(per_point * static_cast<Eigen::Index>(a), per_point) =
        u.block(per_point * points[a], first, per_point, width);
  return rows;
}

void send_block(Channel& channel, const RowMatrix& block) {
  channel.send_number(static_cast<std::int64_t>(block.size()));
  channel.send(block.data(), sizeof(double) * static_cast<std::size_t>(block.size()));
}

class DistributedFactor : public Factor {
 public:
  DistributedFactor(Channel& channel, const FactorStatistics& statistics)
      : channel_(channel), statistics_(statistics) {}
  const FactorStatistics& statistics() const override { return statistics_; }

  Eigen::MatrixXd solve(const Eigen::MatrixXd& f) const override {
    Eigen::MatrixXd z(f.rows(), f.cols());
    for (Eigen::Index first = 0; first < f.cols(); first += columns_at_a_time) {
      const Eigen::Index width = std::min(columns_at_a_time, f.cols() - first);
      const std::size_t bytes = sizeof(double) * static_cast<std::size_t>(f.rows() * width);
      order(channel_, Command::solve, width);
      channel_.send(f.data() + first * f.rows(), bytes);
      expect_good(channel_);
      channel_.receive(z.data() + first * f.rows(), bytes);
    }
    return z;
  }

 private:
  Channel& channel_;
  FactorStatistics statistics_;
};

class DistributedMatrices : public BodyMatrices {
 public:
  DistributedMatrices(Channel& channel, int ranks, const Solid& solid, int threads) : channel_(channel), solid_(solid) {
    order(channel_, Command::keep, threads);
    const CoatedCells coated = coated_cells(solid);
    for (const std::vector<int>& cells : divided_cells(solid, ranks)) {
      SolidPart part = part_of(solid, cells, coated);
      send_packed(channel_, part.share);
      points_.push_back(std::move(part.points));
    }
    expect_good(channel_);
  }
  ~DistributedMatrices() override {
    try {
      order(channel_, Command::forget);
      channel_.receive_outcome();
    } catch (const ComputationError&) {  // the ranks have ended, and their matrices with them
    }
  }
  DistributedMatrices(const DistributedMatrices&) = delete;
  DistributedMatrices& operator=(const DistributedMatrices&) = delete;

  RowMatrix stiffness_times(const RowMatrix& u) const override { return product_of_parts(Command::stiffness, u, 3); }
  RowMatrix mesh_mass_times(const RowMatrix& u, int rows_per_node) const override {
    return product_of_parts(Command::mass, u, rows_per_node);
  }

  Eigen::VectorXd stiffness_diagonal() const override {
    RowMatrix sum = RowMatrix::Zero(3 * solid_.points(), 1);
    order(channel_, Command::diagonal);
    expect_good(channel_);
    for (const std::vector<int>& points : points_) add_received(points, 3, 0, 1, sum);
    return sum.col(0);
  }

  std::vector<Eigen::MatrixXd> geometric_stiffness(const RowMatrix& fields, const RowMatrix& shapes) const override {
    const Eigen::Index n = shapes.cols();
    order(channel_, Command::geometric, fields.cols(), n);
    for (const std::vector<int>& points : points_) {
      send_block(channel_, rows_of(points, 3, fields, 0, fields.cols()));
      send_block(channel_, rows_of(points, 3, shapes, 0, n));
    }
    expect_good(channel_);
    std::vector<Eigen::MatrixXd> result(static_cast<std::size_t>(fields.cols()), Eigen::MatrixXd(n, n));
    for (Eigen::MatrixXd& matrix : result)
      channel_.receive(matrix.data(), sizeof(double) * static_cast<std::size_t>(n * n));
    return result;
  }

  std::unique_ptr<Factor> factorise(const InteriorUnknowns& interior) const override;

  Eigenpairs eigenpairs(const ShiftInvertProblem& problem, int count, const EigenpairOptions& options) const override {
    if (options.method != EigenMethod::automatic)
      throw InputError("method: on ranks SLEPc finds the modes; leave the method out");
    EigenpairOptions on_ranks = options;
    on_ranks.iteration = [this](const ShiftInvertProblem& asked, int wanted, const EigenpairOptions& given) {
      return distributed_modes(channel_, asked, wanted, given);
    };
    return shift_invert_eigenpairs(problem, count, on_ranks);
  }

 private:
  RowMatrix product_of_parts(Command command, const RowMatrix& u, int rows_per_node) const {
    RowMatrix sum = RowMatrix::Zero(u.rows(), u.cols());
    for (Eigen::Index first = 0; first < u.cols(); first += columns_at_a_time) {
      const Eigen::Index width = std::min(columns_at_a_time, u.cols() - first);
      order(channel_, command, width, rows_per_node);
      for (const std::vector<int>& points : points_)
        send_block(channel_, rows_of(points, rows_per_node, u, first, width));
      expect_good(channel_);
      for (const std::vector<int>& points : points_) add_received(points, rows_per_node, first, width, sum);
    }
    return sum;
  }

  void add_received(const std::vector<int>& points, Eigen::Index per_point, Eigen::Index first, Eigen::Index width,
                    RowMatrix& sum) const {
    RowMatrix rows(channel_.receive_number<std::int64_t>() / width, width);
    channel_.receive(rows.data(), sizeof(double) * static_cast<std::size_t>(rows.size()));
    for (std::size_t a = 0; a < points.size(); ++a)
      sum.block(per_point * points[a], first, per_point, width) +=
          rows.middleRows(per_point * static_cast<Eigen::Index>(a), per_point);
  }

  InteriorShare interior_of(const std::vector<int>& points, const std::vector<int>& numbers, std::size_t kept,
                            const SparseRows& carried) const;
  void check_regular(const Factor& factor, const std::vector<std::int64_t>& kept, const SparseRows& carried,
                     bool suspected) const;

  Channel& channel_;
  const Solid& solid_;
  std::vector<std::vector<int>> points_;  // points of each part
};

InteriorShare DistributedMatrices::interior_of(const std::vector<int>& points, const std::vector<int>& numbers,
                                               std::size_t kept, const SparseRows& carried) const {
  InteriorShare share;
  share.starts.push_back(0);
  for (const int point : points) {
    for (int i = 0; i < 3; ++i) {
      share.numbers.push_back(numbers[3 * point + i]);
      for (SparseRows::InnerIterator entry(carried, 3 * point + i); entry; ++entry) {
        share.unknowns.push_back(static_cast<int>(kept) + static_cast<int>(entry.col()));
        share.weights.push_back(entry.value());
      }
      share.starts.push_back(static_cast<int>(share.unknowns.size()));
    }
  }
  return share;
}

std::unique_ptr<Factor> DistributedMatrices::factorise(const InteriorUnknowns& interior) const {
  const std::vector<std::int64_t>& kept = interior.kept;
  const SparseRows& carried = interior.carried;
  const std::size_t size = kept.size() + static_cast<std::size_t>(carried.cols());
  if (size == 0) return nullptr;
  if (size > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw ComputationError(fmt::format("{} unknowns are more than a distributed factorisation can count", size));
  std::vector<int> numbers(static_cast<std::size_t>(3 * solid_.points()), -1);
  BlockStarts blocks;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    numbers[static_cast<std::size_t>(kept[k])] = static_cast<int>(k);
    if (k == 0 || kept[k] / 3 != kept[k - 1] / 3) blocks.starts.push_back(static_cast<int>(k));
  }
  for (std::size_t k = kept.size(); k <= size; ++k) blocks.starts.push_back(static_cast<int>(k));
  order(channel_, Command::factorise, static_cast<std::int64_t>(size));
  for (const std::vector<int>& points : points_) {
    InteriorShare share = interior_of(points, numbers, kept.size(), carried);
    send_packed(channel_, share);
  }
  send_packed(channel_, blocks);
  expect_good(channel_);
  const auto told = channel_.receive_number<SharedFactorStatistics>();
  FactorStatistics statistics;
  statistics.unknowns = static_cast<std::int64_t>(size);
  statistics.nonzeros = static_cast<std::int64_t>(told.nonzeros);
  statistics.flops = told.flops;
  statistics.estimated_MB = told.estimated_MB;
  statistics.ordering_seconds = told.analysis_seconds;
  statistics.factorisation_seconds = told.factorisation_seconds;
  auto factor = std::make_unique<DistributedFactor>(channel_, statistics);
  check_regular(*factor, kept, carried, told.negative_pivots > 0);
  return factor;
}

/// Throws if the matrix is not positive definite: MUMPS does not stop at a tiny or negative pivot.
void DistributedMatrices::check_regular(const Factor& factor, const std::vector<std::int64_t>& kept,
                                        const SparseRows& carried, bool suspected) const {
  const Eigen::VectorXd of_points = stiffness_diagonal();
  const auto count = static_cast<Eigen::Index>(kept.size());
  Eigen::VectorXd scale(count + carried.cols());
  for (Eigen::Index k = 0; k < count; ++k) scale(k) = std::sqrt(of_points(kept[static_cast<std::size_t>(k)]));
  for (Eigen::Index c = 0; c < carried.cols(); ++c) scale(count + c) = 1;
  const std::optional<Eigen::Index> unresisted = unresisted_unknown(factor, scale, suspected);
  if (!unresisted) return;
  const Eigen::Index unknown = *unresisted;
  if (unknown >= count)
    throw ComputationError("the stiffness of the body is singular in a released direction of an interface");
  const Eigen::Vector3d x = solid_.mesh.points.col(kept[static_cast<std::size_t>(unknown)] / 3);
  throw ComputationError(fmt::format(
      "the stiffness of the body is singular: the part of the mesh around the point ({:.4g}, {:.4g}, {:.4g}) m moves "
      "without resistance; it is attached at a point or an edge only, or its cells are degenerate",
      x.x(), x.y(), x.z()));
}

}  // namespace

std::unique_ptr<BodyMatrices> distributed_matrices(Channel& channel, int ranks, const Solid& solid, int threads) {
  return std::make_unique<DistributedMatrices>(channel, ranks, solid, threads);
}

}  // namespace bielle::reduce

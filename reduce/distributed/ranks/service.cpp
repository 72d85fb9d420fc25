#include "reduce/distributed/ranks/service.hpp"

#include <cstdlib>
#include <utility>

#include "reduce/dense/blas.hpp"
#include "reduce/distributed/ranks/driver.hpp"

namespace bielle::reduce {

namespace {

RowMatrix as_rows(const std::vector<double>& numbers, Eigen::Index columns) {
  return Eigen::Map<const RowMatrix>(numbers.data(), static_cast<Eigen::Index>(numbers.size()) / columns, columns);
}

std::vector<double> as_numbers(const RowMatrix& rows) { return {rows.data(), rows.data() + rows.size()}; }

template <class Share>
Share unpacked(std::string bytes) {
  Packing packing(std::move(bytes));
  Share share{};
  packing(share);
  return share;
}

}  // namespace

Order Service::serve() {
  while (true) {
    const Order order = team_.next();
    if (order.command == Command::answer || order.command == Command::leave) return order;
    try {
      carry_out(order);
    } catch (const RankFailure& failure) {
      tell(failure.outcome);
    }
  }
}

void Service::carry_out(const Order& order) {
  switch (order.command) {
    case Command::keep:
      return keep(static_cast<int>(order.a));
    case Command::stiffness:
    case Command::mass:
      return multiply(order);
    case Command::diagonal:
      return diagonal();
    case Command::geometric:
      return geometric(order.a, order.b);
    case Command::factorise:
      return factorise(static_cast<int>(order.a));
    case Command::solve:
      return solve(static_cast<int>(order.a));
    case Command::modes:
      return find(static_cast<int>(order.a), static_cast<int>(order.b));
    case Command::forget:
      factor_.reset();
      part_.reset();
      return tell({});
    case Command::answer:
    case Command::leave:
      return;
  }
}

void Service::tell(const Outcome& outcome) {
  if (team_.leads()) team_.channel().send_outcome(outcome);
}

void Service::keep(int threads) {
  static const BlasThreads of_all(threads);
  auto share = unpacked<MeshShare>(team_.share_text());
  team_.all_or_none([&] { part_ = std::make_unique<Part>(std::move(share), threads); });
  tell({});
}

void Service::multiply(const Order& order) {
  const RowMatrix u = as_rows(team_.share_numbers(), order.a);
  std::vector<double> result;
  team_.all_or_none([&] {
    result = as_numbers(order.command == Command::stiffness ? part_->stiffness_times(u)
                                                            : part_->mass_times(u, static_cast<int>(order.b)));
  });
  tell({});
  team_.collect_numbers(result);
}

void Service::diagonal() {
  const Eigen::VectorXd values = part_->stiffness_diagonal();
  tell({});
  team_.collect_numbers({values.begin(), values.end()});
}

void Service::geometric(Eigen::Index fields, Eigen::Index shapes) {
  // Rank 0 forwards both blocks of a rank one after the other.
  auto [of_fields, of_shapes] = team_.share_two_blocks();
  const RowMatrix u = as_rows(of_fields, fields), t = as_rows(of_shapes, shapes);
  std::vector<Eigen::MatrixXd> sums;
  team_.all_or_none([&] { sums = part_->geometric_stiffness(u, t); });
  tell({});
  for (Eigen::MatrixXd& sum : sums) {
    team_.add_up(sum.data(), static_cast<std::size_t>(sum.size()));
    if (team_.leads()) team_.channel().send(sum.data(), sizeof(double) * static_cast<std::size_t>(sum.size()));
  }
}

void Service::factorise(int size) {
  factor_.reset();
  std::string bytes = team_.share_text();
  BlockStarts blocks;
  if (team_.leads()) blocks = unpacked<BlockStarts>(team_.channel().receive_text());
  Entries entries;
  team_.all_or_none([&] { entries = part_->interior(unpacked<InteriorShare>(std::move(bytes))); });
  factor_ = std::make_unique<MumpsFactor>(team_, size, std::move(entries), blocks.starts);
  tell({});
  if (team_.leads()) team_.channel().send_number(factor_->statistics());
}

void Service::solve(int columns) {
  std::vector<double> b;
  if (team_.leads()) {
    b.resize(static_cast<std::size_t>(factor_->size()) * static_cast<std::size_t>(columns));
    team_.channel().receive(b.data(), sizeof(double) * b.size());
  }
  factor_->solve(b.data(), columns);
  tell({});
  if (team_.leads()) team_.channel().send(b.data(), sizeof(double) * b.size());
}

void Service::find(int size, int count) {
  ModesRequest request{size, count};
  double numbers[2] = {0, 0};
  if (team_.leads()) {
    numbers[0] = team_.channel().receive_number<double>();
    numbers[1] = static_cast<double>(team_.channel().receive_number<std::int64_t>());
  }
  MPI_Bcast(numbers, 2, MPI_DOUBLE, 0, team_.comm());
  request.tolerance = numbers[0];
  request.restarts = static_cast<int>(numbers[1]);
  find_modes(team_, request, [&] {
    if (serve().command == Command::leave) leave(team_.leads() ? driver_status() : 0);
  });
}

void leave(int status) {
  MPI_Finalize();
  std::exit(status);
}

}  // namespace bielle::reduce

#include "reduce/matrices/set_recovery.hpp"

#include <fmt/format.h>

#include "reduce/common/counted.hpp"
#include "reduce/common/error.hpp"
#include "reduce/dense/dense_products.hpp"

namespace bielle::reduce {

namespace {

void name_rows_of(const QuantityRows& request, RecoveredQuantity& quantity) {
  const auto count = static_cast<std::int64_t>(quantity.rows.size());
  if (!request.all.empty()) {
    if (static_cast<std::int64_t>(request.all.size()) != count)
      throw InputError(fmt::format("expected a name for each of the {}, found {}; a map `name: row` chooses some",
                                   counted(count, "row"), request.all.size()));
    quantity.rows = request.all;
    return;
  }
  RecoveredQuantity chosen;
  chosen.matrix.resize(static_cast<Eigen::Index>(request.chosen.size()), quantity.matrix.cols());
  Eigen::Index next = 0;
  for (const auto& [name, row] : request.chosen) {
    if (row < 1 || row > count)
      throw InputError(fmt::format("'{}' is row {}, but the matrix has the rows 1 to {}", name, row, count));
    chosen.rows.push_back(name);
    chosen.units.push_back(quantity.units[static_cast<std::size_t>(row - 1)]);
    chosen.matrix.row(next++) = quantity.matrix.row(row - 1);
  }
  quantity = std::move(chosen);
}

}  // namespace

void name_rows(const std::map<std::string, QuantityRows>& requests, RecoveredQuantities& quantities) {
  for (const auto& [name, request] : requests)
    about(request.subject, [&, &of = name, &rows = request] {
      const auto found = quantities.find(of);
      if (found == quantities.end()) throw InputError(fmt::format("the file has no quantity '{}'", of));
      name_rows_of(rows, found->second);
    });
}

void add_set_recovery(const MatrixSet& set, const Eigen::MatrixXd& shapes, Superelement& body) {
  if (set.shapes && set.shapes->stress.size() > 0) {
    body.stress_recovery = product(set.shapes->stress, shapes);
    body.stress_nodes = set.shapes->stress_points;
  }
  for (const auto& [name, quantity] : set.quantities)
    body.quantities[name] = {quantity.rows, quantity.units, product(quantity.matrix, shapes)};
}

}  // namespace bielle::reduce

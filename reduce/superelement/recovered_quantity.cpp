#include "reduce/superelement/recovered_quantity.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reduce/common/files/hdf5_file.hpp"

namespace bielle {

std::string RecoveredQuantity::all_units() const {
  const bool one = std::adjacent_find(units.begin(), units.end(), std::not_equal_to<>()) == units.end();
  return one && !units.empty() ? units.front() : fmt::format("{}", fmt::join(units, ", "));
}

void write_quantities(const RecoveredQuantities& quantities, Hdf5File& file) {
  for (const auto& [name, quantity] : quantities) {
    const std::string group = "/quantities/" + link_name(name);
    file.write_names(group + "/rows", quantity.rows);
    file.write_names(group + "/units", quantity.units);
    file.write(group + "/matrix", quantity.matrix, "units of each row/u_j", "the quantity in terms of the coordinates");
  }
}

RecoveredQuantities read_quantities(const Hdf5File& file) {
  RecoveredQuantities quantities;
  if (!file.has("/quantities")) return quantities;
  for (const std::string& link : file.names_in("/quantities")) {
    const std::string group = "/quantities/" + link;
    quantities[name_of_link(link)] = {file.read_names(group + "/rows"), file.read_names(group + "/units"),
                                      file.read_matrix(group + "/matrix")};
  }
  return quantities;
}

std::string fault_of(const RecoveredQuantities& quantities, Eigen::Index n) {
  for (const auto& [name, quantity] : quantities) {
    const auto count = static_cast<Eigen::Index>(quantity.rows.size());
    const std::string group = "/quantities/" + name;
    if (count == 0 || static_cast<Eigen::Index>(quantity.units.size()) != count)
      return fmt::format("{}: expected a name and a unit for each row, found {} and {}", group, count,
                         quantity.units.size());
    if (quantity.matrix.rows() != count || quantity.matrix.cols() != n)
      return fmt::format("{}/matrix: expected {} x {} numbers, found {} x {}", group, count, n, quantity.matrix.rows(),
                         quantity.matrix.cols());
    if (!quantity.matrix.allFinite()) return group + "/matrix: holds numbers that are not finite";
    if (std::set<std::string>(quantity.rows.begin(), quantity.rows.end()).size() < quantity.rows.size())
      return group + "/rows: two rows have one name";
  }
  return "";
}

}  // namespace bielle

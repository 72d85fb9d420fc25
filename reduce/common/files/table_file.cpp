#include "reduce/common/files/table_file.hpp"

#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "reduce/common/counted.hpp"
#include "reduce/common/error.hpp"
#include "reduce/common/files/file_checks.hpp"

namespace bielle {

namespace {

/// Splits a line into cells. Commas, semicolons and tabs separate cells, which may be empty; in a line without these,
/// blanks separate them.
std::vector<std::string> cells_of(const std::string& line) {
  const bool delimited = line.find_first_of(",;\t") != std::string::npos;
  const std::string delimiters = delimited ? ",;\t" : " ";
  std::vector<std::string> cells;
  std::size_t begin = 0;
  while (begin <= line.size()) {
    const std::size_t end = std::min(line.find_first_of(delimiters, begin), line.size());
    std::string cell = line.substr(begin, end - begin);
    const std::size_t first = cell.find_first_not_of(" \"");
    cell = first == std::string::npos ? "" : cell.substr(first, cell.find_last_not_of(" \"") - first + 1);
    if (delimited || !cell.empty()) cells.push_back(cell);
    begin = end + 1;
  }
  return cells;
}

std::optional<double> number_in(std::string_view cell) {
  if (cell.starts_with('+')) cell.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size()) return std::nullopt;
  return value;
}

}  // namespace

Eigen::MatrixXd read_table(const std::string& path, Eigen::Index columns) {
  check_input_file(path);
  std::ifstream file(path);
  if (!file) throw InputError(fmt::format("{}: there is no such file, or it cannot be read", path));
  std::vector<double> values;
  std::string line;
  bool heading_allowed = true;
  for (int number = 1; std::getline(file, line); ++number) {
    if (number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);  // byte order mark of spreadsheets
    line.erase(std::min(line.find_first_of("#\r"), line.size()));
    const std::vector<std::string> cells = cells_of(line);
    bool empty = true, any_number = false;
    for (const std::string& cell : cells) {
      empty = empty && cell.empty();
      any_number = any_number || number_in(cell);
    }
    if (empty) continue;
    if (heading_allowed && !any_number) {
      heading_allowed = false;
      continue;
    }
    heading_allowed = false;
    if (static_cast<Eigen::Index>(cells.size()) != columns)
      throw InputError(
          fmt::format("{}:{}: expected {}, found {}", path, number, counted(columns, "number"), cells.size()));
    for (const std::string& cell : cells) {
      const std::optional<double> value = number_in(cell);
      if (!value || !std::isfinite(*value))
        throw InputError(fmt::format("{}:{}: expected a number, found '{}'", path, number, cell));
      values.push_back(*value);
    }
  }
  if (file.bad()) throw InputError(fmt::format("{}: reading failed", path));
  if (values.empty()) throw InputError(fmt::format("{}: holds no rows of numbers", path));
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(values.data(), static_cast<Eigen::Index>(values.size()) / columns, columns);
}

}  // namespace bielle

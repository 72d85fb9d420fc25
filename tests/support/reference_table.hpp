// Numbers that the scripts of tests/references compute apart from Bielle, by the names that their tables give them.
#pragma once

#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>

#include <Eigen/Core>

namespace bielle::test {

class ReferenceTable {
 public:
  /// @param subject  names tests/references/<subject>.csv
  explicit ReferenceTable(const std::string& subject)
      : path_(std::string(BIELLE_SOURCE_DIR) + "/tests/references/" + subject + ".csv") {
    std::ifstream file(path_);
    std::string line, name, value;
    std::getline(file, line);
    if (line != "name,value,within,meaning") throw std::runtime_error(path_ + " is no table of references");
    while (std::getline(file, line)) {
      std::istringstream row(line);
      std::getline(row, name, ',');
      std::getline(row, value, ',');
      values_[name] = std::stod(value);
    }
  }
  double operator()(const std::string& name) const {
    const auto found = values_.find(name);
    if (found == values_.end()) throw std::runtime_error(path_ + " has no '" + name + "'");
    return found->second;
  }
  /// Returns the rows `name.x`, `name.y` and `name.z`.
  Eigen::Vector3d vector(const std::string& name) const {
    return {(*this)(name + ".x"), (*this)(name + ".y"), (*this)(name + ".z")};
  }
  /// Returns the rows `name.x` and `name.y`.
  Eigen::Vector2d plane(const std::string& name) const { return {(*this)(name + ".x"), (*this)(name + ".y")}; }

 private:
  std::string path_;
  std::map<std::string, double> values_;
};

}  // namespace bielle::test

#include "reduce/mesh/universal_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>

#include "reduce/common/error.hpp"

namespace bielle::reduce {

namespace {

/// Physical properties are raised by this amount if there are groups: gmsh numbers the parts that groups divide the
/// mesh into from 1 on, and takes the part with the number of a property for the members of the property.
constexpr long property_beyond = 1000000;
constexpr int units = 164, nodes = 2411, elements = 2412, systems = 2420, groups = 2467, groups_of_gmsh = 2477;

/// Solid cells that gmsh reads: descriptor and nodes. It drops others of the range below without a word.
const std::map<int, int> solids = {{101, 6},  {102, 15}, {104, 8},  {111, 4}, {112, 6},
                                   {113, 15}, {115, 8},  {116, 20}, {118, 10}};
/// Surface cells that gmsh reads. It drops those of order 3, and fails on some lines and points.
const std::map<int, int> surfaces = {{41, 3}, {42, 6}, {44, 4}, {45, 8}, {51, 3}, {52, 6}, {54, 4}, {55, 8},
                                     {61, 3}, {62, 6}, {64, 4}, {65, 8}, {71, 4}, {72, 6}, {74, 3}, {75, 8},
                                     {81, 3}, {82, 6}, {84, 4}, {85, 8}, {91, 3}, {92, 6}, {94, 4}, {95, 8}};
bool is_solid(int descriptor) {
  return (descriptor >= 101 && descriptor <= 119) || descriptor == 312 || descriptor == 313;
}
/// Returns the nodes of a cell that is read, or none.
std::optional<int> nodes_of_type(int descriptor) {
  for (const std::map<int, int>* cells : {&solids, &surfaces})
    if (const auto found = cells->find(descriptor); found != cells->end()) return found->second;
  return {};
}
bool is_beam(int descriptor) { return descriptor == 11 || (descriptor >= 21 && descriptor <= 24); }

/// Reads a file line by line and keeps track of the dataset.
class Datasets {
 public:
  explicit Datasets(const std::string& path) : path_(path), in_(path) {}
  bool next(std::string& line) {
    if (!std::getline(in_, line)) return false;
    ++number_;
    const auto first = line.find_first_not_of(" \t\r"), last = line.find_last_not_of(" \t\r");
    const std::string text = first == std::string::npos ? "" : line.substr(first, last - first + 1);
    if (text == "-1") {
      inside_ = !inside_;
      begins_ = inside_;
      dataset_ = 0;
      record_ = -3;
    } else if (begins_) {
      begins_ = false;
      dataset_ = std::atoi(text.c_str());
    }
    ++record_;
    return true;
  }
  int dataset() const { return dataset_; }  ///< 0 between datasets
  long number() const { return number_; }   ///< of the line
  int record() const { return record_; }    ///< record of the dataset, from 0 on; -1: its number; less: no dataset
  /// Reads the numbers of a line; Fortran's exponent D is accepted. @throws InputError if an entry is no number or is
  /// missing
  template <class Number>
  std::vector<Number> numbers(const std::string& line, std::size_t count) const {
    std::string text = line;
    std::replace(text.begin(), text.end(), 'D', 'E');
    std::istringstream in(text);
    std::vector<Number> result(count);
    for (Number& each : result)
      if (!(in >> each))
        throw InputError(fmt::format("'{}': line {}: expected {} numbers in dataset {}, found '{}'", path_, number_,
                                     count, dataset_, line));
    return result;
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("'{}': line {}: {}", path_, number_, what));
  }

 private:
  std::string path_;
  std::ifstream in_;
  long number_ = 0;
  bool inside_ = false, begins_ = false;
  int dataset_ = 0, record_ = -3;
};

struct System {
  int kind = 0;                                        ///< 0: Cartesian, 1: cylindrical, 2: spherical
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< in rows, global components
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  bool global() const { return kind == 0 && axes.isIdentity(0) && origin.isZero(0); }
  /// Angles are in degrees: r, theta, z for cylindrical systems; r, the angle from z, the angle about z for spherical
  /// ones.
  Eigen::Vector3d place(const std::vector<double>& given) const {
    const double degree = std::acos(-1.0) / 180;
    Eigen::Vector3d x(given[0], given[1], given[2]);
    if (kind == 1) x << given[0] * std::cos(given[1] * degree), given[0] * std::sin(given[1] * degree), given[2];
    if (kind == 2)
      x << given[0] * std::sin(given[1] * degree) * std::cos(given[2] * degree),
          given[0] * std::sin(given[1] * degree) * std::sin(given[2] * degree), given[0] * std::cos(given[1] * degree);
    return origin + axes.transpose() * x;
  }
};

/// Reads dataset 2420: two lines of the part, then six lines of each system: label, kind and colour; name; three axes;
/// origin.
std::map<int, System> read_systems(const std::string& path) {
  std::map<int, System> result;
  Datasets file(path);
  System* system = nullptr;
  for (std::string line; file.next(line);) {
    if (file.dataset() != systems || file.record() < 2) continue;
    const int row = (file.record() - 2) % 6;
    if (row == 0) {
      const std::vector<int> head = file.numbers<int>(line, 2);
      system = &result[head[0]];
      system->kind = head[1];
      if (head[1] < 0 || head[1] > 2)
        file.fail(
            fmt::format("coordinate system {} of kind {}: 0 (Cartesian), 1 (cylindrical) and 2 (spherical) are read",
                        head[0], head[1]));
    } else if (row >= 2) {
      const std::vector<double> x = file.numbers<double>(line, 3);
      const Eigen::Vector3d vector(x[0], x[1], x[2]);
      if (row == 5)
        system->origin = vector;
      else
        system->axes.row(row - 2) = vector;
    }
  }
  return result;
}

bool is_group(int dataset) {
  return dataset == 2435 || dataset == 2452 || dataset == groups || dataset == groups_of_gmsh;
}

/// Follows the lines of elements, each of which has a head and lines that belong to it.
class Heads {
 public:
  /// @returns whether the line of the file is a head; count_more then says how many lines belong to it
  bool is_head(const Datasets& file) {
    if (file.record() == 0) more_ = 0;
    return file.record() >= 0 && more_-- <= 0;
  }
  void count_more(long lines) { more_ = lines; }

 private:
  long more_ = 0;
};

/// Numbers of elements by descriptor, with the line of the first of each.
class CountedTypes {
 public:
  void add(int descriptor, long line) { ++counts_.emplace(descriptor, std::pair(0L, line)).first->second.first; }
  bool empty() const { return counts_.empty(); }
  long first_line() const {
    long line = counts_.begin()->second.second;
    for (const auto& [descriptor, count] : counts_) line = std::min(line, count.second);
    return line;
  }
  /// "2 of type 21 (the first at line 33), 1 of type 161 (line 40)"
  std::string text() const {
    std::string text;
    for (const auto& [descriptor, count] : counts_)
      text += fmt::format("{}{} of type {} ({}line {})", text.empty() ? "" : ", ", count.first, descriptor,
                          text.empty() ? "the first at " : "", count.second);
    return text;
  }

 private:
  std::map<int, std::pair<long, long>> counts_;  // number, line
};

long lines_of_element(const std::vector<long>& head) {
  return (head[5] + 7) / 8 + (is_beam(static_cast<int>(head[1])) ? 1 : 0);
}

bool has_groups(const std::string& path) {
  Datasets file(path);
  for (std::string line; file.next(line);)
    if (is_group(file.dataset()) && file.record() >= 0) return true;
  return false;
}

}  // namespace

std::optional<double> universal_length_unit(const std::string& path) {
  Datasets file(path);
  for (std::string line; file.next(line);)
    if (file.dataset() == units && file.record() == 1) {
      const double factor = file.numbers<double>(line, 1)[0];  // units of the file in a metre
      if (!(factor > 0) || !std::isfinite(factor)) file.fail(fmt::format("a factor of lengths of {}", factor));
      return 1 / factor;
    }
  return std::nullopt;
}

std::string check_universal_elements(const std::string& path) {
  Datasets file(path);
  CountedTypes left_out, unknown;
  Heads heads;
  for (std::string line; file.next(line);) {
    if (file.dataset() != elements || !heads.is_head(file)) continue;
    const std::vector<long> head = file.numbers<long>(line, 6);
    const int descriptor = static_cast<int>(head[1]);
    const std::optional<int> count = nodes_of_type(descriptor);
    if (head[5] < 1 || (count && head[5] != *count))
      file.fail(fmt::format("element {} of type {} has {} nodes{}", head[0], descriptor, head[5],
                            count ? fmt::format(", expected {}", *count) : ""));
    heads.count_more(lines_of_element(head));
    if (!count) (is_solid(descriptor) ? unknown : left_out).add(descriptor, file.number());
  }
  if (!unknown.empty())
    throw InputError(
        fmt::format("'{}': line {}: solid cells of types that are not read: {}; types 111 and 118 (tetrahedra), 112 "
                    "and 113 (wedges), 115 and 116 (hexahedra) are read",
                    path, unknown.first_line(), unknown.text()));
  return left_out.empty()
             ? ""
             : "left out: elements that are neither solid cells nor faces of order 1 or 2: " + left_out.text();
}

bool adapt_universal_file(const std::string& source, const std::string& target) {
  const std::map<int, System> known = read_systems(source);
  const bool grouped = has_groups(source);
  Heads heads;
  Datasets file(source);
  std::ofstream out(target);
  bool changed = false;
  bool dropped = false;            // the line belongs to an element that is left out
  const System* system = nullptr;  // coordinate system of the node whose coordinates come next
  for (std::string line; file.next(line); dropped ? out : out << line << '\n') {
    if (file.dataset() != elements || file.record() < 0) dropped = false;
    if (file.dataset() == groups && file.record() == -1) {
      line = fmt::format("{:6d}", groups_of_gmsh);  // its records are the same
      changed = true;
    }
    if (file.dataset() == elements && heads.is_head(file)) {
      const std::vector<long> head = file.numbers<long>(line, 6);
      heads.count_more(lines_of_element(head));
      dropped = !nodes_of_type(static_cast<int>(head[1]));
      changed |= dropped || grouped;
      if (grouped)
        line = fmt::format("{:10d}{:10d}{:10d}{:10d}{:10d}{:10d}", head[0], head[1], head[2] + property_beyond, head[3],
                           head[4], head[5]);
    }
    if (file.dataset() != nodes || file.record() < 0) continue;
    if (file.record() % 2 == 0) {
      const std::vector<int> head = file.numbers<int>(line, 2);
      const auto found = known.find(head[1]);
      // Files without dataset 2420 number the global system 0 or 1.
      if (found == known.end() && !known.empty() && head[1] > 1)
        file.fail(fmt::format("node {} stands in the coordinate system {}, which dataset 2420 does not hold", head[0],
                              head[1]));
      system = found == known.end() || found->second.global() ? nullptr : &found->second;
    } else if (system) {
      const Eigen::Vector3d x = system->place(file.numbers<double>(line, 3));
      line = fmt::format("{:25.16E}{:25.16E}{:25.16E}", x[0], x[1], x[2]);
      changed = true;
    }
  }
  if (!out.flush()) throw ComputationError(fmt::format("'{}' cannot be written: is the disk full?", target));
  return changed;
}

}  // namespace bielle::reduce

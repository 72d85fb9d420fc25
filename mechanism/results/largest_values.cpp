#include "mechanism/results/largest_values.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include <Eigen/Core>
#include <fmt/format.h>

namespace bielle::mechanism {

namespace {

struct Wording {
  const char *title, *unit;
};
constexpr std::array<Wording, 10> wordings{{{"reaction force", "N"},
                                            {"reaction moment", "N m"},
                                            {"force of a drive", "N"},
                                            {"torque of a drive", "N m"},
                                            {"contact force", "N"},
                                            {"tension", "N"},
                                            {"force of an element", "N"},
                                            {"von Mises stress of a beam", "Pa"},
                                            {"von Mises stress of a body", "Pa"},
                                            {"pressure", "Pa"}}};

/// Returns the unit of one component of a field whose components have units of their own, "N m, N".
std::string_view unit_of(const std::string& units, std::size_t component) {
  std::string_view rest = units;
  for (std::size_t comma = rest.find(", "); comma != std::string_view::npos && component > 0;
       comma = rest.find(", "), --component)
    rest.remove_prefix(comma + 2);
  return rest.substr(0, rest.find(", "));
}

}  // namespace

LargestValues::LargestValues(const ResultsKinds& kinds) {
  for (const ResultsEntry& entry : kinds.entries()) {
    const ResultsKind& kind = kinds.kinds()[entry.kind];
    const std::size_t before = groups_.size();
    for (const ResultsField& field : kind.fields) add_field(kind, field, entry.number, names_.size());
    if (groups_.size() > before)
      names_.push_back(fmt::format("{} '{}'", section_noun(entry.entry.section), entry.entry.name));
  }
}

void LargestValues::add_field(const ResultsKind& kind, const ResultsField& field, std::size_t number,
                              std::size_t entry) {
  const std::size_t first = field.begin + number * field.size;
  const auto add_groups = [&](Quantity quantity, std::size_t count) {
    for (std::size_t k = 0; k + count <= field.size; k += count) groups_.push_back({quantity, first + k, count, entry});
  };
  const std::string& name = field.name;
  if (kind.section == Section::joints && name == "reaction" && field.size == 6) {
    groups_.push_back({Quantity::joint_force, first, 3, entry});
    groups_.push_back({Quantity::joint_moment, first + 3, 3, entry});
  } else if (name == "drive_force") {
    for (std::size_t k = 0; k < field.size; ++k)
      groups_.push_back(
          {unit_of(field.units, k) == "N" ? Quantity::drive_force : Quantity::drive_torque, first + k, 1, entry});
  } else if (kind.section == Section::contacts && name == "force") {
    add_groups(Quantity::contact_force, 3);
  } else if (name == "tension" && field.units == "N") {
    add_groups(Quantity::tension, 1);
  } else if (name == "force" && field.shape.empty() && field.units == "N" && kind.section != Section::joints) {
    add_groups(Quantity::element_force, 1);
  } else if (name == "von_mises" && field.units == "Pa") {
    add_groups(kind.type == "beam" ? Quantity::beam_stress : Quantity::body_stress, 1);
  } else if (name == "pressure" && field.units == "Pa") {
    add_groups(Quantity::pressure, 1);
  }
}

void LargestValues::begin(std::string rows, std::string time, std::string unit) {
  for (Largest& largest : largest_) largest = {};
  rows_ = std::move(rows);
  time_ = std::move(time);
  unit_ = std::move(unit);
}

void LargestValues::add(double time, const double* values) {
  for (const Group& group : groups_) {
    const Eigen::Map<const Eigen::VectorXd> numbers(values + group.begin, static_cast<Eigen::Index>(group.count));
    const double value = numbers.norm();
    Largest& largest = largest_[static_cast<std::size_t>(group.quantity)];
    if (value > largest.value) largest = {value, time, group.entry};
  }
}

std::string LargestValues::summary() const {
  const auto of = [&](Quantity quantity) { return largest_[static_cast<std::size_t>(quantity)].value; };
  // Moments below this fraction of the forces (at an arm of 1 m) are rounding errors, and the reverse.
  constexpr double rounding = 1e-13;
  const double least = rounding * std::max(of(Quantity::joint_force), of(Quantity::joint_moment));
  std::string text;
  for (std::size_t k = 0; k < quantities; ++k)
    if (const Largest& largest = largest_[k]; largest.value > (k < 2 ? least : 0))
      text += fmt::format("    {} {:.4g} {}, {}, {} = {:.6g}{}\n", wordings[k].title, largest.value, wordings[k].unit,
                          names_[largest.entry], time_, largest.time, unit_);
  return text.empty() ? text : fmt::format("  largest values of {}\n{}", rows_, text);
}

}  // namespace bielle::mechanism

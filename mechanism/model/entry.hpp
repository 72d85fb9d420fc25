// Entries of a mechanism file, identified by section and name.
#pragma once

#include <compare>
#include <string>

namespace bielle::mechanism {

/// Sections of a mechanism file whose entries have names; inputs belong to the measures. Supports are created from held
/// nodes and have their names; contacts are entries of the section joints; the hydraulics have their own sections.
enum class Section { nodes, elements, joints, drives, loads, states, measures, events, supports, contacts, hydraulics };
inline constexpr std::size_t section_count = 11;

const char* section_name(Section section);  ///< as in the file: "joints"
const char* section_noun(Section section);  ///< noun for one of its entries: "joint"

/// An entry of a section and its name: the identity of what the user wrote.
struct Entry {
  Section section;
  std::string name;
  auto operator<=>(const Entry&) const = default;  // NOLINT(modernize-use-nullptr): clang-tidy 14 sees a 0 in it
};

/// Path of the results of an entry, relative to the group of an analysis: "joints/main".
std::string results_path(const Entry& entry);

}  // namespace bielle::mechanism

// Entries of a mechanism file: what is known by a name.
#pragma once

#include <compare>
#include <string>

namespace bielle::mechanism {

/// Sections of a mechanism file whose entries have names; inputs are measures. Supports are made of held nodes and bear
/// their names; contacts are entries of joints; the hydraulics have sections of their own.
enum class Section { nodes, elements, joints, drives, loads, states, measures, events, supports, contacts, hydraulics };
inline constexpr std::size_t section_count = 11;

const char* section_name(Section section);  ///< as in the file: "joints"
const char* section_noun(Section section);  ///< what one of its entries is: "joint"

/// An entry of a section by its name: the identity of what the user wrote.
struct Entry {
  Section section;
  std::string name;
  auto operator<=>(const Entry&) const = default;
};

/// Where the results of an entry stand, below those of an analysis: "joints/main".
std::string results_path(const Entry& entry);

}  // namespace bielle::mechanism

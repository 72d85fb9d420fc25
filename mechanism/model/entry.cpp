#include "mechanism/model/entry.hpp"

#include <array>

namespace bielle::mechanism {

const char* section_name(Section section) {
  static constexpr std::array<const char*, section_count> names = {"nodes",    "elements", "joints",    "drives",
                                                                   "loads",    "states",   "measures",  "events",
                                                                   "supports", "contacts", "hydraulics"};
  return names[static_cast<std::size_t>(section)];
}

const char* section_noun(Section section) {
  static constexpr std::array<const char*, section_count> nouns = {"node",
                                                                   "element",
                                                                   "joint",
                                                                   "drive",
                                                                   "load",
                                                                   "state",
                                                                   "measure",
                                                                   "event",
                                                                   "support",
                                                                   "contact",
                                                                   "part of the hydraulics"};
  return nouns[static_cast<std::size_t>(section)];
}

std::string results_path(const Entry& entry) { return std::string(section_name(entry.section)) + "/" + entry.name; }

}  // namespace bielle::mechanism

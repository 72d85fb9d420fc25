#include "reduce/common/input/foreign_words.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reduce/common/error.hpp"

namespace bielle {
namespace {

struct ForeignWord {
  const char* foreign;
  std::vector<const char*> here;  ///< all words that it may stand for; those expected at its place are suggested
  const char* clause = nullptr;   ///< in place of "here it is called .."
};

constexpr const char* both_nodes = "here both nodes are in one list: `nodes: [first, second]`";

const std::vector<ForeignWord>& foreign_words() {
  static const std::vector<ForeignWord> words = {
      // sections and their entries
      {"bodies", {"elements"}},
      {"constraints", {"joints"}},
      {"forces", {"loads"}},
      {"marker", {"node"}},
      {"markers", {"nodes"}},
      {"motions", {"drives"}},
      {"request", {"measure"}},
      {"requests", {"measures"}},
      {"sensor", {"measure"}},
      {"sensors", {"measures"}},
      {"simulation", {"analysis"}},
      {"variables", {"parameters"}},
      // types of elements and joints
      {"ball", {"spherical"}},
      {"body", {"rigid_body"}},
      {"bush", {"bushing"}},
      {"cardan", {"universal"}},
      {"clamp", {"rigid"}},
      {"cylinder", {"hydraulic_actuator"}},
      {"damper", {"spring_damper"}},
      {"fixed", {"rigid"}},
      {"flexible_body", {"superelement"}},
      {"hooke", {"universal"}},
      {"inplane", {"planar"}},
      {"mass", {"point_mass"}},
      {"pin", {"hinge"}},
      {"revolute", {"hinge"}},
      {"rod", {"distance"}},
      {"rope", {"cable"}},
      {"spring", {"spring_damper"}},
      {"tire", {"tyre"}},
      {"translational", {"prismatic"}},
      {"weld", {"rigid"}},
      // types of analyses
      {"equilibrium", {"static"}},
      {"harmonic", {"frequency_response"}},
      {"linear", {"eigen", "state_space"}},
      {"modal", {"eigen"}},
      {"transient", {"dynamic"}},
      // keys
      {"c", {"damping"}},
      {"count", {"modes"}},
      {"dt", {"step"}},
      {"end", {"duration"}},
      {"end_time", {"duration"}},
      {"i", {"nodes"}, both_nodes},
      {"j", {"nodes"}, both_nodes},
      {"k", {"stiffness"}},
      {"modes", {"count"}},
      {"mu", {"coefficient"}},
      {"position", {"at"}},
      {"shape", {"cylinder"}, "here the name of the shape is the key: `cylinder: [radius, length]`"},
      {"time_step", {"step"}},
      {"velocity", {"rate", "speed"}},
  };
  return words;
}

}  // namespace

std::vector<std::string> names_here(const std::string& foreign, std::span<const std::string> candidates) {
  std::vector<std::string> names;
  for (const ForeignWord& word : foreign_words()) {
    if (foreign != word.foreign) continue;
    for (const char* here : word.here)
      if (std::find(candidates.begin(), candidates.end(), here) != candidates.end()) names.emplace_back(here);
  }
  return names;
}

std::string called_here_clause(std::span<const std::string> names) {
  return fmt::format("; here it is called '{}'", fmt::join(names, "' or '"));
}

std::string called_here(const std::string& word, std::span<const std::string> candidates) {
  const std::vector<std::string> names = names_here(word, candidates);
  if (names.empty()) return did_you_mean(word, candidates);
  for (const ForeignWord& known : foreign_words())
    if (word == known.foreign && known.clause) return fmt::format("; {}", known.clause);
  return called_here_clause(names);
}

}  // namespace bielle

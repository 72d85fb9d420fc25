#include "mechanism/results/model_difference.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mechanism/model/model.hpp"
#include "reduce/common/shortened.hpp"

namespace bielle::mechanism {
namespace {

using Digests = std::map<std::string, std::string>;  // digests by path

/// Returns the text without line breaks and tabulators: path and value are written on one line, separated by a
/// tabulator.
std::string in_one_line(std::string text) {
  for (char& letter : text)
    if (letter == '\n' || letter == '\t' || letter == '\r' || letter == '\0') letter = ' ';
  return text;
}

Digests digests_of(const std::string& text) {
  Digests digests;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t tab = line.find('\t');
    if (tab != std::string::npos) digests.emplace(line.substr(0, tab), line.substr(tab + 1));
  }
  return digests;
}

/// Returns "joints.main" for "joints.main.stops.damping", and "gravity" for "gravity[3]".
std::string entry_of(const std::string& path) {
  const std::size_t first = path.find_first_of(".[");
  if (first == std::string::npos || path[first] == '[') return path.substr(0, first);
  return path.substr(0, path.find_first_of(".[", first + 1));
}

/// Returns "joint 'main'" for "joints.main".
std::string in_words(const std::string& entry) {
  const std::size_t dot = entry.find('.');
  if (dot == std::string::npos) return entry;
  std::string section = entry.substr(0, dot);
  if (section != "hydraulics" && section.ends_with('s')) section.pop_back();
  return fmt::format("{} '{}'", section, entry.substr(dot + 1));
}

std::set<std::string> entries_of(const Digests& digests) {
  std::set<std::string> entries;
  for (const auto& [path, value] : digests) entries.insert(entry_of(path));
  return entries;
}

/// Returns sentences on all differences; an entry that is new or removed is one of them.
std::vector<std::string> differences(const Digests& before, const Digests& now) {
  std::vector<std::string> found;
  const std::set<std::string> entries_before = entries_of(before), entries_now = entries_of(now);
  for (const std::string& entry : entries_now)
    if (!entries_before.contains(entry)) found.push_back(entry + " is new");
  for (const std::string& entry : entries_before)
    if (!entries_now.contains(entry)) found.push_back(entry + " is gone");
  for (const auto& [path, value] : now) {
    if (!entries_before.contains(entry_of(path))) continue;
    const auto old = before.find(path);
    if (old == before.end())
      found.push_back(fmt::format("{} was not given and is {}", path, shortened(value)));
    else if (old->second != value)
      found.push_back(fmt::format("{} was {} and is {}", path, shortened(old->second), shortened(value)));
  }
  for (const auto& [path, value] : before)
    if (entries_now.contains(entry_of(path)) && !now.contains(path))
      found.push_back(fmt::format("{} was {} and is not given", path, shortened(value)));
  return found;
}

}  // namespace

std::string source_lines(const Model& model) {
  std::string lines;
  for (const auto& [path, value] : model.source) lines += in_one_line(path) + '\t' + in_one_line(value) + '\n';
  return lines;
}

ModelDifference difference_from(const std::string& before, const Model& model) {
  std::vector<std::string> found = differences(digests_of(before), digests_of(source_lines(model)));
  if (found.empty()) return {};
  constexpr std::size_t most_shown = 3;
  const std::size_t all = found.size();
  found.resize(std::min(all, most_shown));
  return {in_words(entry_of(found.front().substr(0, found.front().find(' ')))),
          fmt::format("{}", fmt::join(found, "; ")) +
              (all > most_shown ? fmt::format("; {} more differ", all - most_shown) : "")};
}

}  // namespace bielle::mechanism

#include "reduce/common/error.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

namespace bielle {

namespace {

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

/// Returns the optimal string alignment (restricted Damerau-Levenshtein) distance.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before_last, last(b.size() + 1), current(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    current[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      current[j] = std::min({last[j] + 1, current[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        current[j] = std::min(current[j], before_last[j - 2] + 1);
    }
    before_last = last;
    last = current;
  }
  return last[b.size()];
}

/// Returns the edit distance relative to the length of the longer name, less 1 if one name contains the other.
double unlikeness(const std::string& wanted, const std::string& candidate) {
  const std::string other = lower_case(candidate);
  const bool holds = wanted.size() > 1 && other.size() > 1 &&
                     (other.find(wanted) != std::string::npos || wanted.find(other) != std::string::npos);
  const auto most = static_cast<double>(std::max(wanted.size(), other.size()));
  return static_cast<double>(edit_distance(wanted, other)) / most - (holds ? 1 : 0);
}

}  // namespace

std::string with_subject(const std::string& subject, const std::string& message, Subject is) {
  return subject.empty() || is == Subject::hidden ? message : subject + ": " + message;
}

std::string nearest_name(const std::string& name, std::span<const std::string> candidates) {
  const std::string wanted = lower_case(name);
  std::string nearest;
  std::size_t least = 0;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(wanted, lower_case(candidate));
    if (3 * distance > std::max(name.size(), candidate.size())) continue;
    if (nearest.empty() || distance < least) {
      nearest = candidate;
      least = distance;
    }
  }
  return nearest;
}

std::string did_you_mean(const std::string& name, std::span<const std::string> candidates) {
  constexpr std::size_t most_shown = 12;
  const std::string nearest = nearest_name(name, candidates);
  if (!nearest.empty()) return fmt::format("; did you mean '{}'?", nearest);
  if (candidates.empty()) return "";
  std::vector<std::string> shown(candidates.begin(), candidates.end());
  if (shown.size() > most_shown && !name.empty()) {
    // If there are many candidates, only the most similar ones are shown, the nearest first.
    const std::string wanted = lower_case(name);
    std::stable_sort(shown.begin(), shown.end(), [&](const std::string& a, const std::string& b) {
      return unlikeness(wanted, a) < unlikeness(wanted, b);
    });
  }
  shown.resize(std::min(shown.size(), most_shown));
  std::string list;
  for (const std::string& each : shown) list += fmt::format("{}'{}'", list.empty() ? "" : ", ", each);
  if (candidates.size() > most_shown) list += fmt::format(" and {} more", candidates.size() - most_shown);
  return (candidates.size() == 1 ? "; expected " : "; expected one of ") + list;
}

}  // namespace bielle

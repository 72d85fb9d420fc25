#include "reduce/common/explanations.hpp"

#include <algorithm>
#include <cctype>
#include <set>
#include <sstream>

#include <fmt/format.h>

#include "reduce/common/error.hpp"

namespace bielle {

// The programs and the Python module replace this function by that of a generated source (ProgramFacts.cmake).
[[gnu::weak]] std::vector<std::string_view> explanation_pages() { return {}; }

namespace {

/// A pasted text counts as a message if it has this share of the message's words.
constexpr double likely = 0.75;

/// Returns the text with one blank in place of blanks and line breaks, none at its ends.
std::string single_blanks(const std::string& text) {
  std::istringstream stream(text);
  std::string joined;
  for (std::string word; stream >> word;) joined += (joined.empty() ? "" : " ") + word;
  return joined;
}

/// Returns the fixed texts of a message between its values.
std::vector<std::string> fixed_texts(const std::string& message) {
  std::vector<std::string> texts;
  for (std::size_t begin = 0; begin <= message.size();) {
    const std::size_t end = std::min(message.find("..", begin), message.size());
    if (std::string text = single_blanks(message.substr(begin, end - begin)); !text.empty()) texts.push_back(text);
    begin = end + 2;
  }
  return texts;
}

/// Returns the number of letters of a message that a text contains in order; 0 if one of its fixed texts is missing.
std::size_t matched_letters(const std::string& message, const std::string& text) {
  std::size_t place = 0, letters = 0;
  for (const std::string& fixed : fixed_texts(message)) {
    place = text.find(fixed, place);
    if (place == std::string::npos) return 0;
    place += fixed.size();
    letters += fixed.size();
  }
  return letters;
}

/// Returns the words of a text in lower case, without numbers and words of one or two letters.
std::set<std::string> words_of(const std::string& text) {
  std::set<std::string> words;
  std::string word;
  for (const char letter : text + " ") {
    if (std::isalpha(static_cast<unsigned char>(letter)) != 0) {
      word += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
      continue;
    }
    if (word.size() > 2) words.insert(word);
    word.clear();
  }
  return words;
}

/// Returns the share of the words of a message that are in `given`.
double likeness(const std::string& message, const std::set<std::string>& given) {
  const std::set<std::string> words = words_of(message);
  const auto found = std::count_if(words.begin(), words.end(), [&](const auto& word) { return given.contains(word); });
  return words.empty() ? 0 : static_cast<double>(found) / static_cast<double>(words.size());
}

/// Returns the text without marks of bold letters, and with links as their words: "[page](page.md)" is "page".
std::string without_marks(const std::string& text) {
  std::string plain;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const std::size_t middle = text[k] == '[' ? text.find(']', k) : std::string::npos;
    const bool link = middle != std::string::npos && text.compare(middle, 2, "](") == 0;
    const std::size_t end = link ? text.find(')', middle) : std::string::npos;
    if (end != std::string::npos) {
      plain += text.substr(k + 1, middle - k - 1);
      k = end;
    } else if (text.compare(k, 2, "**") == 0) {
      ++k;
    } else {
      plain += text[k];
    }
  }
  return plain;
}

std::string for_terminals(const Explanation& explanation) {
  std::string text = explanation.name + "\n\n";
  for (const std::string& message : explanation.messages) text += "    " + message + "\n";
  return text + "\n" + without_marks(explanation.text);
}

std::string listed(const std::vector<const Explanation*>& explanations) {
  std::string text;
  for (const Explanation* each : explanations) text += fmt::format("{:28} {}\n", each->name, each->messages.front());
  return text;
}

}  // namespace

std::vector<Explanation> read_explanations(const std::vector<std::string_view>& pages) {
  std::vector<Explanation> explanations;
  for (const std::string_view page : pages) {
    bool within = false;
    std::istringstream lines{std::string(page)};
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("## ")) {
        explanations.push_back({line.substr(3), {}, {}});
        within = true;
      } else if (within && line.starts_with("> ")) {
        explanations.back().messages.push_back(line.substr(line.starts_with("> - ") ? 4 : 2));
      } else if (within && (!line.empty() || !explanations.back().text.empty())) {
        explanations.back().text += line + "\n";
      }
    }
  }
  for (Explanation& each : explanations) each.text.resize(each.text.find_last_not_of('\n') + 1);
  for (Explanation& each : explanations) each.text += "\n";
  return explanations;
}

const Explanation* explanation_of(const std::vector<Explanation>& explanations, const std::string& message) {
  const std::string text = single_blanks(message);
  const Explanation* best = nullptr;
  std::size_t most = 0;
  for (const Explanation& each : explanations) {
    for (const std::string& one : each.messages) {
      if (const std::size_t letters = matched_letters(one, text); letters > most) {
        best = &each;
        most = letters;
      }
    }
  }
  return best;
}

std::string explain(const std::vector<Explanation>& explanations, const std::string& text) {
  const std::string asked = single_blanks(text);
  std::vector<std::string> names;
  std::vector<const Explanation*> all;
  for (const Explanation& each : explanations) {
    if (each.name == asked) return for_terminals(each);
    names.push_back(each.name);
    all.push_back(&each);
  }
  if (asked == "all") return listed(all);
  if (const Explanation* exact = explanation_of(explanations, asked)) return for_terminals(*exact);

  const std::set<std::string> given = words_of(asked);
  const Explanation* nearest = nullptr;
  double best = 0;
  std::vector<const Explanation*> with_all_words;
  for (const Explanation& each : explanations) {
    std::string whole = each.name + " " + each.text;
    for (const std::string& message : each.messages) {
      whole += " " + message;
      if (const double share = likeness(message, given); share > best) {
        best = share;
        nearest = &each;
      }
    }
    const std::set<std::string> words = words_of(whole);
    if (!given.empty() && std::includes(words.begin(), words.end(), given.begin(), given.end()))
      with_all_words.push_back(&each);
  }
  if (best >= likely) return for_terminals(*nearest);
  if (with_all_words.size() == 1) return for_terminals(*with_all_words.front());
  if (!with_all_words.empty()) return listed(with_all_words);
  const std::string nearest_one = nearest_name(asked, names);
  throw InputError(fmt::format("--explain: no explanation fits '{}'{}; `--explain all` lists them", asked,
                               nearest_one.empty() ? "" : fmt::format("; did you mean '{}'?", nearest_one)));
}

}  // namespace bielle

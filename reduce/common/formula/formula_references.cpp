#include "reduce/common/formula/formula_references.hpp"

#include <algorithm>
#include <charconv>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reduce/common/error.hpp"
#include "reduce/common/formula/formula_parser.hpp"

namespace bielle {

namespace {

/// muParser accepts names of up to 255 characters.
constexpr std::size_t longest_identifier = 100;

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_quote(char c) { return c == '\'' || c == '"'; }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/// A place where a reference is written.
struct Occurrence {
  std::size_t begin, end, reference;
};

class Scanner {
 public:
  Scanner(const std::string& text, const std::vector<std::string>& functions,
          const std::vector<std::string>& of_formulas)
      : text_(text), functions_(functions), of_formulas_(of_formulas) {}

  void scan() {
    while (at_ < text_.size()) {
      const std::size_t begin = at_;
      if (is_digit(here()) || (here() == '.' && is_digit(next(1))))
        skip_number();
      else if (is_quote(here()))
        scan_quoted(begin);
      else if (is_letter(here()))
        scan_name(begin);
      else
        ++at_;
    }
  }

  std::vector<FormulaReference> references;
  std::vector<Occurrence> occurrences;
  std::vector<std::string> plain;     ///< all other names
  std::vector<std::size_t> plain_at;  ///< their positions

 private:
  char next(std::size_t ahead) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
  char here() const { return next(0); }
  std::string since(std::size_t begin) const { return text_.substr(begin, at_ - begin); }
  void skip_blanks() {
    while (is_blank(here())) ++at_;
  }
  /// Skips a number in the same way as the parser of formulas does.
  void skip_number() {
    double number = 0;
    const char* begin = text_.data() + at_;
    at_ += static_cast<std::size_t>(std::from_chars(begin, text_.data() + text_.size(), number).ptr - begin);
  }
  std::string name() {
    const std::size_t begin = at_;
    while (is_letter(here()) || is_digit(here())) ++at_;
    return since(begin);
  }
  std::string dotted_name() {
    std::string all = name();
    while (!all.empty() && here() == '.' && is_letter(next(1))) {
      ++at_;
      all.append(1, '.').append(name());
    }
    return all;
  }
  std::string quoted() {
    const std::size_t end = text_.find(here(), at_ + 1);
    if (end == std::string::npos) throw InputError(fmt::format("the quote at character {} is not closed", at_ + 1));
    const std::string inside = text_.substr(at_ + 1, end - at_ - 1);
    at_ = end + 1;
    return inside;
  }

  void scan_quoted(std::size_t begin) {
    const std::string subject = quoted();
    const std::vector<std::string> words = path(begin);
    if (words.empty()) return;  // the name of a file
    if (subject.empty()) throw InputError(fmt::format("a name is missing in the quotes at character {}", begin + 1));
    add(begin, "", {subject}, words);
  }

  void scan_name(std::size_t begin) {
    const std::string word = name();
    if (contains(functions_, word) && parenthesis_follows(begin, word)) {
      const std::vector<std::string> subjects = names_in_parentheses(begin, word);
      add(begin, word, subjects, path(begin));
      return;
    }
    if (contains(of_formulas_, word) && parenthesis_follows(begin, word)) {
      const std::vector<std::string> operands = formulas_in_parentheses(begin, word);
      add(begin, word, operands, path(begin));
      return;
    }
    const std::vector<std::string> words = path(begin);
    if (words.empty()) {
      plain.push_back(word);
      plain_at.push_back(begin);
    } else {
      add(begin, "", {word}, words);
    }
  }

  bool parenthesis_follows(std::size_t begin, const std::string& function) {
    const std::size_t end = at_;
    skip_blanks();
    const bool parenthesis = here() == '(';
    if (parenthesis && at_ > end)
      throw InputError(fmt::format("the function '{}' at character {} must be followed by '('", function, begin + 1));
    at_ = end;
    return parenthesis;
  }

  /// Reads the words `.word.word` that follow the reference that begins at `begin`.
  std::vector<std::string> path(std::size_t begin) {
    std::vector<std::string> words;
    for (;;) {
      const std::size_t end = at_;
      skip_blanks();
      // the parser reads `t .5` as two numbers
      const bool blanks_before = at_ > end, dot = here() == '.' && !(blanks_before && is_digit(next(1)));
      if (!dot) {
        at_ = end;
        return words;
      }
      ++at_;
      const bool blanks_behind = is_blank(here());
      skip_blanks();
      if (!is_letter(here()))
        throw InputError(fmt::format("a name is missing after '{}' at character {}", since(begin), begin + 1));
      words.push_back(name());
      if (blanks_before || blanks_behind)
        throw InputError(
            fmt::format("'{}' at character {} is written without blanks at the dots", since(begin), begin + 1));
    }
  }

  std::vector<std::string> names_in_parentheses(std::size_t begin, const std::string& function) {
    std::vector<std::string> names;
    do {
      ++at_;
      skip_blanks();
      names.push_back(is_quote(here()) ? quoted() : dotted_name());
      skip_blanks();
    } while (here() == ',' && !names.back().empty());
    if (here() != ')' || names.back().empty())
      throw InputError(
          fmt::format("'{0}' at character {1} takes names, in quotes if they are more than a word: "
                      "{0}(one, 'number two')",
                      function, begin + 1));
    ++at_;
    return names;
  }

  std::vector<std::string> formulas_in_parentheses(std::size_t begin, const std::string& function) {
    std::vector<std::string> formulas;
    std::size_t from = ++at_;
    for (int depth = 1; depth > 0;) {
      if (at_ >= text_.size())
        throw InputError(fmt::format("the parenthesis of '{}' at character {} is not closed", function, begin + 1));
      if (is_quote(here())) {
        quoted();
        continue;
      }
      if (here() == '(') ++depth;
      if (here() == ')') --depth;
      if (depth == 0 || (depth == 1 && here() == ',')) {
        formulas.push_back(trimmed(since(from)));
        if (formulas.back().empty())
          throw InputError(fmt::format("an operand of '{}' at character {} is missing", function, begin + 1));
        from = at_ + 1;
      }
      ++at_;
    }
    return formulas;
  }
  static std::string trimmed(const std::string& text) {
    std::size_t begin = 0, end = text.size();
    while (begin < end && is_blank(text[begin])) ++begin;
    while (end > begin && is_blank(text[end - 1])) --end;
    return text.substr(begin, end - begin);
  }

  void add(std::size_t begin, const std::string& function, const std::vector<std::string>& subjects,
           const std::vector<std::string>& words) {
    const auto same = [&](const FormulaReference& known) {
      return std::tie(known.function, known.subjects, known.path) == std::tie(function, subjects, words);
    };
    const auto known = std::find_if(references.begin(), references.end(), same);
    occurrences.push_back({begin, at_, static_cast<std::size_t>(known - references.begin())});
    if (known == references.end()) references.push_back({since(begin), function, subjects, words, "", begin});
  }

  const std::string& text_;
  const std::vector<std::string>& functions_;
  const std::vector<std::string>& of_formulas_;
  std::size_t at_ = 0;
};

/// Returns a name of at most the given length that is made from the text and not yet used. (It begins with a letter or
/// a quote.)
std::string free_name(const std::string& text, std::size_t length, const std::vector<std::string>& taken) {
  std::string wanted = text.substr(0, length);
  for (char& c : wanted)
    if (!is_letter(c) && !is_digit(c)) c = '_';
  std::string name = wanted;
  for (int number = 0; contains(taken, name); ++number) {
    const std::string digits = fmt::format("{}", number);
    name = wanted.substr(0, std::max(wanted.size(), digits.size() + 1) - digits.size()) + digits;
  }
  return name;
}

}  // namespace

FormulaText find_references(const std::string& text, const std::vector<std::string>& plain_names,
                            const std::vector<std::string>& functions, const std::vector<std::string>& of_formulas) {
  Scanner scanner(text, functions, of_formulas);
  scanner.scan();
  FormulaText result{text, text, std::move(scanner.references)};

  std::vector<std::string> taken = scanner.plain;
  for (const auto* names : {&plain_names, &functions, &of_formulas, &built_in_names()})
    taken.insert(taken.end(), names->begin(), names->end());
  for (std::size_t i = 0; i < result.references.size(); ++i) {
    std::size_t length = longest_identifier;
    for (const Occurrence& place : scanner.occurrences)
      if (place.reference == i) length = std::min(length, place.end - place.begin);
    FormulaReference& reference = result.references[i];
    reference.identifier = free_name(reference.text, length, taken);
    taken.push_back(reference.identifier);
  }
  for (auto place = scanner.occurrences.rbegin(); place != scanner.occurrences.rend(); ++place) {
    const std::string& identifier = result.references[place->reference].identifier;
    const std::size_t length = place->end - place->begin;
    result.replaced.replace(place->begin, length, fmt::format("{:{}}", identifier, length));
  }
  return result;
}

namespace {

/// Returns a name as it is written in a formula: in quotes unless it consists of words with dots between them.
std::string spelled(const std::string& name) { return is_dotted_word(name) ? name : fmt::format("'{}'", name); }

}  // namespace

std::string rename_in_formula(const std::string& text, const std::vector<std::string>& functions,
                              const std::function<std::optional<std::string>(const std::string&)>& subject,
                              const std::function<std::optional<std::string>(const std::string&)>& word) {
  const std::vector<std::string> none;  // names in operands are renamed as all others are
  Scanner scanner(text, functions, none);
  scanner.scan();
  struct Change {
    std::size_t begin, end;
    std::string text;
  };
  std::vector<Change> changes;
  for (std::size_t k = 0; k < scanner.plain.size(); ++k)
    if (const auto other = word(scanner.plain[k]))
      changes.push_back({scanner.plain_at[k], scanner.plain_at[k] + scanner.plain[k].size(), *other});
  for (const Occurrence& place : scanner.occurrences) {
    const FormulaReference& reference = scanner.references[place.reference];
    std::vector<std::string> subjects;
    bool changed = false;
    auto step = reference.path.begin();  // the words before it belong to the name, which may have dots
    for (std::string name : reference.subjects) {
      auto other = subject(name);
      while (!other && reference.function.empty() && step != reference.path.end())
        other = subject(name += "." + *step++);
      changed = changed || other;
      subjects.push_back(spelled(other.value_or(name)));
    }
    if (!changed) continue;
    std::string written = reference.function.empty()
                              ? subjects.front()
                              : fmt::format("{}({})", reference.function, fmt::join(subjects, ", "));
    for (; step != reference.path.end(); ++step) written += "." + *step;
    changes.push_back({place.begin, place.end, written});
  }
  std::sort(changes.begin(), changes.end(), [](const Change& a, const Change& b) { return a.begin > b.begin; });
  std::string result = text;
  for (const Change& change : changes) result.replace(change.begin, change.end - change.begin, change.text);
  return result;
}

}  // namespace bielle

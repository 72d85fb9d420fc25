// Explanations of messages: cause and cure, from pages of the manual that are compiled into the programs.
//
// A page is Markdown. Each explanation has a heading of the second level, its name, then the messages as quotations and
// the text; several messages are items of a list, `> - nothing determines it`:
//
//     ## singular-equations
//
//     > the equations are singular at ..: it has no mass
//
//     **Cause.** ...
//
// Two dots in a message stand for values and names of the user. mechanism/manual/messages has the pages.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace bielle {

struct Explanation {
  std::string name;                   ///< heading, and anchor of the page
  std::vector<std::string> messages;  ///< with `..` in place of values
  std::string text;                   ///< cause and cure, Markdown
};

/// Returns the pages of this program. Programs that link Bielle's libraries only have none.
std::vector<std::string_view> explanation_pages();

std::vector<Explanation> read_explanations(const std::vector<std::string_view>& pages);

/// Returns the explanation of a message of the program, or a null pointer if there is none. If several fit, it is the
/// one whose message has the most letters. Line breaks in the message count as blanks.
const Explanation* explanation_of(const std::vector<Explanation>& explanations, const std::string& message);

/// Returns the answer to `--explain TEXT` for terminals. TEXT is a name, a message or a good part of one, or words that
/// several explanations contain, which are then listed; `all` lists all of them.
/// @throws InputError if no explanation fits, with names that are similar
std::string explain(const std::vector<Explanation>& explanations, const std::string& text);

}  // namespace bielle

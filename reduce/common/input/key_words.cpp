#include "reduce/common/input/key_words.hpp"

#include <algorithm>
#include <functional>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reduce/common/error.hpp"
#include "reduce/common/input/foreign_words.hpp"

namespace bielle {
namespace {

std::string variable_words(const KeyForm& form) {
  std::vector<std::string> variables = form.words;
  if (form.reads_state) variables.emplace_back("measures");
  if (variables.size() < 2) return variables.empty() ? "parameters" : variables.front();
  const std::string last = variables.back();
  variables.pop_back();
  return fmt::format("{} and {}", fmt::join(variables, ", "), last);
}

std::string number_words(const KeyForm& form) {
  std::string words = form.kind == KeyForm::Kind::integer   ? "whole number"
                      : form.kind == KeyForm::Kind::formula ? "formula of " + variable_words(form)
                                                            : "number";
  if (!form.unit.empty() && form.unit != "any") words += fmt::format(" [{}]", form.unit);
  if (const std::string range = form.range_words(); !range.empty()) words += " " + range;
  return words;
}

std::string list_words(const KeyForm& form) {
  if (form.items.size() > 1) {
    std::vector<std::string> each;
    for (const KeyForms& forms : form.items) each.push_back(form_words(forms));
    return fmt::format("[{}]", fmt::join(each, ", "));
  }
  const std::string item = form_words(form.items.front());
  constexpr std::size_t any = std::numeric_limits<std::size_t>::max();
  if (form.fewest == form.most_items) return fmt::format("list of {}: {}", form.fewest, item);
  if (form.fewest > 0 && form.most_items == any) return fmt::format("list of at least {}: {}", form.fewest, item);
  if (form.most_items != any) return fmt::format("list of {} to {}: {}", form.fewest, form.most_items, item);
  return "list: " + item;
}

std::string words_of(const KeyForm& form) {
  using Kind = KeyForm::Kind;
  switch (form.kind) {
    case Kind::number:
    case Kind::integer:
    case Kind::formula:
      return number_words(form);
    case Kind::boolean:
      return "true or false";
    case Kind::text:
      return "text";
    case Kind::word:
      return fmt::format("`{}`", fmt::join(form.words, "`, `"));
    case Kind::file:
      return fmt::format("file ({})", form.of);
    case Kind::name:
      return fmt::format("name of {} {}", std::string("aeiou").find(form.of.front()) == std::string::npos ? "a" : "an",
                         form.of);
    case Kind::list:
      return list_words(form);
    case Kind::table:
      return "keys of " + form.table().of;
    case Kind::entries:
      return fmt::format("map by {}: {}", form.of, form_words(form.items.front()));
    case Kind::null:
      return "`~`";
  }
  return {};
}

std::string default_words(const Key& key) {
  if (key.presence.required) return "required";
  if (!key.presence.value.empty()) return key.presence.value;
  return key.presence.words;
}

/// Breaks a text at blanks into lines of at most `columns`, each after `indent` blanks.
std::string wrapped(const std::string& text, std::size_t indent, std::size_t columns) {
  std::istringstream words(text);
  std::string result, line(indent, ' ');
  for (std::string word; words >> word;) {
    if (line.size() > indent && line.size() + 1 + word.size() > columns) {
      result += line + "\n";
      line.assign(indent, ' ');
    }
    if (line.size() > indent) line += ' ';
    line += word;
  }
  return result + line + "\n";
}

void visit_forms(const KeyForms& forms, const std::function<void(const KeyTable&)>& visit) {
  for (const KeyForm& form : forms) {
    if (form.table) visit(form.table());
    for (const KeyForms& items : form.items) visit_forms(items, visit);
  }
}

/// Returns the name by which a table is asked for: "hinge" of "a hinge", "eigen" of "the analysis 'eigen'".
std::string asked_name(const std::string& of) {
  const std::string thing = thing_named(of);
  const std::size_t quote = thing.find('\'');
  return quote != std::string::npos && thing.back() == '\'' ? thing.substr(quote + 1, thing.size() - quote - 2) : thing;
}

/// Returns a name with blanks in place of underscores.
std::string in_words(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

/// Returns "; did you mean .." with the nearest name, or with the names that contain the requested one; empty if there
/// are none.
std::string similar_names(const std::string& asked, const std::vector<std::string>& names) {
  if (const std::string nearest = nearest_name(asked, names); !nearest.empty())
    return fmt::format("; did you mean '{}'?", nearest);
  std::set<std::string> containing;
  for (const std::string& each : names)
    if (!asked.empty() && in_words(each).find(in_words(asked)) != std::string::npos) containing.insert(each);
  return did_you_mean(asked, std::vector<std::string>(containing.begin(), containing.end()));
}

}  // namespace

std::string form_words(const KeyForms& forms) {
  std::vector<std::string> each;
  for (const KeyForm& form : forms) each.push_back(words_of(form));
  return fmt::format("{}", fmt::join(each, "; or "));
}

std::string key_sentence(const Key& key) {
  const std::string preset = default_words(key);
  return fmt::format("{}\n\n{}{}", key.about, form_words(key.forms),
                     key.presence.required ? "; required"
                     : preset.empty()      ? ""
                                           : fmt::format("; default: {}", preset));
}

std::string thing_named(const std::string& of) {
  for (const char* article : {"a ", "an ", "the "})
    if (of.starts_with(article)) return of.substr(std::string(article).size());
  std::string name;
  std::copy_if(of.begin(), of.end(), std::back_inserter(name), [](char letter) { return letter != '`'; });
  return name;
}

std::vector<const KeyTable*> tables_below(const KeyTable& root) {
  std::vector<const KeyTable*> all;
  std::set<const KeyTable*> seen;
  const std::function<void(const KeyTable&)> visit = [&](const KeyTable& table) {
    if (!seen.insert(&table).second) return;
    if (!table.keys.empty()) all.push_back(&table);
    for (const Key& key : table.keys) visit_forms(key.forms, visit);
    for (const KeyTable::Variant& variant : table.variants) visit(variant.table());
  };
  visit(root);
  return all;
}

std::string keys_of_named(const KeyTable& root, const std::string& name) {
  std::vector<std::string> names;
  std::string text;
  const auto add = [&text](const KeyTable& table) {
    if (!text.empty()) text += "\n";
    text += keys_as_text(table);
  };
  const std::vector<const KeyTable*> tables = tables_below(root);
  for (const KeyTable* table : tables) {
    names.push_back(asked_name(table->of));
    if (name == "all" || in_words(names.back()) == in_words(name) || thing_named(table->of) == name) add(*table);
  }
  if (const std::vector<std::string> here = names_here(name, names); text.empty() && !here.empty()) {
    text = fmt::format("'{}'{}\n", name, called_here_clause(here));
    for (const KeyTable* table : tables)
      if (std::find(here.begin(), here.end(), asked_name(table->of)) != here.end()) add(*table);
  }
  if (text.empty())
    for (std::size_t k = 0; k < tables.size(); ++k)
      if (fmt::format(" {} ", in_words(names[k])).find(fmt::format(" {} ", in_words(name))) != std::string::npos)
        add(*tables[k]);
  if (text.empty())
    for (const KeyTable* table : tables)
      if (fmt::format(" {} ", in_words(table->about)).find(fmt::format(" {} ", in_words(name))) != std::string::npos)
        add(*table);
  if (text.empty())
    throw InputError(fmt::format("--keys {}: nothing has this name{}; `--keys all` prints all names with their keys",
                                 name, similar_names(name, names)));
  return text;
}

std::string keys_as_text(const KeyTable& table, std::size_t columns) {
  std::string text = fmt::format("{}\n{}\n", thing_named(table.of), wrapped(table.about, 2, columns));
  for (const Key& key : table.keys) {
    const std::string preset = default_words(key);
    text += fmt::format("  {}{}\n", key.name,
                        key.presence.required ? " (required)"
                        : preset.empty()      ? ""
                                              : fmt::format(" (default: {})", preset));
    text += wrapped(form_words(key.forms), 6, columns) + wrapped(key.about, 6, columns);
  }
  return text;
}

}  // namespace bielle

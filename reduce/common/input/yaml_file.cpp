#include "reduce/common/input/yaml_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include <fmt/format.h>

#include "reduce/common/counted.hpp"
#include "reduce/common/files/file_checks.hpp"
#include "reduce/common/input/foreign_words.hpp"
#include "reduce/common/input/place.hpp"
#include "reduce/common/input/unit.hpp"
#include "reduce/common/input/yaml_node.hpp"
#include "reduce/common/shortened.hpp"

namespace bielle {

struct YamlValue::Document {
  std::string file, text;
  Parameters parameters;
  std::vector<std::string> warnings;
};

namespace {

/// Explains an unknown key that is a number: it is probably the second half of "1,5", or of a formula.
std::string hint_at_comma(const std::string& key) {
  const bool number = !key.empty() && key.find_first_not_of("0123456789.eE+-") == std::string::npos;
  return number ? "; a comma separates keys: decimals are written with a point (1.5)" : "";
}

/// Expectation of a reader that takes keys out of a value that is no map.
constexpr const char* keys_with_values = "keys with values (`key: value`)";

/// Returns the expectation of a map of a table. It has an example with the number that is given, if this fits the only
/// required key of the table.
std::string map_of(const KeyTable& table, const YamlNode& given, const std::string& path) {
  const auto is_required = [](const Key& key) { return key.presence.required; };
  const auto key = std::find_if(table.keys.begin(), table.keys.end(), is_required);
  const std::string name = path.substr(path.find_last_of('.') + 1);
  const bool fits = key != table.keys.end() && std::none_of(key + 1, table.keys.end(), is_required) &&
                    numeric_form(key->forms) && given.kind == YamlNode::Kind::scalar && plain_number(given.scalar) &&
                    name.find('[') == std::string::npos;
  return fits ? fmt::format("{} as keys with values (`{}: {{{}: {}}}`)", table.of, name, key->name, given.scalar)
              : fmt::format("{} as {}", table.of, keys_with_values);
}

}  // namespace

YamlValue::YamlValue(std::shared_ptr<Document> document, std::shared_ptr<const YamlNode> node, std::string path,
                     int line)
    : document_(std::move(document)), node_(std::move(node)), path_(std::move(path)), line_(line) {}

YamlValue YamlValue::load(const std::string& path) { return parse(read_input_text(path), path); }

YamlValue YamlValue::parse(const std::string& text, const std::string& name) {
  return of_tree(parse_yaml(text, name), text, name);
}

YamlValue YamlValue::of_tree(std::shared_ptr<const YamlNode> root, const std::string& text, const std::string& name) {
  auto document = std::make_shared<Document>(Document{name, text, {}, {}});
  const int line = root->kind == YamlNode::Kind::null ? 1 : root->line;
  return {document, std::move(root), "", line};
}

void YamlValue::set_parameters(Parameters parameters) { document_->parameters = std::move(parameters); }
void YamlValue::set_parameter(const std::string& name, double value) { document_->parameters[name] = value; }
const Parameters& YamlValue::parameters() const { return document_->parameters; }

bool YamlValue::is_map() const { return node_->kind == YamlNode::Kind::map; }
bool YamlValue::is_sequence() const { return node_->kind == YamlNode::Kind::sequence; }
bool YamlValue::is_scalar() const { return node_->kind == YamlNode::Kind::scalar; }
bool YamlValue::is_null() const { return node_->kind == YamlNode::Kind::null; }

// -- maps

const Key& YamlValue::key_of_table(const std::string& key) const {
  if (const Key* found = table_->find(key)) return *found;
  throw std::logic_error(fmt::format("the table of {} lacks the key '{}', which is read", table_->of, key));
}

YamlValue YamlValue::with_forms(const KeyForms& forms) const {
  YamlValue value = *this;
  value.forms_ = &forms;
  if (!is_map() && !is_null()) return value;
  const KeyForm* only = nullptr;
  for (const KeyForm& form : forms) {
    if (form.kind == KeyForm::Kind::entries) return value;
    if (form.kind != KeyForm::Kind::table) continue;
    if (only) return value;
    only = &form;
  }
  return only ? value.keyed(only->table()) : value;
}

bool YamlValue::has(const std::string& key) const {
  check_map(keys_with_values);
  return std::any_of(node_->pairs.begin(), node_->pairs.end(),
                     [&](const YamlNode::Pair& pair) { return pair.key->scalar == key; });
}

YamlValue YamlValue::at(const std::string& key) const {
  if (auto value = find(key)) return *value;
  if (table_)
    if (const Key& known = key_of_table(key); known.preset)
      return YamlValue(document_, known.preset, path_of_key(path_, key), line_).with_forms(known.forms);
  fail(fmt::format("the key '{}' is missing", key));
}

std::optional<YamlValue> YamlValue::find(const std::string& key) const {
  check_map(keys_with_values);
  for (const auto& [found, value] : node_->pairs)
    if (found->scalar == key) return child(*found, value);
  return std::nullopt;
}

std::vector<std::pair<std::string, YamlValue>> YamlValue::entries() const {
  check_map(keys_with_values);
  std::vector<std::pair<std::string, YamlValue>> result;
  result.reserve(node_->pairs.size());
  for (const auto& [key, value] : node_->pairs) result.emplace_back(key->scalar, child(*key, value));
  return result;
}

YamlValue YamlValue::child(const YamlNode& key, std::shared_ptr<const YamlNode> value) const {
  const int line = value->kind == YamlNode::Kind::null ? key.line : value->line;  // libyaml puts a missing value on
                                                                                  // some later line
  YamlValue below(document_, std::move(value), path_of_key(path_, key.scalar), line);
  if (table_) return below.with_forms(key_of_table(key.scalar).forms);
  const KeyForm* form = form_of(forms(), KeyForm::Kind::entries);
  if (!form) return below;
  // A map may be entries or a table. It is the table if this has all keys of the map.
  for (const KeyForm& other : forms()) {
    if (other.kind != KeyForm::Kind::table) continue;
    const KeyTable& table = other.table().of_map(*node_);
    const bool fits = std::all_of(node_->pairs.begin(), node_->pairs.end(),
                                  [&](const YamlNode::Pair& pair) { return table.find(pair.key->scalar) != nullptr; });
    if (fits) return below.with_forms(table.find(key.scalar)->forms);
  }
  return below.with_forms(form->items.front());
}

void YamlValue::check_map(const std::string& expected) const {
  if (is_map() || is_null()) return;
  const KeyForm* form = form_of(forms(), KeyForm::Kind::table);
  fail("expected " + (form && expected == keys_with_values ? map_of(form->table(), *node_, path_) : expected));
}

void YamlValue::check_keys(const std::vector<std::string>& allowed, const std::string& of) const {
  check_map(of + " as " + keys_with_values);
  if (is_null()) return;
  for (const YamlNode::Pair& entry : node_->pairs) {
    const std::string& key = entry.key->scalar;
    if (std::find(allowed.begin(), allowed.end(), key) != allowed.end()) continue;
    const std::string comma = hint_at_comma(key);
    throw InputError(located_at(entry.key->file ? *entry.key->file : document_->file, entry.key->line, path_,
                                fmt::format("'{}' is not a key of {}{}", shortened(key), of,
                                            comma.empty() ? called_here(key, allowed) : comma)));
  }
}

YamlValue YamlValue::keyed(const KeyTable& table) const {
  if (!is_map() && !is_null()) fail("expected " + map_of(table, *node_, path_));
  YamlValue bound = *this;
  bound.table_ = &table.of_map(*node_);
  const bool known = std::all_of(node_->pairs.begin(), node_->pairs.end(), [&](const YamlNode::Pair& pair) {
    return bound.table_->find(pair.key->scalar) != nullptr;
  });
  if (known) return bound;
  std::vector<std::string> expected = bound.table_->names();
  if (bound.table_ == &table)
    for (const KeyTable::Variant& variant : table.variants) {
      // The reader of the key reports that its value is none of the choices.
      if (!variant.value.empty() && has(variant.key)) return bound;
      // The key of the variant may be misspelt.
      if (variant.value.empty() && std::find(expected.begin(), expected.end(), variant.key) == expected.end())
        expected.push_back(variant.key);
    }
  check_keys(expected, bound.table_->of);
  return bound;
}

// -- forms

const KeyForms& YamlValue::forms() const {
  static const KeyForms unknown;
  return forms_ ? *forms_ : unknown;
}

/// Converts a text that is a number with a unit; returns NaN for any other text.
double YamlValue::in_si(const std::string& written) const {
  const auto quantity = quantity_of(written);
  if (!quantity) return std::numeric_limits<double>::quiet_NaN();
  const KeyForm* form = numeric_form(forms());
  try {
    return to_si(*quantity, form ? form->unit : "");
  } catch (const InputError& error) {
    fail(error.what());
  }
}

void YamlValue::check_range(double value) const {
  const KeyForm* form = numeric_form(forms());
  if (form && !form->in_range(value)) fail(fmt::format("expected a number {}, found {}", form->range_words(), value));
}

// -- sequences

std::size_t YamlValue::size() const {
  if (!is_sequence()) fail("expected a list (`[a, b]`)");
  return node_->items.size();
}

YamlValue YamlValue::at(std::size_t index) const {
  const std::vector<YamlValue> all = items();
  if (index >= all.size()) fail(fmt::format("expected at least {}, found {}", counted(index + 1, "item"), all.size()));
  return all[index];
}

std::vector<YamlValue> YamlValue::items() const {
  std::vector<YamlValue> result;
  result.reserve(size());
  const KeyForm* form = form_of_list(forms(), *node_);
  for (const std::shared_ptr<const YamlNode>& item : node_->items) {
    const int line = item->kind == YamlNode::Kind::null ? line_ : item->line;
    const std::size_t k = result.size();
    const YamlValue value(document_, item, fmt::format("{}[{}]", path_, k + 1), line);
    result.push_back(form ? value.with_forms(form->items[std::min(k, form->items.size() - 1)]) : value);
  }
  return result;
}

// -- scalars

double YamlValue::number() const {
  if (!is_scalar()) fail(is_null() ? "expected a number, found nothing" : "expected a number");
  const std::string& written = node_->scalar;
  if (const auto value = plain_number(written)) {
    check_range(*value);
    return *value;
  }
  if (written == ".inf" || written == "-.inf" || written == "inf" || written == "-inf" || written == ".nan" ||
      written == "nan")
    fail(fmt::format("expected a finite number, found '{}'", shortened(written)));
  if (const double converted = in_si(written); !std::isnan(converted)) {
    check_range(converted);
    return converted;
  }
  const Expression formula = expression({});
  return formula(std::span<const double>());
}

double YamlValue::positive_number() const {
  const double value = number();
  if (!(value > 0)) fail(fmt::format("expected a number greater than 0, found {}", value));
  return value;
}

double YamlValue::non_negative_number() const {
  const double value = number();
  if (!(value >= 0)) fail(fmt::format("expected a number of at least 0, found {}", value));
  return value;
}

int YamlValue::integer() const {
  const double value = number();
  if (value != std::floor(value)) fail(fmt::format("expected a whole number, found {}", value));
  constexpr int largest = std::numeric_limits<int>::max();
  if (std::abs(value) > largest) fail(fmt::format("expected a whole number of at most {}, found {}", largest, value));
  return static_cast<int>(value);
}

bool YamlValue::boolean() const {
  if (is_scalar()) {
    const std::string& written = node_->scalar;
    if (written == "true" || written == "True" || written == "TRUE") return true;
    if (written == "false" || written == "False" || written == "FALSE") return false;
    if (numeric_form(forms())) return number() != 0;
    fail(fmt::format("expected true or false, found '{}'", shortened(written)));
  }
  fail("expected true or false");
}

std::string YamlValue::text() const {
  if (!is_scalar()) fail("expected a text");
  return node_->scalar;
}

std::string YamlValue::word(const std::vector<std::string>& allowed, const std::string& what) const {
  std::string found = is_scalar() ? text() : "";
  if (std::find(allowed.begin(), allowed.end(), found) != allowed.end()) return found;
  if (!is_scalar()) fail(fmt::format("expected {} as one word{}", what, did_you_mean("", allowed)));
  fail(fmt::format("'{}' is not {}{}", shortened(found), what, called_here(found, allowed)));
}

std::string YamlValue::word() const {
  const KeyForm* form = form_of(forms(), KeyForm::Kind::word);
  if (!form) throw std::logic_error(fmt::format("the form of {} is no word, but a word is read", path_));
  return word(form->words, form->of);
}

Eigen::VectorXd YamlValue::vector() const {
  if (!is_sequence()) fail("expected a list of numbers (`[1, 2, 3]`)");
  const std::vector<YamlValue> all = items();
  Eigen::VectorXd result(static_cast<Eigen::Index>(all.size()));
  for (std::size_t i = 0; i < all.size(); ++i) result(static_cast<Eigen::Index>(i)) = all[i].number();
  return result;
}

Eigen::VectorXd YamlValue::positive_numbers(std::size_t count, const std::string& expected) const {
  if (!is_sequence() || size() != count) fail("expected " + expected);
  for (const YamlValue& item : items()) item.positive_number();
  return vector();
}

Eigen::Vector3d YamlValue::vector3() const {
  if (!is_sequence()) fail("expected a list of three numbers (`[x, y, z]`)");
  if (size() != 3)
    fail(fmt::format("expected a list of three numbers (`[x, y, z]`), found {}{}", size(),
                     size() > 3 ? "; decimals are written with a point, formulas with commas in quotes" : ""));
  return vector();
}

Eigen::Vector3d YamlValue::direction() const {
  const Eigen::Vector3d given = vector3();
  const double length = given.stableNorm();
  if (length == 0) fail("a direction must not be zero");
  return given / length;
}

Eigen::MatrixXd YamlValue::matrix(Eigen::Index rows, Eigen::Index columns) const {
  const auto wrong = [&](const YamlValue& where) {
    where.fail(fmt::format("expected {} rows of {} numbers (`[[..], [..]]`)", rows, columns));
  };
  if (!is_sequence() || static_cast<Eigen::Index>(size()) != rows) wrong(*this);
  Eigen::MatrixXd result(rows, columns);
  Eigen::Index i = 0;
  for (const YamlValue& row : items()) {
    if (!row.is_sequence() || static_cast<Eigen::Index>(row.size()) != columns) wrong(row);
    result.row(i++) = row.vector().transpose();
  }
  return result;
}

Expression YamlValue::expression(const std::vector<std::string>& variables) const {
  if (!is_scalar()) fail("expected a number or a formula");
  if (const double converted = in_si(node_->scalar); !std::isnan(converted)) {
    check_range(converted);
    return Expression(converted);
  }
  return expression(variables, {node_->scalar, node_->scalar, {}});
}

Expression YamlValue::expression() const {
  const KeyForm* form = numeric_form(forms());
  if (!form) throw std::logic_error(fmt::format("the form of {} is no formula, but a formula is read", path_));
  return expression(form->words);
}

FormulaText YamlValue::formula_text(const std::vector<std::string>& variables,
                                    const std::vector<std::string>& functions) const {
  if (!is_scalar()) fail("expected a number or a formula");
  if (const double converted = in_si(node_->scalar); !std::isnan(converted)) {
    const std::string number = fmt::format("{}", converted);
    return {number, number, {}};
  }
  std::vector<std::string> plain_names = variables;
  for (const auto& [name, value] : document_->parameters) plain_names.push_back(name);
  try {
    return find_references(node_->scalar, plain_names, functions);
  } catch (const InputError& error) {
    fail(fmt::format("in '{}': {}", shortened(node_->scalar), error.what()));
  }
}

Expression YamlValue::expression(const std::vector<std::string>& variables, const FormulaText& formula) const {
  const auto read = [&] {
    try {
      return Expression(formula, variables, document_->parameters, std::filesystem::path(file()).parent_path().string(),
                        fmt::format("{}:{}: {}", file(), line_, path_));
    } catch (const InputError& error) {
      fail(error.what());
    }
  };
  Expression result = read();
  if (!result.is_constant()) return result;
  try {
    check_range(result(std::vector<double>(variables.size() + formula.references.size(), 0.0)));
  } catch (const ComputationError& error) {  // names the place
    throw InputError(error.what());
  }
  return result;
}

std::string YamlValue::file_path() const {
  const std::string written = text();
  if (written.empty()) fail("expected the name of a file");
  return (std::filesystem::path(file()).parent_path() / written).lexically_normal().string();
}

// -- place

const std::string& YamlValue::file() const { return node_->file ? *node_->file : document_->file; }
int YamlValue::line() const { return line_; }
std::string YamlValue::path() const { return path_; }
std::string YamlValue::source_text() const { return document_->text; }
void YamlValue::fail(const std::string& message) const { throw InputError(located(message)); }
void YamlValue::warn(const std::string& message) const { document_->warnings.push_back(located(message)); }
const std::vector<std::string>& YamlValue::warnings() const { return document_->warnings; }

std::string YamlValue::located(const std::string& message) const { return located_at(file(), line_, path_, message); }

}  // namespace bielle

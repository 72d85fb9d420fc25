#include "reduce/common/input/key_form.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "reduce/common/input/yaml_node.hpp"

namespace bielle {

KeyForm KeyForm::positive() const {
  KeyForm form = at_least(0);
  form.above = true;
  return form;
}

KeyForm KeyForm::non_negative() const { return at_least(0); }

KeyForm KeyForm::at_least(double value) const {
  KeyForm form = *this;
  form.least = value;
  return form;
}

KeyForm KeyForm::at_most(double value) const {
  KeyForm form = *this;
  form.most = value;
  return form;
}

KeyForm KeyForm::between(double lower, double upper) const { return at_least(lower).at_most(upper); }

KeyForm KeyForm::inside(double lower, double upper) const {
  KeyForm form = between(lower, upper);
  form.above = form.below = true;
  return form;
}

KeyForm KeyForm::items_at_least(std::size_t count) const {
  KeyForm form = *this;
  form.fewest = count;
  return form;
}

KeyForm KeyForm::with_geometry(Geometry is) const {
  KeyForm form = *this;
  form.geometry = is;
  return form;
}

KeyForm KeyForm::as_point() const { return with_geometry(Geometry::point); }
KeyForm KeyForm::as_vector() const { return with_geometry(Geometry::vector); }
KeyForm KeyForm::as_axial() const { return with_geometry(Geometry::axial); }
KeyForm KeyForm::as_pseudoscalar() const { return with_geometry(Geometry::pseudoscalar); }

KeyForm KeyForm::in_inertial_axes() const {
  KeyForm form = *this;
  form.inertial = true;
  return form;
}

bool KeyForm::in_range(double value) const {
  return (above ? value > least : value >= least) && (below ? value < most : value <= most);
}

std::string KeyForm::range_words() const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const bool lower = least > -infinity, upper = most < infinity;
  if (lower && upper)
    return above && below ? fmt::format("between {:.6g} and {:.6g}, both excluded", least, most)
           : above        ? fmt::format("greater than {:.6g} and at most {:.6g}", least, most)
           : below        ? fmt::format("of at least {:.6g} and less than {:.6g}", least, most)
                          : fmt::format("between {:.6g} and {:.6g}", least, most);
  if (lower) return fmt::format("{} {:.6g}", above ? "greater than" : "of at least", least);
  if (upper) return fmt::format("{} {:.6g}", below ? "less than" : "of at most", most);
  return {};
}

bool KeyForm::fits(const YamlNode& node) const {
  switch (kind) {
    case Kind::table:
    case Kind::entries:
      return node.kind == YamlNode::Kind::map || node.kind == YamlNode::Kind::null;
    case Kind::null:
      return node.kind == YamlNode::Kind::null;
    case Kind::list: {
      if (node.kind != YamlNode::Kind::sequence || node.items.size() < fewest || node.items.size() > most_items)
        return false;
      if (node.items.empty() || items.empty()) return true;
      for (const KeyForm& form : items.front())
        if (form.fits(*node.items.front())) return true;
      return false;
    }
    default:
      return node.kind == YamlNode::Kind::scalar;
  }
}

namespace {

template <class Is>
const KeyForm* first_form(const KeyForms& forms, const Is& is) {
  const auto found = std::find_if(forms.begin(), forms.end(), is);
  return found == forms.end() ? nullptr : &*found;
}

}  // namespace

const KeyForm* form_of(const KeyForms& forms, KeyForm::Kind kind) {
  return first_form(forms, [&](const KeyForm& form) { return form.kind == kind; });
}

const KeyForm* numeric_form(const KeyForms& forms) {
  return first_form(forms, [](const KeyForm& form) { return form.is_numeric(); });
}

const KeyForm* form_of_list(const KeyForms& forms, const YamlNode& list) {
  const KeyForm* fitting = first_form(forms, [&](const KeyForm& form) { return form.fits(list); });
  return fitting ? fitting : form_of(forms, KeyForm::Kind::list);
}

namespace keys {
namespace {

KeyForm of_kind(KeyForm::Kind kind) {
  KeyForm form;
  form.kind = kind;
  return form;
}

KeyForm list_between(std::size_t fewest, std::size_t most, std::vector<KeyForms> items) {
  KeyForm form = of_kind(KeyForm::Kind::list);
  form.fewest = fewest;
  form.most_items = most;
  form.items = std::move(items);
  return form;
}

}  // namespace

KeyForm number(std::string unit) {
  KeyForm form = of_kind(KeyForm::Kind::number);
  form.unit = std::move(unit);
  return form;
}

KeyForm integer() { return of_kind(KeyForm::Kind::integer); }

KeyForm formula(std::string unit, std::vector<std::string> variables) {
  KeyForm form = number(std::move(unit));
  form.kind = KeyForm::Kind::formula;
  form.words = std::move(variables);
  return form;
}

KeyForm state_formula(std::string unit, std::vector<std::string> variables) {
  KeyForm form = formula(std::move(unit), std::move(variables));
  form.reads_state = true;
  return form;
}

KeyForm boolean() { return of_kind(KeyForm::Kind::boolean); }
KeyForm text() { return of_kind(KeyForm::Kind::text); }

KeyForm word(std::vector<std::string> choices, std::string of) {
  KeyForm form = of_kind(KeyForm::Kind::word);
  form.words = std::move(choices);
  form.of = std::move(of);
  return form;
}

KeyForm file(std::string of) {
  KeyForm form = of_kind(KeyForm::Kind::file);
  form.of = std::move(of);
  return form;
}

KeyForm name_of(std::string of) {
  KeyForm form = of_kind(KeyForm::Kind::name);
  form.of = std::move(of);
  return form;
}

KeyForm list_of(KeyForms item) { return list_between(0, std::numeric_limits<std::size_t>::max(), {std::move(item)}); }
KeyForm list_of(KeyForm item) { return list_of(KeyForms{std::move(item)}); }
KeyForm list_of(std::size_t count, KeyForms item) { return list_between(count, count, {std::move(item)}); }
KeyForm list_of(std::size_t count, KeyForm item) { return list_of(count, KeyForms{std::move(item)}); }

KeyForm tuple(std::vector<KeyForms> items) {
  const std::size_t count = items.size();
  return list_between(count, count, std::move(items));
}

KeyForm vector3(std::string unit) { return list_of(3, number(std::move(unit))); }
KeyForm direction() { return vector3(""); }
KeyForm matrix(std::size_t rows, std::size_t columns, std::string unit) {
  return list_of(rows, list_of(columns, number(std::move(unit))));
}

KeyForm nested(const KeyTable& (*table)()) {
  KeyForm form = of_kind(KeyForm::Kind::table);
  form.table = table;
  return form;
}

KeyForm entries(std::string of, KeyForms value) {
  KeyForm form = of_kind(KeyForm::Kind::entries);
  form.of = std::move(of);
  form.items = {std::move(value)};
  return form;
}

KeyForm null() { return of_kind(KeyForm::Kind::null); }

}  // namespace keys
}  // namespace bielle

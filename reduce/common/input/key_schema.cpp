#include "reduce/common/input/key_schema.hpp"

#include <list>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "reduce/common/input/key_words.hpp"
#include "reduce/common/input/yaml_node.hpp"

namespace bielle {
namespace {

using Json = nlohmann::ordered_json;

/// Schemas of tables by their names; each table is written once and referred to.
class Writer {
 public:
  Writer(const KeyTable& root, const SchemaAdditions& additions) : additions_(additions) {
    for (const Key& key : root.keys)
      for (const KeyForm& form : key.forms)
        if (form.kind == KeyForm::Kind::entries)
          for (const KeyForm& entry : form.items.front())
            if (entry.table) add_entry_table(entry.table());
  }

  Json reference(const KeyTable& table) {
    const auto [found, is_new] = names_.emplace(&table, "");
    if (is_new) {
      found->second = free_name(has_form_of_its_own(table) ? table.of + " in any form" : table.of);
      const std::string name = found->second;
      definitions_[name] = Json::object();  // reserves its place
      Json written = of_table(table);
      definitions_[name] = std::move(written);
      return {{"$ref", "#/definitions/" + name}};
    }
    return {{"$ref", "#/definitions/" + found->second}};
  }

  Json take_definitions() { return std::move(definitions_); }

 private:
  /// Notes a table, and its variants, as that of a named entry.
  void add_entry_table(const KeyTable& table) {
    if (!entry_tables_.insert(&table).second) return;
    for (const KeyTable::Variant& variant : table.variants) add_entry_table(variant.table());
  }

  /// Returns whether a map without the key of a variant has keys other than the one that selects it.
  static bool has_form_of_its_own(const KeyTable& table) {
    return !table.variants.empty() &&
           (table.keys.size() > 1 || (table.keys.size() == 1 && table.keys[0].name != "type"));
  }

  /// "a spring_damper" -> "spring_damper", "the friction of a contact" -> "friction_of_a_contact"
  std::string free_name(const std::string& of) {
    std::string name = thing_named(of);
    for (char& letter : name)
      if (!std::isalnum(static_cast<unsigned char>(letter))) letter = '_';
    std::string free = name;
    for (int k = 2; !taken_.insert(free).second; ++k) free = fmt::format("{}_{}", name, k);
    return free;
  }

  Json of_table(const KeyTable& table) {
    if (!table.variants.empty()) return of_variants(table);
    Json schema{{"type", Json::array({"object", "null"})}, {"description", table.about}};
    Json properties = Json::object(), required = Json::array();
    for (const Key& key : table.keys) {
      properties[key.name] = of_key(key);
      if (key.presence.required) required.push_back(key.name);
    }
    if (entry_tables_.count(&table))
      for (const Key& key : additions_.entry_keys)
        if (!table.find(key.name)) properties[key.name] = of_key(key);
    schema["properties"] = std::move(properties);
    if (!required.empty()) schema["required"] = std::move(required);
    schema["additionalProperties"] = false;
    return schema;
  }

  /// Returns the schema of a table with variants. The first variant whose key is present applies; without any, the
  /// table's own keys apply.
  Json of_variants(const KeyTable& table) {
    KeyTable& plain = plain_tables_.emplace_back(table);
    plain.variants.clear();
    if (entry_tables_.count(&table)) entry_tables_.insert(&plain);
    Json schema = plain.keys.empty() ? Json(false) : has_form_of_its_own(table) ? reference(plain) : of_table(plain);
    for (auto variant = table.variants.rbegin(); variant != table.variants.rend(); ++variant) {
      Json condition{{"type", "object"}, {"required", {variant->key}}};
      if (!variant->value.empty()) condition["properties"] = {{variant->key, {{"const", variant->value}}}};
      schema = Json{{"if", condition}, {"then", reference(variant->table())}, {"else", std::move(schema)}};
    }
    // Editors offer the keys that select a variant, and their values, before one of these keys is present.
    std::map<std::string, Json> choices;
    std::set<std::string> alternatives;
    for (const KeyTable::Variant& variant : table.variants) {
      Json& values = choices[variant.key];
      if (!variant.value.empty()) values.push_back(variant.value);
      alternatives.insert(variant.key);
    }
    schema["description"] = table.about;
    Json properties = Json::object();
    for (const auto& [key, values] : choices)
      properties[key] = values.empty() ? Json::object() : Json{{"anyOf", {{{"enum", values}}, true}}};
    schema["properties"] = std::move(properties);
    return schema;
  }

  Json of_key(const Key& key) {
    Json schema = of_forms(key.forms);
    schema["description"] = key_sentence(key);
    if (key.preset && key.preset->kind == YamlNode::Kind::scalar) schema["default"] = key.preset->scalar;
    return schema;
  }

  Json of_forms(const KeyForms& forms) {
    if (forms.size() == 1) return of_form(forms.front());
    Json any = Json::array();
    for (const KeyForm& form : forms) any.push_back(of_form(form));
    return {{"anyOf", std::move(any)}};
  }

  Json of_number(const KeyForm& form) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Json number{{"type", form.kind == KeyForm::Kind::integer ? "integer" : "number"}};
    if (form.least > -infinity) number[form.above ? "exclusiveMinimum" : "minimum"] = form.least;
    if (form.most < infinity) number[form.below ? "exclusiveMaximum" : "maximum"] = form.most;
    return {{"anyOf", {std::move(number), {{"type", "string"}}}}};
  }

  Json of_form(const KeyForm& form) {
    using Kind = KeyForm::Kind;
    switch (form.kind) {
      case Kind::number:
      case Kind::integer:
      case Kind::formula:
        return of_number(form);
      case Kind::boolean:
        return {{"type", "boolean"}};
      case Kind::name:
        return of_name(form);
      case Kind::text:
        return any_scalar();
      case Kind::word:
        return {{"enum", form.words}};
      case Kind::file:
        return {{"type", "string"}};
      case Kind::null:
        return {{"type", "null"}};
      case Kind::table:
        return reference(form.table());
      case Kind::entries:
        return {{"type", Json::array({"object", "null"})}, {"additionalProperties", of_forms(form.items.front())}};
      case Kind::list:
        return of_list(form);
    }
    return true;
  }

  static Json any_scalar() { return {{"type", Json::array({"string", "number", "boolean"})}}; }

  Json of_name(const KeyForm& form) {
    const auto found = additions_.in_place_of_names.find(form.of);
    if (found == additions_.in_place_of_names.end()) return any_scalar();
    return {{"anyOf", {any_scalar(), reference(found->second())}}};
  }

  Json of_list(const KeyForm& form) {
    Json schema{{"type", "array"}};
    if (form.items.size() == 1) {
      schema["items"] = of_forms(form.items.front());
    } else {
      Json items = Json::array();
      for (const KeyForms& forms : form.items) items.push_back(of_forms(forms));
      schema["items"] = std::move(items);
    }
    if (form.fewest > 0) schema["minItems"] = form.fewest;
    if (form.most_items != std::numeric_limits<std::size_t>::max()) schema["maxItems"] = form.most_items;
    return schema;
  }

  const SchemaAdditions& additions_;
  std::set<const KeyTable*> entry_tables_;
  std::map<const KeyTable*, std::string> names_;
  std::set<std::string> taken_;
  std::list<KeyTable> plain_tables_;  ///< tables without their variants
  Json definitions_ = Json::object();
};

}  // namespace

std::string write_key_schema(const KeyTable& root, const std::string& title, const SchemaAdditions& additions) {
  Writer writer(root, additions);
  const Json reference = writer.reference(root);
  Json schema{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", title}};
  schema["allOf"] = Json::array({reference});
  schema["definitions"] = writer.take_definitions();
  return schema.dump(1) + "\n";
}

}  // namespace bielle

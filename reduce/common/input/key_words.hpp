// Keys in words: for the terminal, for editors and for the manual.
#pragma once

#include <string>
#include <vector>

#include "reduce/common/input/key_table.hpp"

namespace bielle {

/// Returns the forms in words: "number [N/m] of at least 0, or formula of e, v, t and the state".
std::string form_words(const KeyForms& forms);

/// Returns the sentence of a key with its forms and default, as an editor shows it.
std::string key_sentence(const Key& key);

/// Returns the name of the thing without its article: "hinge" of "a hinge".
std::string thing_named(const std::string& of);

/// Lists a table and the tables below it, each once, in the order in which they are met. A table that consists of
/// variants alone is not listed, its variants are.
std::vector<const KeyTable*> tables_below(const KeyTable& root);

/// Writes the keys of one thing ("hinge", "point_mass"), or of everything ("all"), for a terminal. If nothing has the
/// name, it writes those of all things whose names contain it as words ("sampled": a sampled state), or else of those
/// whose sentences contain it ("tapered": a roller_bearing).
/// @throws InputError if nothing below the root has the name
std::string keys_of_named(const KeyTable& root, const std::string& name);

/// Writes the keys of a table for a terminal.
/// @param columns  width of the lines
std::string keys_as_text(const KeyTable& table, std::size_t columns = 100);

}  // namespace bielle

// Entries of a section, with `if` and `repeat`.
#pragma once

#include <functional>
#include <string>

#include "mechanism/language/scope.hpp"

namespace bielle::mechanism {

/// @param name   name of the entry, with its numbers
/// @param value  without `if` and `repeat`
/// @param scope  the one of the section, or one that knows the numbers of this repetition
using UseEntry = std::function<void(const std::string& name, const Tree& value, const Scope& scope)>;

/// Returns whether a condition, `true`, `false` or a number, is true or not zero. @param path  of the condition
bool holds(const YamlNode& condition, const Scope& scope, const std::string& path);

/// Calls `use` for each entry that is there, once for each repetition. @param path  of the section, for messages
void for_each_entry(const YamlNode& section, const Scope& scope, const std::string& path, const UseEntry& use);

}  // namespace bielle::mechanism

// The identity of a program: its version, the commit of its sources, its build and its libraries.
#pragma once

#include <string>

namespace bielle {

/// Commit of the sources: twelve digits, with `-modified` if files of the repository were changed after it; "unknown"
/// for sources without a repository. Programs that link Bielle's libraries only have no commit either ("unknown").
const char* commit();

/// Lines about the build for `--version`, each with a word and a text: type, compiler and libraries. Empty in programs
/// that link Bielle's libraries only.
const char* build_facts();

/// Returns the text of `--version`: the program with its version in the first line, then commit and build.
std::string version_text(const std::string& program);

/// "bielle-reduce 0.1.0 (commit 0123456789ab)": the attribute `created_by` of files.
std::string created_by(const std::string& program);

}  // namespace bielle

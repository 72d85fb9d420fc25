// Options that the command lines of both programs share.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace bielle {

struct CommonOptions {
  int threads = 1;
  bool quiet = false;
};

/// Adds `--version`, `--explain TEXT`, `--threads N` (1 or more; default: the processors that this process may use) and
/// `--quiet`;
/// `--help` is CLI11's own.
void add_common_options(CLI::App& app, CommonOptions& options);

/// Parses the command line.
/// @returns false when `--help`, `--version` or `--explain` was given and has been printed: the program ends with
/// status 0
/// @throws InputError with a message of one line, which names the nearest option if one is unknown
bool parse_command_line(CLI::App& app, int argc, const char* const* argv);

/// Processors that this process may run on, at least 1.
int available_processors();

}  // namespace bielle

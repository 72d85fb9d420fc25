#include "reduce/common/command_line.hpp"

#include <algorithm>
#include <cstdio>
#include <vector>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <sched.h>

#include "reduce/common/build.hpp"
#include "reduce/common/error.hpp"
#include "reduce/common/explanations.hpp"

namespace bielle {

namespace {

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

}  // namespace

int available_processors() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(0, sizeof set, &set) != 0) return 1;
  return std::max(CPU_COUNT(&set), 1);
}

void add_common_options(CLI::App& app, CommonOptions& options) {
  options.threads = available_processors();
  app.set_version_flag("--version", version_text(app.get_name()),
                       "Print version, commit, build and libraries, and exit");
  app.add_option("--threads", options.threads, "Threads to work with")
      ->type_name("N")
      ->capture_default_str()
      ->check([](const std::string& text) {
        int threads = 0;
        return CLI::detail::lexical_cast(text, threads) && threads >= 1 ? "" : "expected a whole number of at least 1";
      });
  app.add_option("--explain", "explain a message: its name, or the message itself, in quotes; `all` lists the names")
      ->type_name("TEXT")
      ->expected(1);
  app.add_flag("--quiet", options.quiet, "Print errors and warnings only");
}

bool parse_command_line(CLI::App& app, int argc, const char* const* argv) {
  const std::string hint = fmt::format(" (see {} --help)", app.get_name());
  try {
    app.allow_extras(false);
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    fmt::print("{}", app.help());
    return false;
  } catch (const CLI::CallForVersion& version) {
    fmt::print("{}\n", version.what());
    return false;
  } catch (const CLI::ExtrasError&) {
    for (const std::string& extra : app.remaining()) {
      const std::string name = extra.substr(0, extra.find('='));
      if (name.starts_with("-"))
        throw InputError(fmt::format("'{}' is not an option{}{}", name, did_you_mean(name, option_names(app)), hint));
    }
    const std::vector<std::string> extras = app.remaining();
    throw InputError(fmt::format("'{}' is one argument too many{}", extras.empty() ? "" : extras.front(), hint));
  } catch (const CLI::ParseError& error) {
    throw InputError(error.what() + hint);
  }
  if (const CLI::Option* asked = app.get_option_no_throw("--explain"); asked != nullptr && asked->count() > 0) {
    fmt::print("{}", explain(read_explanations(explanation_pages()), asked->as<std::string>()));
    return false;
  }
  return true;
}

}  // namespace bielle

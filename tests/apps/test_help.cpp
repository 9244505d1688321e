#include <regex>
#include <set>

#include "apps/run_program.h"
#include "support/catch.h"

using namespace stackabilization;
using namespace stackabilization::apps;

namespace {

/// "--json" and "-o" in a help text; the descriptions mention options too.
std::set<std::string> options_in(const std::string& help) {
  std::set<std::string> options;
  const std::regex pattern("(^|[ ,\\[])(--?[a-z][a-z-]*)");
  for (std::sregex_iterator match(help.begin(), help.end(), pattern), end; match != end; ++match)
    options.insert((*match)[2]);
  return options;
}

}  // namespace

TEST_CASE("help of the program and of every command shows an example that names it") {
  const Outcome program = run_program({"--help"});
  CHECK(program.status == 0);
  for (const std::string& command : command_names()) {
    CHECK(program.out.find(command) != std::string::npos);
    const Outcome help = run_program({command, "--help"});
    CHECK(help.status == 0);
    CHECK(help.err.empty());
    CHECK(help.out.find("Example:\n  stackabilize " + command + " ") != std::string::npos);
  }
}

TEST_CASE("version is told by the program and by every command") {
  const std::string version = run_program({"--version"}).out;
  CHECK(std::regex_match(version, std::regex("stackabilize [0-9]+\\.[0-9]+\\.[0-9]+\n")));
  for (const std::string& command : command_names())
    CHECK(run_program({command, "--version"}).out == version);
}

TEST_CASE("the manual page explains every option") {
  const std::string page = bytes_of(STACKABILIZATION_SOURCE_DIR "/docs/stackabilize.1");
  REQUIRE(!page.empty());
  for (const std::string& command : command_names()) {
    CHECK(page.find(".It Cm " + command + "\n") != std::string::npos);
    const std::set<std::string> options = options_in(run_program({command, "--help"}).out);
    CHECK(options.size() > 8);
    for (const std::string& option : options) {
      // A long option is written "Fl \-name" in the page's language, a short one "Fl n".
      const std::string name = option.starts_with("--") ? "\\\\-" + option.substr(2) : option.substr(1);
      INFO(command << " " << option);
      CHECK(std::regex_search(page, std::regex("\\.It [^\n]*Fl " + name + "[ \n]")));
    }
  }
}

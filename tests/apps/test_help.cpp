#include <cstdlib>
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

/// What bash prints for a script.
std::string bash_output(const TemporaryFolder& folder, const std::string& script) {
  const std::string path = folder.file("script.bash", script), out = folder / "out";
  REQUIRE(std::system(("bash '" + path + "' > '" + out + "'").c_str()) == 0);
  return bytes_of(out);
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
  CHECK(std::regex_match(
      version,
      std::regex("stackabilize [0-9]+\\.[0-9]+\\.[0-9]+, revision [^ \n]+\n"
                 "built with [^\n]+, CGAL [0-9.]+, Eigen [0-9.]+, Boost [0-9.]+, TBB [0-9.]+, [^\n]+\n")));
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

TEST_CASE("completion in bash offers commands, options and the names of values") {
  const TemporaryFolder folder;
  const std::string script = folder.file("complete.bash", run_program({"--completion"}).out);
  const auto completed = [&](const std::string& words) {
    // As bash does it: the words so far, the last of them to be completed.
    return bash_output(folder, "source '" + script + "'\nCOMP_WORDS=(stackabilize " + words +
                                   ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_stackabilize\n"
                                   "echo \"${COMPREPLY[@]}\"\n");
  };
  CHECK(completed("mea") == "measure\n");
  CHECK(completed("stack model.obj --sem") == "--semantics\n");
  CHECK(completed("measure --semantics ''") == "solid closed\n");
  CHECK(completed("stack --twist-degrees ''") == "auto\n");
  CHECK(completed("measure --resolution ''") == "\n");
  CHECK(completed("measure '" + script.substr(0, script.size() - 3) + "'") == script + "\n");
  for (const std::string& command : command_names()) {
    const std::string offered = " " + completed(command + " -"), help = run_program({command, "--help"}).out;
    const std::regex line("\n  (-[a-z]),?|\n  (?:-[a-z],)?(--[a-z-]+)");
    for (std::sregex_iterator match(help.begin(), help.end(), line), end; match != end; ++match) {
      const std::string option = match->str(1) + match->str(2);
      INFO(command << " " << option);
      CHECK(offered.find(" " + option) != std::string::npos);
    }
  }
}

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <array>
#include <functional>
#include <iostream>
#include <new>
#include <string>
#include <vector>

#include "apps/command.h"
#include "apps/interrupt.h"
#include "apps/version.h"
#include "stackabilization/shape/errors.h"
#include "stackabilization/shape/formats/text.h"
#include "stackabilization/shape/utf8.h"

namespace stackabilization::apps {

namespace {

/// One sentence on standard error.
int complain(std::string sentence, int status) {
  std::replace(sentence.begin(), sentence.end(), '\n', ' ');
  std::cerr << "stackabilize: " << sentence << '\n';
  return status;
}

/// Turns what is thrown into a sentence and the exit status.
int guarded(const std::function<int()>& body) {
  try {
    return body();
  } catch (const CLI::ConversionError& error) {
    // Values are converted by this program; what is left to the parser are flags, "--quiet=x".
    const std::string text = error.what();
    return complain("an option that takes no value was given one: " + text.substr(text.find(": ") + 2),
                    status_usage);
  } catch (const CLI::Error& error) {
    return complain(error.what(), status_usage);
  } catch (const UsageError& error) {
    return complain(error.what(), status_usage);
  } catch (const OutputError& error) {
    return complain(error.what(), status_usage);
  } catch (const Error& error) {
    return complain(error.what(), status_input);
  } catch (const Interrupted& error) {
    return complain(error.what(), status_interrupted());
  } catch (const std::bad_alloc&) {
    return complain("this takes more memory than there is", status_input);
  } catch (const std::exception& error) {
    return complain(std::string("unexpected failure: ") + error.what(), status_input);
  }
}

/// What is wrong with a command line without a known command.
std::string unknown_command(const CLI::App& program) {
  std::string known;
  for (const CLI::App* command : program.get_subcommands(nullptr))
    known += (known.empty() ? "" : ", ") + command->get_name();
  const std::vector<std::string> words = program.remaining();
  const std::string found = words.empty() ? "none was given" : "found '" + words.front() + "'";
  return "expected one of the commands " + known + "; " + found;
}

/// Names of files and parts go on into JSON, which holds UTF-8 only.
void check_encoding(int argc, char** argv) {
  for (int i = 1; i < argc; ++i)
    if (!is_utf8(argv[i]))
      throw UsageError("argument " + std::to_string(i) + " expects UTF-8, found " + in_quotes(argv[i]));
}

int parse_and_run(int argc, char** argv) {
  check_encoding(argc, argv);
  CLI::App program("Measure exactly how well 3D shapes stack, and find out how to stack them best.",
                   "stackabilize");
  program.set_version_flag("--version", version_text(), "Print the version and exit");
  program.require_subcommand(1);
  program.footer(
      "Example:\n  stackabilize measure chair.obj --direction 0 0 1\n\n"
      "stackabilize COMMAND --help explains a command. Exit status: 0 done; 1 the answer is no;\n"
      "2 wrong usage; 3 unusable input.");
  const std::array commands = {make_inspect_command(program),   make_measure_command(program),
                               make_search_command(program),    make_map_command(program),
                               make_stack_command(program),     make_validate_command(program),
                               make_structure_command(program), make_deform_command(program),
                               make_improve_command(program),   make_suggest_command(program)};
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {
    return program.exit(help_or_version);
  } catch (const CLI::RequiredError&) {
    if (!program.get_subcommands().empty()) throw;
    throw UsageError(unknown_command(program));
  }
  for (const Command& command : commands)
    if (command.app->parsed()) return command.run();
  return status_usage;
}

}  // namespace

}  // namespace stackabilization::apps

int main(int argc, char** argv) {
  using namespace stackabilization::apps;
  install_interrupt_handler();
  return guarded([argc, argv] { return parse_and_run(argc, argv); });
}

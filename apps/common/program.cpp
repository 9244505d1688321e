#include "apps/common/program.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "apps/common/completion.h"
#include "apps/common/interrupt.h"
#include "apps/common/version.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/text.h"
#include "stackabilization/core/utf8.h"

namespace stackabilization::apps {

namespace {

constexpr const char* program_name = "stackabilize";

/// What is wrong with a command line without a known command.
std::string unknown_command(const CLI::App& program) {
  std::string known;
  for (const CLI::App* command : program.get_subcommands(nullptr))
    known += (known.empty() ? "" : ", ") + command->get_name();
  const std::vector<std::string> words = program.remaining();
  const std::string found = words.empty() ? "none was given" : "found '" + words.front() + "'";
  return "expected one of the commands " + known + "; " + found;
}

/// What CLI11 says of arguments that no option takes, in the order in which they were given: it reverses
/// them.
std::string unexpected(const std::vector<std::string>& words) {
  std::string text = words.size() == 1 ? "The following argument was not expected:"
                                       : "The following arguments were not expected:";
  for (const std::string& word : words) text += " " + word;
  return text;
}

/// Names of files and parts go on into JSON, which holds UTF-8 only.
void check_encoding(const std::vector<std::string>& arguments) {
  for (std::size_t i = 0; i < arguments.size(); ++i)
    if (!is_utf8(arguments[i]))
      throw UsageError("argument " + std::to_string(i + 1) + " expects UTF-8, found " +
                       in_quotes(arguments[i]));
}

}  // namespace

Program::Program(Caller* caller)
    : app_(std::make_unique<CLI::App>(
          "Measure exactly how well 3D shapes stack, and find out how to stack them best.", program_name)) {
  app_->set_version_flag("--version", version_text(), "Print the version and exit");
  app_->add_flag_callback(
      "--completion", [this] { throw CLI::CallForVersion(completion_script(*this), 0); },
      "Print a script that completes command lines in bash, and exit");
  app_->require_subcommand(1);
  app_->footer(
      "Example:\n  stackabilize measure chair.obj --direction 0 0 1\n\n"
      "stackabilize COMMAND --help explains a command. Exit status: 0 done; 1 the answer is no;\n"
      "2 wrong usage; 3 unusable input.");
  commands_ = {make_inspect_command(*app_), make_measure_command(*app_),  make_search_command(*app_),
               make_map_command(*app_),     make_stack_command(*app_),    make_hold_command(*app_),
               make_gap_command(*app_),     make_drop_command(*app_),     make_items_command(*app_),
               make_draft_command(*app_),   make_validate_command(*app_), make_structure_command(*app_),
               make_deform_command(*app_),  make_improve_command(*app_),  make_suggest_command(*app_),
               make_compare_command(*app_), make_edit_command(*app_)};
  for (const Command& command : commands_) command.common->caller = caller;
}

Program::~Program() = default;

void Program::parse(std::vector<std::string> arguments) {
  check_encoding(arguments);
  std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
  try {
    app_->parse(std::move(arguments));
  } catch (const CLI::RequiredError&) {
    if (!app_->get_subcommands().empty()) throw;
    throw UsageError(unknown_command(*app_));
  } catch (const CLI::ExtrasError&) {
    throw UsageError(unexpected(app_->remaining(true)));
  }
}

int Program::run() {
  for (const Command& command : commands_)
    if (command.app->parsed()) return command.run();
  return status_usage;
}

std::vector<std::string> Program::command_names() const {
  std::vector<std::string> names;
  for (const Command& command : commands_) names.push_back(command.app->get_name());
  return names;
}

std::vector<OptionOfCommand> Program::options(const std::string& name) const {
  const auto found = std::find_if(commands_.begin(), commands_.end(),
                                  [&](const Command& command) { return command.app->get_name() == name; });
  if (found == commands_.end()) throw UsageError("there is no command '" + name + "'");
  std::vector<OptionOfCommand> options;
  for (const CLI::Option* option : std::as_const(*found->app).get_options()) {
    OptionOfCommand known;
    for (const std::string& word : option->get_lnames()) known.names.push_back("--" + word);
    for (const std::string& letter : option->get_snames()) known.names.push_back("-" + letter);
    if (known.names.empty()) continue;  // MODEL
    if (option->get_items_expected_max() > 0) known.expects = option->get_type_name();
    known.meaning = option->get_description();
    options.push_back(std::move(known));
  }
  return options;
}

int Program::parse_and_run(std::vector<std::string> arguments) {
  try {
    parse(std::move(arguments));
  } catch (const CLI::Success& help_or_version) {
    return app_->exit(help_or_version);
  }
  return run();
}

int guarded(const std::function<int()>& body) {
  try {
    return body();
  } catch (const CLI::ConversionError& error) {
    // Values are converted by this program; what is left to the parser are flags, "--quiet=x".
    const std::string text = error.what();
    return complain(program_name,
                    "an option that takes no value was given one: " + text.substr(text.find(": ") + 2),
                    status_usage);
  } catch (const Interrupted& error) {
    return complain(program_name, error.what(), status_interrupted());
  } catch (...) {
    return complain_of_exception(program_name);
  }
}

}  // namespace stackabilization::apps
